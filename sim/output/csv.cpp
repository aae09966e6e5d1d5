// The columns of a recording, in the order of the file.
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

}  // namespace

double tidy_s(double time_s) {
  return std::round(time_s * 1e9) / 1e9;
}

Besides besides_of(const plant::Rig& rig) {
  return {rig.gauge.fitted, rig.load_cell.fitted};
}

std::vector<formats::Column> recorded_columns(bool target, Besides besides) {
  std::vector<formats::Column> columns{
      {"time_s", "s", "time since the run began", {}},
      {"current_mA", "mA", "current to the valve, from this row to the next", {}},
      {"contraction_ratio", "1", "contraction ratio of the muscle, true", {}},
      {"contraction_speed_per_s", "s-1", "speed of the contraction ratio, true", {}},
      {"valve_pressure_bar", "bar", "gauge pressure at the valve, true", {}},
      {"muscle_pressure_bar", "bar", "gauge pressure in the muscle, true", {}},
      {"encoder_contraction_ratio", "1", "contraction ratio as the encoder counts it", {}},
      {"bristle_m", "m", "deflection of the bristles of thread friction, true", {}},
      {"braid_force_N", "N", "force of the braid on the load, upwards", {}},
      {"friction_force_N", "N", "force of thread friction on the load, upwards", {}}};
  if (target) columns.push_back({"target_contraction_ratio", "1", "contraction ratio that is asked for", {}});
  if (besides.gauge)
    columns.push_back({"gauge_pressure_bar", "bar", "gauge pressure in the muscle as measured", {}});
  if (besides.load_cell)
    columns.push_back({"cell_force_N", "N", "force of the muscle's cord as measured", {}});
  return columns;
}

std::vector<formats::Column> columns_of(const run::Recording& recording, double per_count,
                                        const std::vector<double>& target, Besides besides) {
  std::vector<formats::Column> columns = recorded_columns(!target.empty(), besides);
  for (auto& column : columns) column.values.reserve(recording.samples.size());
  for (std::size_t k = 0; k < recording.samples.size(); ++k) {
    const auto& row = recording.samples[k];
    auto column = columns.begin();
    const auto put = [&column](double value) { (column++)->values.push_back(value); };
    put(tidy_s(row.time_s));
    put(row.current_mA);
    put(row.state.joint.contraction_ratio);
    put(row.state.joint.contraction_speed_per_s);
    put(row.state.side.valve_pressure_Pa / 1e5);
    put(row.state.side.muscle_pressure_Pa / 1e5);
    put(static_cast<double>(row.counts) * per_count);
    put(row.state.side.bristle_m);
    put(row.braid_force_N);
    put(row.friction_force_N);
    if (!target.empty()) put(target[k]);
    if (besides.gauge) put(row.gauge_Pa / 1e5);
    if (besides.load_cell) put(row.cell_N);
  }
  return columns;
}

std::vector<formats::Column> measured_columns(Besides besides) {
  std::vector<formats::Column> columns{
      {"time_s", "s", "time since the run began", {}},
      {"current_mA", "mA", "current to the valve, from this row to the next", {}},
      {"contraction_ratio", "1", "contraction ratio of the muscle as the encoder counts it", {}}};
  if (besides.gauge)
    columns.push_back({"muscle_pressure_bar", "bar", "gauge pressure in the muscle as measured", {}});
  if (besides.load_cell) columns.push_back({"force_N", "N", "force of the muscle's cord as measured", {}});
  return columns;
}

std::vector<formats::Column> columns_of(const domain::Run& measured, double tick_s) {
  std::vector<formats::Column> columns =
      measured_columns({measured.muscle_pressure_Pa.has_value(), !measured.force_N.empty()});
  for (std::size_t k = 0; k < measured.current_mA.size(); ++k)
    columns[0].values.push_back(tidy_s(static_cast<double>(k) * tick_s));
  columns[1].values = measured.current_mA;
  columns[2].values = measured.contraction_ratio;
  if (measured.muscle_pressure_Pa)
    for (const double value : *measured.muscle_pressure_Pa) columns[3].values.push_back(value / 1e5);
  if (!measured.force_N.empty()) columns.back().values = measured.force_N;
  return columns;
}

std::string csv_of(const std::vector<formats::Column>& columns) {
  constexpr std::size_t usual_cell = 18;
  const std::size_t rows = columns.front().values.size();
  std::string text;
  text.reserve((rows + 1) * columns.size() * usual_cell);
  const auto end_cell = [&](const formats::Column& column) {
    text += &column == &columns.back() ? '\n' : ',';
  };
  for (const auto& column : columns) {
    text += column.name;
    end_cell(column);
  }
  for (std::size_t k = 0; k < rows; ++k)
    for (const auto& column : columns) {
      append(text, column.values[k]);
      end_cell(column);
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
