// The loop and its watchdog; see the header.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/bench/counts.hpp>
#include <sim/bench/hosted.hpp>
#include <sim/bench/loop.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::bench {
namespace {

/// Ends the loop; the valve vents.
class Stop : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Loop {
 public:
  Loop(Device& device, std::unique_ptr<controllers::Controller> controller, const LoopPlan& plan,
       Clock& clock)
      : device_(device),
        plan_(plan),
        clock_(clock),
        first_(-controller->preparation_ticks()),
        begin_(first_ - std::lround(plan.rig.settling_time_s / plan.rig.tick_s)),
        quantised_(controller->already_quantised()),
        counts_(plan.rig, plan.load_kg),
        controller_(std::move(controller), {plan.rig, first_, plan.longest_silence_s,
                                            [this] {  // twice: the loop may have died within a line
                                              vent();
                                              vent();
                                            }}) {
    recorded_.rows.reserve(static_cast<std::size_t>(plan.ticks));
  }

  Recorded operator()() {
    try {
      all_ticks();
    } catch (const std::exception& why) {  // of the device, the controller, or the watchdog
      recorded_.stopped = why.what();
      recorded_.by_user = run::interrupted();
    }
    try {
      vent();
    } catch (const DeviceFailure& failure) {
      recorded_.stopped += fmt::format("{}and it could not be vented: {}",
                                       recorded_.stopped.empty() ? "" : "; ", failure.what());
    }
    try {
      recorded_.findings = controller_.end(until_looks(100));
    } catch (const std::exception& why) {
      if (recorded_.stopped.empty()) recorded_.stopped = why.what();
    }
    return std::move(recorded_);
  }

 private:
  void all_ticks() {
    const double asked_s = clock_.now_s();
    double wanted_mA = controller_.answer([&] {
      look_at_user();
      if (clock_.now_s() > asked_s + plan_.start_limit_s)
        throw Stop(fmt::format("the controller has not begun within {:g} s", plan_.start_limit_s));
    });
    begin_s_ = clock_.now_s() + plan_.rig.tick_s;
    for (std::int64_t k = begin_; k < plan_.ticks; ++k) {
      wait_for(k);
      const double read_s = since_s();
      const std::int64_t counts = device_.counts(read_s);
      const double gauge_Pa = device_.gauge_Pa(read_s);
      counts_.look(counts, k, 1 + missed_in_a_row_);
      controller_.show({k, static_cast<double>(k) * plan_.rig.tick_s, counts});
      wanted_mA = controller_.answer([&] {
        look_at_user();
        if (clock_.now_s() > at_s(k + 2 + plan_.most_missed_ticks))
          throw Stop(fmt::format("watchdog: the controller does not answer at tick {}", k));
      });
      look_at_user();
      const double current_mA = allowed(wanted_mA);
      const double sent_s = since_s();
      device_.put(current_mA, sent_s);
      counts_.put(current_mA);
      if (k < 0) continue;
      recorded_.rows.push_back({k, current_mA, counts, gauge_Pa, read_s, sent_s});
      plan_.record(recorded_.rows.back());
    }
    wait_for(plan_.ticks);  // the last current has its tick, too
  }

  /// A device that is deaf may have thrown away what was waiting, and hear it the second time.
  void vent() {
    try {
      device_.put(plan_.rig.dac.lowest_command, since_s());
    } catch (const DeviceFailure&) {
      device_.put(plan_.rig.dac.lowest_command, since_s());
    }
  }

  static void look_at_user() {
    if (run::interrupted()) throw Stop("stopped by the user");
  }

  /// Gives up once it was called so often.
  static Hosted::Meanwhile until_looks(int most) {
    return [most, looks = 0]() mutable {
      if (++looks > most) throw Stop("the controller does not say what it found out");
    };
  }

  /// Time since tick 0.
  double since_s() const { return clock_.now_s() - at_s(0); }

  double at_s(std::int64_t k) const { return begin_s_ + static_cast<double>(k - begin_) * plan_.rig.tick_s; }

  /// A tick that is over before it begins is missed; the next ones may catch up.
  void wait_for(std::int64_t k) {
    constexpr double look_each_s = 0.05;
    look_at_user();
    for (double now_s; (now_s = clock_.now_s()) < at_s(k); look_at_user())
      clock_.wait_until(std::min(at_s(k), now_s + look_each_s));
    const double late_s = clock_.now_s() - at_s(k);
    missed_in_a_row_ = late_s > plan_.rig.tick_s ? missed_in_a_row_ + 1 : 0;
    if (missed_in_a_row_ > 0) ++recorded_.missed_ticks;
    if (missed_in_a_row_ > plan_.most_missed_ticks)
      throw Stop(
          fmt::format("watchdog: {} ticks of {:g} ms in a row were missed, up to tick {}; the "
                      "rig's tick may be longer, the machine less busy, or --most-missed larger",
                      missed_in_a_row_, 1e3 * plan_.rig.tick_s, k));
  }

  double allowed(double wanted_mA) {
    if (!std::isfinite(wanted_mA)) throw Stop("the controller's command is no number");
    const double allowed_mA = std::clamp(wanted_mA, plan_.limits.lowest_mA, plan_.limits.highest_mA);
    if (allowed_mA != wanted_mA) ++recorded_.limited_ticks;
    return quantised_ ? allowed_mA : plant::dac_output_mA(plan_.rig.dac, allowed_mA);
  }

  Device& device_;
  const LoopPlan& plan_;
  Clock& clock_;
  std::int64_t first_, begin_;
  bool quantised_;
  CountsWatch counts_;
  Hosted controller_;
  double begin_s_ = 0.0;
  int missed_in_a_row_ = 0;
  Recorded recorded_;
};

}  // namespace

Recorded drive(Device& device, std::unique_ptr<controllers::Controller> controller, const LoopPlan& plan,
               Clock& clock) {
  const run::HeldInterrupts held;
  return Loop(device, std::move(controller), plan, clock)();
}

}  // namespace mckibben::bench
