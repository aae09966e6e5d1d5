// What a run that came to its end should not be believed without a word.
#include <cmath>

#include <fmt/format.h>

#include <sim/run/recording.hpp>

namespace mckibben::run {
namespace {

/// Share of gas or work that a ledger may leave unexplained: what rigs near the thesis's are kept to.
constexpr double most_imbalance = 1e-6;

/// Below the atmosphere by more than this [Pa], a tube no longer fills its braid.
constexpr double suction_Pa = 100.0;

/// A push below this [N] is nobody's: a muscle without pressure, held by friction's floor.
constexpr double noticed_N = 0.01;

void note_slack_of(Recording& recording, std::size_t muscle) {
  Slack slack{.muscle = static_cast<int>(muscle)};
  for (const Sample& row : recording.samples) {
    const double now_N = row.side(muscle).cord_force_N;
    if (now_N >= 0.0) continue;
    if (slack.rows++ == 0) slack.from_s = row.time_s;
    if (now_N < slack.lowest_N) slack.lowest_N = now_N, slack.lowest_at_s = row.time_s;
  }
  if (slack.rows > 0) recording.slack.push_back(slack);
}

}  // namespace

Recording without_load() {
  Recording none;
  none.failure = "load and load_offset of the rig leave no load";
  return none;
}

void note_slack(Recording& recording, const plant::Rig& rig) {
  const Driven& driven = recording.driven;
  if (rig.has_angle() || driven.length || driven.joint_force) note_slack_of(recording, 1);
  if (driven.pair) note_slack_of(recording, 2);
}

bool moves(double speed, const plant::Rig& rig) {
  constexpr double still_per_s = 2e-3, still_rad_per_s = 0.02;
  return std::abs(speed) > (rig.has_angle() ? still_rad_per_s : still_per_s);
}

std::string still_moves(double speed, const plant::Rig& rig) {
  return fmt::format(
      "is to begin at rest, and after settling_time ({:.4g} s) still moves at {:.2g} {}: a longer "
      "settling_time of the rig",
      rig.settling_time_s, std::abs(speed), rig.has_angle() ? "rad/s" : "of its length a second");
}

std::vector<std::string> doubts(const Recording& recording) {
  std::vector<std::string> found;
  const auto& [gas, energy] = recording.imbalance;
  if (!(std::max(gas, energy) <= most_imbalance))
    found.push_back(fmt::format(
        "the ledger leaves {:.2g} of the gas and {:.2g} of the work unexplained, more than {:g}: the "
        "integration is no more exact than that; a tighter integrator.tolerance helps",
        gas, energy, most_imbalance));
  for (const Slack& slack : recording.slack) {
    if (-slack.lowest_N < noticed_N) continue;
    found.push_back(
        fmt::format("the cord of muscle {} would have to push, from {:.3f} s on in {} of {} rows, by up to "
                    "{:.3g} N at {:.3f} s: a real one goes slack there, here it is taken as taut",
                    slack.muscle, slack.from_s, slack.rows, recording.samples.size(), -slack.lowest_N,
                    slack.lowest_at_s));
  }
  if (recording.samples.empty()) return found;
  const auto lowest = std::min_element(
      recording.samples.begin(), recording.samples.end(), [](const Sample& a, const Sample& b) {
        return a.state.side.muscle_pressure_Pa < b.state.side.muscle_pressure_Pa;
      });
  if (recording.driven.pressure[0] != plant::GivenPressure::muscle &&
      lowest->state.side.muscle_pressure_Pa < -suction_Pa)
    found.push_back(fmt::format(
        "the muscle's pressure falls to {:.3g} bar below the atmosphere at {:.3f} s, because it grows faster "
        "than the hose fills it: a real tube would collapse there, while the braid law lets it push",
        -lowest->state.side.muscle_pressure_Pa / plant::Pa_per_bar, lowest->time_s));
  return found;
}

}  // namespace mckibben::run
