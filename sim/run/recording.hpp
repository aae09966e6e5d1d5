// What one run leaves behind: a row for each tick, and sums.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <controllers/controller.hpp>
#include <plant/state.hpp>
#include <sim/engine/integrator.hpp>

namespace mckibben::run {

/// The rig at one tick, before its current is applied. True values, except the two that are read.
struct Sample {
  double time_s;
  double current_mA;  ///< what the DAC gives from here to the next tick
  plant::State<double> state;
  std::int64_t counts;          ///< as the encoder counts
  double gauge_Pa;              ///< as the gauge shows, if one is fitted
  double braid_force_N;         ///< F
  double friction_force_N;      ///< force of the threads on the load, positive upwards
  double effects_pull_N = 0.0;  ///< force of effects on the load, positive upwards
  double cord_force_N = 0.0;    ///< T, what the muscle's cord carries
  double cell_N = 0.0;          ///< as the load cell shows it, if one is fitted
  double misread_ratio = 0.0;   ///< what an encoder shows besides e, before it counts
  /// The same of muscle 2, where there is one; forces positive where they shorten it.
  struct Opposite {
    double current_mA = 0.0;
    double contraction_ratio = 0.0;
    double braid_force_N = 0.0, friction_force_N = 0.0, effects_pull_N = 0.0, cord_force_N = 0.0;
    double gauge_Pa = 0.0;
  };
  Opposite opposite{};
  double stiffness_N_m_per_rad = 0.0;  ///< of the joint of a pair, at the pressures that it has

  double shown_ratio() const { return state.joint.contraction_ratio + misread_ratio; }
};

/// Lowest and highest of what a run came through.
struct Span {
  double low = 0.0, high = 0.0;
};

/// Of one row or more.
template <class Value>
Span span_of(const std::vector<Sample>& rows, const Value& value) {
  const auto [low, high] = std::minmax_element(
      rows.begin(), rows.end(), [&](const auto& a, const auto& b) { return value(a) < value(b); });
  return {value(*low), value(*high)};
}

/// A cord that would have to push: a real one goes slack, the equations take it as taut.
struct Slack {
  int muscle = 1;
  double from_s = 0.0;  ///< first
  std::size_t rows = 0;
  double lowest_N = 0.0, lowest_at_s = 0.0;
};

/// What drove a rig, where it was not a current to the valve of one muscle that lifts a load.
struct Driven {
  bool pair = false, length = false;  ///< two muscles; the length of one is given
  std::array<bool, 2> pressure{};     ///< of each muscle: its pressure is given, and it has no valve
};

struct Recording {
  std::vector<Sample> samples;
  plant::Ledger<double> ledger{};  ///< from the first tick to the last, if it was kept
  plant::Imbalance imbalance{};    ///< what that ledger leaves unexplained
  engine::Counters solver;
  double largest_contraction_ratio = 0.0;  ///< at any tick
  std::string
      failure{};  ///< why it ends early: the integrator or the controller gave up; empty if it did not
  std::vector<controllers::Finding> findings{};  ///< what the controller found out
  double controller_s = 0.0;  ///< that the controller itself took, planning included, by the machine's clock
  Driven driven{};
  std::vector<Slack> slack{};  ///< of a pair, or of a muscle whose length is given
};

/// What should not be believed of a run that came to its end, in words: a ledger that does not close, laws
/// used where no muscle follows them. Empty for nearly all.
std::vector<std::string> doubts(const Recording& recording);

}  // namespace mckibben::run
