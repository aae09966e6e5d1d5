// The loop and its watchdog; see the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/bench/loop.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::bench {
namespace {

/// Ends the loop; the valve vents.
class Stop : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Loop {
 public:
  Loop(Device& device, controllers::Controller& controller, const LoopPlan& plan, Clock& clock)
      : device_(device),
        controller_(controller),
        plan_(plan),
        clock_(clock),
        first_(-controller.preparation_ticks()),
        begin_(first_ - std::lround(plan.rig.settling_time_s / plan.rig.tick_s)),
        begin_s_(clock.now_s() + plan.rig.tick_s) {
    const double per_count = plant::count_height_m(plan.rig) / plan.rig.muscle.rest_length_m;
    largest_jump_ = std::ceil(plan.fastest_load_per_s * plan.rig.tick_s / per_count);
    recorded_.rows.reserve(static_cast<std::size_t>(plan.ticks));
  }

  Recorded operator()() {
    try {
      all_ticks();
    } catch (const std::runtime_error& why) {  // of the device, the controller, or the watchdog
      recorded_.stopped = why.what();
    }
    try {
      device_.put(plan_.rig.dac.lowest_command, clock_.now_s());
    } catch (const DeviceFailure& failure) {
      recorded_.stopped += fmt::format("{}and it could not be told to vent: {}",
                                       recorded_.stopped.empty() ? "" : "; ", failure.what());
    }
    recorded_.findings = run::findings_for(controller_, plan_.rig);
    return std::move(recorded_);
  }

 private:
  void all_ticks() {
    double wanted_mA = controller_.rest().current_mA;
    for (std::int64_t k = begin_; k < plan_.ticks; ++k) {
      const double late_s = wait_for(k);
      const std::int64_t counts = believable(device_.counts(clock_.now_s()), k);
      if (k >= first_)
        wanted_mA = controller_.step({k, static_cast<double>(k) * plan_.rig.tick_s, counts}).current_mA;
      const double current_mA = allowed(wanted_mA);
      device_.put(current_mA, clock_.now_s());
      if (k >= 0) recorded_.rows.push_back({k, current_mA, counts, late_s});
    }
    wait_for(plan_.ticks);  // the last current has its tick, too
  }

  /// How late the tick begins. One that is over before it begins is missed; the next ones may catch up.
  double wait_for(std::int64_t k) {
    if (plan_.stop && plan_.stop()) {
      recorded_.by_user = true;
      throw Stop("stopped by the user");
    }
    const double at_s = begin_s_ + static_cast<double>(k - begin_) * plan_.rig.tick_s;
    clock_.wait_until(at_s);
    const double late_s = std::max(clock_.now_s() - at_s, 0.0);
    missed_in_a_row_ = late_s > plan_.rig.tick_s ? missed_in_a_row_ + 1 : 0;
    if (missed_in_a_row_ > 0) ++recorded_.missed_ticks;
    if (missed_in_a_row_ > plan_.most_missed_ticks)
      throw Stop(fmt::format("watchdog: {} ticks in a row were missed, up to tick {}", missed_in_a_row_, k));
    return late_s;
  }

  std::int64_t believable(std::int64_t counts, std::int64_t k) {
    if (k > begin_ &&
        std::abs(static_cast<double>(counts - counts_)) > largest_jump_ * (1 + missed_in_a_row_))
      throw Stop(fmt::format("watchdog: counts jump from {} to {} at tick {}", counts_, counts, k));
    return counts_ = counts;
  }

  double allowed(double wanted_mA) {
    if (!std::isfinite(wanted_mA)) throw Stop("the controller's command is no number");
    const double allowed_mA = std::clamp(wanted_mA, plan_.limits.lowest_mA, plan_.limits.highest_mA);
    if (allowed_mA != wanted_mA) ++recorded_.limited_ticks;
    return controller_.already_quantised() ? allowed_mA : plant::dac_output_mA(plan_.rig.dac, allowed_mA);
  }

  Device& device_;
  controllers::Controller& controller_;
  const LoopPlan& plan_;
  Clock& clock_;
  std::int64_t first_, begin_;
  double begin_s_, largest_jump_ = 0.0;
  int missed_in_a_row_ = 0;
  std::int64_t counts_ = 0;
  Recorded recorded_;
};

}  // namespace

Recorded drive(Device& device, controllers::Controller& controller, const LoopPlan& plan, Clock& clock) {
  return Loop(device, controller, plan, clock)();
}

}  // namespace mckibben::bench
