// What one run leaves behind: a row for each tick, and sums.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <controllers/controller.hpp>
#include <plant/signals.hpp>
#include <sim/engine/integrator.hpp>

namespace mckibben::run {

using plant::Driven;
using plant::Sample;

/// A tick's time without the rounding of k * 0.012, which would fill a column with digits.
inline double tidy_s(double time_s) {
  return std::round(time_s * 1e9) / 1e9;
}

/// Lowest and highest of what a run came through.
struct Span {
  double low = 0.0, high = 0.0;
};

/// Of one row or more.
Span span_of(const std::vector<Sample>& rows, const auto& value) {
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

struct Recording {
  std::vector<Sample> samples;
  plant::Ledger<double> ledger{};  ///< from the first tick to the last, if it was kept
  plant::Imbalance imbalance{};    ///< what that ledger leaves unexplained
  engine::Counters solver;
  double largest_contraction_ratio = 0.0;  ///< at any tick
  double left_speed = 0.0;  ///< of a run that is to begin at rest, after settling [1/s, of an angle rad/s]
  std::string
      failure{};  ///< why it ends early: the integrator or the controller gave up; empty if it did not
  std::vector<controllers::Finding> findings{};  ///< what the controller found out
  double controller_s = 0.0;  ///< that the controller itself took, planning included, by the machine's clock
  Driven driven{};
  std::vector<Slack> slack{};  ///< of a pair, a lever, a given length, or under a force from outside

  /// One more row.
  void take(const Sample& row) {
    samples.push_back(row);
    largest_contraction_ratio =
        std::max({largest_contraction_ratio, row.contraction_ratio, row.opposite.contraction_ratio});
  }
};

/// Of a run that cannot begin: what hangs on the rig, its load_offset included, has no mass.
Recording without_load();

/// Notes where cords would have to push: of a pair or a lever, at a given length, or under a force from
/// outside.
void note_slack(Recording& recording, const plant::Rig& rig);

/// Whether a rig at that speed [1/s, of an angle rad/s] does not rest, as nearly as readings tell.
bool moves(double speed, const plant::Rig& rig);
/// What there is to say of one that is to begin at rest.
std::string still_moves(double speed, const plant::Rig& rig);

/// What should not be believed of a run that came to its end, in words: a ledger that does not close, laws
/// used where no muscle follows them. Empty for nearly all.
std::vector<std::string> doubts(const Recording& recording);

}  // namespace mckibben::run
