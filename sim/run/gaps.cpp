// See the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <plant/mechanics.hpp>
#include <plant/signals.hpp>
#include <sim/run/gaps.hpp>

namespace mckibben::run {
namespace {

/// A column of readings, and the rows where there is none.
struct Column {
  const std::vector<double>* values = nullptr;
  const std::vector<bool>* missing = nullptr;

  bool absent() const { return values == nullptr || values->empty(); }
  double at(std::size_t k) const {
    const bool none = missing != nullptr && !missing->empty() && (*missing)[k];
    return none ? std::numeric_limits<double>::quiet_NaN() : (*values)[k];
  }
};

/// What was read of a run: a row each tick, rows made of stamps, or the stamps themselves.
struct Readings {
  Column contraction, angle, force;
  std::array<Column, 2> pressure;
  bool counted = true;
};

Readings rows_of(const domain::Run& run) {
  const auto missing = [&](domain::Beside which) {
    return &run.missing_beside[static_cast<std::size_t>(which)];
  };
  using enum domain::Beside;
  Readings all;
  all.counted = !run.measured;
  all.contraction = {&run.contraction_ratio, &run.missing};
  all.angle = {&run.angle_rad, &run.missing};
  all.force = {&run.force_N, run.length_is_given() ? &run.missing : missing(force)};
  all.pressure = {Column{run.beside(muscle_pressure), missing(muscle_pressure)},
                  Column{run.beside(opposite_pressure), missing(opposite_pressure)}};
  return all;
}

Readings stamps_of(const domain::Measurement& measured) {
  Readings all;
  all.counted = measured.counted;
  all.contraction.values = &measured.contraction_ratio;
  all.angle.values = &measured.angle_rad;
  all.force.values = &measured.force_N;
  for (std::size_t side = 0; side < 2; ++side)
    if (!measured.sides[side].pressure_is_given)
      all.pressure[side].values = &measured.sides[side].muscle_pressure_Pa;
  return all;
}

bool has_rows(const domain::Run& run) {
  return !run.measured || !run.contraction_ratio.empty() || !run.angle_rad.empty() || !run.force_N.empty();
}

}  // namespace

std::vector<Compared> compared(const domain::Run& run, const plant::Rig& rig, const Recording& recording) {
  std::vector<Compared> all;
  const Readings read = has_rows(run) ? rows_of(run) : stamps_of(*run.measured);
  const bool degrees = run.measured && run.measured->angle_in_degrees, pair = rig.pair() != nullptr;
  const auto add = [&](std::string_view signal, std::size_t muscle, const Column& column, auto simulated) {
    if (column.absent()) return;
    const plant::Channel channel{&plant::signal_of(signal), muscle};
    const bool in_degrees = degrees && signal == "angle";
    const double factor = 1.0 / (in_degrees ? plant::degree_rad : channel.signal->unit.size);
    all.push_back({channel.key_in_dataset(), in_degrees ? "deg" : std::string(channel.signal->unit.name),
                   [factor, column](std::size_t k) { return factor * column.at(k); },
                   [factor, &recording, simulated](std::size_t k) {
                     return factor * simulated(recording.samples[k]);
                   }});
  };
  const bool counted = read.counted;
  const double length_m = rig.muscle.rest_length_m;
  if (!run.length_is_given())
    add("contraction_ratio", 0, read.contraction,
        [counted, scale = run.rest_length_m > 0.0 ? length_m / run.rest_length_m : 1.0](const Sample& row) {
          return counted ? row.read_ratio : row.shown_ratio() * scale;
        });
  add("angle", 0, read.angle, [counted, scale = length_m / rig.joint.wheel_radius_m](const Sample& row) {
    return counted ? row.read_angle_rad : row.angle_rad + row.misread_ratio * scale;
  });
  // A cord cannot push: a load cell on one that hangs through reads nothing.
  add("force", 0, read.force, [](const Sample& row) { return std::max(row.cord_force_N, 0.0); });
  for (std::size_t muscle = 1; muscle <= (pair ? 2 : 1); ++muscle)
    add("muscle_pressure", pair ? muscle : 0, read.pressure[muscle - 1],
        [muscle, effects = muscle == 2 ? rig.pair()->opposite.effects : rig.effects](const Sample& row) {
          return effects.shown_Pa(row.side_state(muscle).muscle_pressure_Pa);
        });
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
      const double error = one.simulated(k) - one.measured(k);
      if (std::isnan(error)) continue;
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
