// See the header.
#include <algorithm>
#include <cmath>
#include <limits>

#include <plant/mechanics.hpp>
#include <plant/signals.hpp>
#include <sim/run/gaps.hpp>

namespace mckibben::run {
namespace {

/// A column of readings, and the rows where there is none.
struct Column {
  plant::Channel channel;
  const std::vector<double>* values;
  const std::vector<bool>* missing = nullptr;

  double at(std::size_t k) const {
    const bool none = missing != nullptr && !missing->empty() && (*missing)[k];
    return none ? std::numeric_limits<double>::quiet_NaN() : (*values)[k];
  }
};

/// Of rows, or as they were recorded.
std::vector<Column> columns_of(const domain::Run& run) {
  std::vector<Column> all;
  for (const domain::Reading& reading : run.readings)
    if (!reading.values.empty()) all.push_back({reading.channel, &reading.values, &reading.missing});
  if (!run.readings.empty() || !run.measured) return all;
  for (const domain::MeasuredColumn& column : run.measured->columns)
    if (!column.given && !column.values.empty()) all.push_back({column.channel, &column.values});
  return all;
}

bool has_rows(const domain::Run& run) {
  return !run.measured || !run.readings.empty();
}

}  // namespace

Shown shown_of(const plant::Channel& channel, const domain::Run& run, const plant::Rig& rig, bool counted) {
  const double length_m = rig.muscle.rest_length_m;
  const std::string_view signal = channel.signal->key;
  if (signal == "contraction_ratio")
    return [counted, scale = run.rest_length_m > 0.0 ? length_m / run.rest_length_m : 1.0](
               const Sample& row) { return counted ? row.read_ratio : row.shown_ratio() * scale; };
  if (signal == "angle")
    return [counted, scale = length_m / rig.joint.wheel_radius_m](const Sample& row) {
      return counted ? row.read_angle_rad : row.angle_rad + row.misread_ratio * scale;
    };
  if (const auto sensed = plant::named<plant::Sensed>(signal))
    return [sensed = *sensed, muscle = channel.muscle](const Sample& row) {
      return row.side(muscle).shown[sensed];
    };
  return [channel](const Sample& row) { return channel.signal->value(row, channel.muscle); };
}

std::vector<Compared> compared(const domain::Run& run, const plant::Rig& rig, const Recording& recording) {
  const bool rows = has_rows(run), counted = rows ? !run.measured : run.measured->counted;
  const bool degrees = run.measured && run.measured->angle_in_degrees;
  std::vector<Compared> all;
  for (const Column& column : columns_of(run)) {
    const plant::Channel& channel = column.channel;
    const bool in_degrees = degrees && channel.signal->key == "angle";
    const double factor = 1.0 / (in_degrees ? plant::degree_rad : channel.signal->unit.size);
    all.push_back({channel.key_in_dataset(), in_degrees ? "deg" : std::string(channel.signal->unit.name),
                   [factor, column](std::size_t k) { return factor * column.at(k); },
                   [factor, &recording, shown = shown_of(channel, run, rig, counted)](std::size_t k) {
                     return factor * shown(recording.samples[k]);
                   }});
  }
  return all;
}

std::vector<Gap> gaps_of(const domain::Run& run, const plant::Rig& rig, const Recording& recording) {
  // Rows that were made of stamps have left out what is skipped.
  const double skip_s = has_rows(run) ? 0.0 : run.measured->recorded.skip_s;
  std::vector<Gap> gaps;
  for (const Compared& one : compared(run, rig, recording)) {
    Gap gap{.reading = one.reading, .unit = one.unit};
    double squares = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < recording.samples.size(); ++k) {
      if (recording.samples[k].time_s - recording.samples.front().time_s < skip_s) continue;
      const double measured = one.measured(k), error = one.simulated(k) - measured;
      if (std::isnan(error)) continue;
      gap.low = std::min(gap.low, measured);
      gap.high = std::max(gap.high, measured);
      ++gap.rows;
      squares += error * error;
      sum += error;
      gap.largest = std::max(gap.largest, std::abs(error));
    }
    if (gap.rows > 0) {
      gap.rmse = std::sqrt(squares / static_cast<double>(gap.rows));
      gap.mean = sum / static_cast<double>(gap.rows);
    }
    gaps.push_back(gap);
  }
  return gaps;
}

}  // namespace mckibben::run
