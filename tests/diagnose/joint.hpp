// A joint whose answer is known: two muscles that turn a link, their pressures given or their commands, the
// angle read.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include <sim/data/judged.hpp>
#include <sim/diagnose/candidate.hpp>
#include <sim/diagnose/predict.hpp>

namespace mckibben::diagnose {

/// What drives the two sides of run `i` after so long: against each other and together, each run otherwise;
/// within 0 to 1.
inline std::array<double, 2> shares_at(std::size_t i, double time_s) {
  const double run = static_cast<double>(i), turn = 2.0 * std::numbers::pi * time_s;
  const double turning = i % 2 == 0 ? std::sin(turn / (1.1 + 0.3 * run))
                                    : std::clamp(1.6 * std::sin(turn / (1.5 + 0.2 * run)), -1.0, 1.0);
  const double together = 0.45 + 0.08 * (run - 2.0) / 2.0 + 0.1 * std::sin(turn / 3.7 + run);
  return {together + 0.25 * turning, together - 0.25 * turning};
}

struct JointNoise {
  double angle_rad = 1e-3, pressure_Pa = 100.0;
  std::uint64_t seed = 11;
  solver::Method method = solver::Method::automatic;  ///< by which the readings are made
};

/// Five runs of 1.9 s, under commands, which tell less, of 2.6 s; a row each 12 ms; readings of `truth` with
/// noise, handed over with the shipped pair. `commands`: currents drive it, and nothing else is known of the
/// pressures.
inline domain::Dataset of_a_joint(const Rig& truth, bool commands = false, JointNoise noise = {}) {
  std::mt19937_64 random(noise.seed);
  std::normal_distribution<double> normal;
  domain::Dataset data;
  data.rig = plant::thesis_pair();
  data.own_clock = true;
  data.path = "joint/dataset.yaml";
  for (std::size_t i = 0; i < 5; ++i) {
    domain::Run& run = data.runs.emplace_back();
    run.id = fmt::format("r{}", i + 1);
    domain::Measurement& measured = run.measured.emplace();
    for (std::size_t k = 0; k < (commands ? 220u : 160u); ++k) {
      measured.time_s.push_back(0.012 * static_cast<double>(k));
      const auto shares = shares_at(i, measured.time_s.back());
      for (std::size_t side = 0; side < 2; ++side) {
        if (commands)
          measured.give("command", side + 1).push_back(4.0 + 16.0 * shares[side]);
        else
          measured.give("muscle_pressure", side + 1).push_back(5e5 * shares[side]);
      }
    }
    const Loaded pair{truth};
    run.read("angle");
    measured.take("angle") = predict(run, {&pair, 1}, noise.method).front().judged();
    run.readings.clear();
    for (double& angle_rad : measured.take("angle")) angle_rad += noise.angle_rad * normal(random);
    for (domain::MeasuredColumn& column : measured.columns)
      if (column.channel.is_pressure())
        for (double& pressure_Pa : column.values) pressure_Pa += noise.pressure_Pa * normal(random);
  }
  return data::with_rows(std::move(data));
}

/// The same joint seen from behind: muscle 1 is muscle 2, and the angle turns the other way.
inline domain::Dataset mirrored(domain::Dataset data) {
  for (domain::Run& run : data.runs) {
    for (domain::MeasuredColumn& column : run.measured->columns)
      if (column.channel.muscle > 0) column.channel.muscle = 3 - column.channel.muscle;
    for (double& angle_rad : run.judged().values) angle_rad = -angle_rad;
  }
  return data;
}

/// The shipped pair with the same effect on both sides.
template <class E>
Rig pair_with(const E& effect) {
  Rig rig = plant::thesis_pair();
  each_side(rig, [&](plant::Effects& effects) { effects.get<E>() = effect; });
  return rig;
}

/// The same on one.
template <class E>
Rig pair_with(const E& effect, Side side) {
  Rig rig = plant::thesis_pair();
  each_side(
      rig, [&](plant::Effects& effects) { effects.get<E>() = effect; }, side);
  return rig;
}

}  // namespace mckibben::diagnose
