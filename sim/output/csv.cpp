// The columns of a recording.
#include <charconv>
#include <cmath>

#include <plant/plant.hpp>
#include <sim/output/csv.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::output {
namespace {

void append(std::string& text, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  text.append(digits, end);
}

// A tick's time without the rounding of k * 0.012, which would fill the column with digits.
double tidy_s(double time_s) {
  return std::round(time_s * 1e9) / 1e9;
}

}  // namespace

std::string csv_of(const run::Recording& recording, double per_count, const std::vector<double>& target,
                   bool gauge) {
  std::string text =
      "time_s,current_mA,contraction_ratio,contraction_speed_per_s,valve_pressure_bar,muscle_pressure_bar,"
      "encoder_contraction_ratio,bristle_m,braid_force_N,friction_force_N";
  if (!target.empty()) text += ",target_contraction_ratio";
  if (gauge) text += ",gauge_pressure_bar";
  text += '\n';
  text.reserve(text.size() + recording.samples.size() * 180);
  for (std::size_t k = 0; k < recording.samples.size(); ++k) {
    const auto& row = recording.samples[k];
    append(text, tidy_s(row.time_s));
    const auto column = [&text](double value) {
      text += ',';
      append(text, value);
    };
    column(row.current_mA);
    column(row.state.joint.contraction_ratio);
    column(row.state.joint.contraction_speed_per_s);
    column(row.state.side.valve_pressure_Pa / 1e5);
    column(row.state.side.muscle_pressure_Pa / 1e5);
    column(static_cast<double>(row.counts) * per_count);
    column(row.state.side.bristle_m);
    column(row.braid_force_N);
    column(row.friction_force_N);
    if (!target.empty()) column(target[k]);
    if (gauge) column(row.gauge_Pa / 1e5);
    text += '\n';
  }
  return text;
}

std::string csv_of(const input::Run& measured, double tick_s) {
  const auto& pressure_Pa = measured.muscle_pressure_Pa;
  std::string text = "time_s,current_mA,contraction_ratio";
  text += pressure_Pa ? ",muscle_pressure_bar\n" : "\n";
  for (std::size_t k = 0; k < measured.current_mA.size(); ++k) {
    append(text, tidy_s(static_cast<double>(k) * tick_s));
    for (const double value : {measured.current_mA[k], measured.contraction_ratio[k]}) {
      text += ',';
      append(text, value);
    }
    if (pressure_Pa) {
      text += ',';
      append(text, (*pressure_Pa)[k] / 1e5);
    }
    text += '\n';
  }
  return text;
}

std::string thesis_ascii(const run::Recording& recording, const plant::Rig& rig, double load_kg) {
  const plant::Plant plant(rig, load_kg);
  const double per_count = run::contraction_per_count(rig), tick_s = rig.tick_s;
  const auto& samples = recording.samples;
  // Before the first row the rig was at rest.
  const auto counts = [&](std::size_t rows_ago, std::size_t k) {
    return samples[k < rows_ago ? 0 : k - rows_ago].counts;
  };
  std::string text;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto last = counts(0, k), before = counts(1, k), earlier = counts(2, k);
    append(text, samples[k].current_mA);
    for (const double value :
         {static_cast<double>(last) * per_count, static_cast<double>(last - before) * per_count / tick_s,
          static_cast<double>(last - 2 * before + earlier) * per_count / (tick_s * tick_s),
          plant.reference_pressure_Pa(samples[k].current_mA) / 1e5}) {
      text += ' ';
      append(text, value);
    }
    text += '\n';
  }
  return text;
}

}  // namespace mckibben::output
