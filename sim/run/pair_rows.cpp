// Muscle 2, the joint, and slack cords; see the header.
#include <algorithm>

#include <plant/instruments.hpp>
#include <plant/joint_stiffness.hpp>
#include <sim/run/pair_rows.hpp>

namespace mckibben::run {
namespace {

template <class Force>
void note_slack_of(Recording& recording, int muscle, const Force& force_N) {
  Slack slack{.muscle = muscle};
  for (const Sample& row : recording.samples) {
    const double now_N = force_N(row);
    if (now_N >= 0.0) continue;
    if (slack.rows++ == 0) slack.from_s = row.time_s;
    if (now_N < slack.lowest_N) slack.lowest_N = now_N, slack.lowest_at_s = row.time_s;
  }
  if (slack.rows > 0) recording.slack.push_back(slack);
}

}  // namespace

double write_opposite(const ride::Rider& rider, const plant::Moment<double>& now, const ride::Reading& seen,
                      Sample& row) {
  const auto& state = rider.now.flow.state;
  row.opposite = {.current_mA = rider.now.drive.opposite.current_mA,
                  .contraction_ratio = rider.plant().opposite_stroke(state).contraction_ratio,
                  .braid_force_N = now.opposite.braid_force_N,
                  .friction_force_N = now.opposite.friction_force_N,
                  .effects_pull_N = now.opposite.effects_pull_N,
                  .cord_force_N = now.opposite.cord_force_N(),
                  .gauge_Pa = plant::gauge_reading_Pa(rider.plant().rig().gauge, seen.opposite_pressure_Pa)};
  row.stiffness_N_m_per_rad =
      plant::joint_stiffness_N_m_per_rad(rider.plant(), state, rider.now.flow.memory, rider.now.held);
  return std::max(state.joint.contraction_ratio, row.opposite.contraction_ratio);
}

void note_slack(Recording& recording, bool both) {
  note_slack_of(recording, 1, [](const Sample& row) { return row.cord_force_N; });
  if (both) note_slack_of(recording, 2, [](const Sample& row) { return row.opposite.cord_force_N; });
}

}  // namespace mckibben::run
