// See the header. The limits are wide: what a rig does that is not as its file says must not be stopped.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/bench/counts.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::bench {
namespace {

// Contraction ratios.
constexpr double farthest_begin = 0.02;   // a load at rest, a counter at 0
constexpr double margin = 0.05;           // beyond the ends of the muscle: cords and bladders give
constexpr double must_be_seen = 0.03;     // of a movement
constexpr double faster_than_fall = 1.5;  // than a load that falls the whole stroke
constexpr std::int64_t no_movement = 2;   // counts
/// Of the valve's range: less a rig may need that sticks, or lifts its load later than its file says.
constexpr double far_command = 0.4;
/// Of the stroke, between the counts and those of the simulated rig, and for how long: effects that a rig
/// file lacks make less (a bladder's elasticity two fifths).
constexpr double far_apart = 0.5, apart_for_s = 1.0;

}  // namespace

CountsWatch::CountsWatch(const plant::Rig& rig, double load_kg)
    : tick_s_(rig.tick_s),
      time_s_(tick_s_),  // a ride has no reading before its first step
      per_count_(run::contraction_per_count(rig)),
      zero_command_(rig.valve.zero_command),
      span_command_(rig.valve.span_command),
      command_(zero_command_) {
  const double length_m = rig.muscle.rest_length_m;
  const double stroke = run::knowledge_of(rig, {}).model.largest_contraction_ratio();
  highest_ratio_ = stroke + margin;
  most_apart_ = far_apart * stroke;
  const double fastest_per_s =
      faster_than_fall * std::sqrt(2.0 * controllers::gravity_m_per_s2 * stroke / length_m);
  largest_jump_ = std::ceil(fastest_per_s * tick_s_ / per_count_);
  if (load_kg > 0.0) twin_.emplace(rig, load_kg, rig.integrator, rig.dac.lowest_command);
}

void CountsWatch::look(std::int64_t counts, std::int64_t tick, int ticks) {
  const auto now = static_cast<double>(counts);  // differences of integers may overflow
  const auto refuse = [](const std::string& why) { throw DeviceFailure("watchdog: " + why); };
  const std::optional<double> expected_now = expected();
  // A simulated counter begins at the muscle's rest length; a light load is above it when the valve vents.
  const double farthest = farthest_begin + std::abs(ratio_of(expected_now.value_or(0.0)));
  if (!last_ && std::abs(ratio_of(now)) > farthest)
    refuse(fmt::format("counts begin at {}, far from 0: they are not of a load at rest and a counter at 0",
                       counts));
  if (last_ && std::abs(now - static_cast<double>(*last_)) > largest_jump_ * ticks)
    refuse(fmt::format("counts jump from {} to {} at tick {}", *last_, counts, tick));
  if (ratio_of(now) > highest_ratio_ || ratio_of(now) < -margin)
    refuse(
        fmt::format("counts are {} at tick {}, a contraction ratio of {:.3f}: the muscle can do {:.3f} "
                    "to {:.3f}",
                    counts, tick, ratio_of(now), -margin, highest_ratio_));
  if (!last_ || std::abs(counts - still_) > no_movement) {
    still_ = counts;
    still_since_ = tick;
    expected_then_ = expected_now;
    command_then_ = command_;
  }
  last_ = counts;
  if (!expected_now || !expected_then_) return;
  if (!offset_) offset_ = now - *expected_now;
  const double should_be = *expected_now + *offset_;
  if (std::abs(ratio_of(now - should_be)) <= most_apart_) near_until_ = tick;
  if (static_cast<double>(tick - near_until_) * tick_s_ > apart_for_s)
    refuse(fmt::format(
        "counts are {} at tick {} where those of the scenario's rig would be {:.0f}; for {:g} s they "
        "were further apart than half of what the muscle can do: wrong counts, a load that is held, or "
        "another rig than the file says",
        counts, tick, should_be, apart_for_s));
  const double moved = ratio_of(*expected_now - *expected_then_);
  if (std::abs(moved) > must_be_seen &&
      std::abs(command_ - command_then_) > far_command * (span_command_ - zero_command_))
    refuse(fmt::format(
        "counts stay at {} from tick {} to {}, while the command went from {:.3f} to {:.3f} and "
        "must have moved the load by {:.3f} of the muscle: a dead encoder, or a load that is held",
        counts, still_since_, tick, command_then_, command_, moved));
}

/// What the counts should be, at the next tick each time.
std::optional<double> CountsWatch::expected() {
  const double now_s = std::exchange(time_s_, time_s_ + tick_s_);
  try {
    if (twin_) return static_cast<double>(twin_->counts(now_s));
  } catch (const DeviceFailure&) {  // it cannot be simulated
    twin_.reset();
  }
  return std::nullopt;
}

void CountsWatch::put(double current_mA) {
  command_ = std::clamp(current_mA, zero_command_, span_command_);
  if (twin_) twin_->put(current_mA, time_s_ - tick_s_);
}

}  // namespace mckibben::bench
