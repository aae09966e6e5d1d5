// See the header.
#include <sim/linear/study.hpp>

namespace mckibben::linear {

bool is_linear(const controllers::Settings& settings) {
  return std::holds_alternative<controllers::PidSettings>(settings) ||
         std::holds_alternative<controllers::LeverPidSettings>(settings) ||
         std::holds_alternative<controllers::PairPidSettings>(settings);
}

Study study(const plant::Rig& rig, double load_kg, const Place& place, const Question& question,
            std::span<const controllers::Settings> controllers) {
  Study result{.point = point_at(rig, load_kg, place, question.threads, question.opening), .loops = {}};
  const Point still = result.point;
  if (question.swing_m_per_s) result.point = still.swinging(*question.swing_m_per_s);
  const Point& point = result.point;
  const auto add = [&](const std::string& name, const System& open) -> Loop& {
    return result.loops.emplace_back(name, open, margins_of(open));
  };
  // Also of a loop that a small swing's friction steadies: larger ones grow.
  const auto calm = [&](Loop& loop, const controllers::PidForm& pid,
                        const controllers::CommandFilter* filter = nullptr) {
    const bool stable = question.swing_m_per_s ? margins_of(loop_of(still, pid, rig.tick_s, filter)).stable
                                               : loop.margins.stable;
    if (!stable) loop.calmed_m_per_s = calmed_m_per_s(still, pid, rig.tick_s, filter);
  };
  for (const controllers::Settings& each : controllers) {
    if (!is_linear(each)) continue;
    const auto& pid = *controllers::part_of<controllers::PidForm>(each);
    const auto* filter = filter_of(each);
    calm(add(name_of(each), loop_of(point, pid, rig.tick_s, filter)), pid, filter);
  }
  if (question.margins)
    if (const auto found = pid_by_margins(point, rig.tick_s, *question.margins)) {
      result.by_margins = found->gains;
      Loop& loop = add("pid_by_margins", loop_of(point, pid_of(found->gains), rig.tick_s));
      loop.binds = found->gain_binds ? "gain" : "phase";
      loop.binds_rad_per_s = found->binds_rad_per_s;
      loop.left_rad = found->left_rad;
      loop.shortest = found->shortest;
      calm(loop, pid_of(found->gains));
    }
  if (question.lqr) {
    const Regulator regulator = lqr(point, rig.tick_s, question.lqr->position, question.lqr->command);
    result.lqr = regulator.gain;
    result.lqr_before = regulator.before;
    add("lqr", regulator.loop);
  }
  return result;
}

}  // namespace mckibben::linear
