// The columns of a recording.
#include <charconv>
#include <cmath>

#include <sim/output/csv.hpp>

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

}  // namespace mckibben::output
