// Heights against the ends of the load's way, speeds against the largest there; see the header.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <sim/run/unreachable.hpp>

namespace mckibben::run {
namespace {

class Looking {
 public:
  Looking(const controllers::Reach& reach, const controllers::ReachOfLoad& limits, double tolerance)
      : reach_(reach), limits_(limits), tolerance_(tolerance) {}

  /// One tick: from a contraction ratio to the next at a speed, signed; `up` also while it rests.
  void tick(double from, double to, double speed_per_s, bool up) {
    ++found_.of_ticks;
    const double lowest = up ? limits_.lowest_rising : limits_.lowest_falling;
    const double largest_per_s =
        reach_.empty() ? std::numeric_limits<double>::infinity()
                       : reach_.at_ratio(up ? limits_.rising_per_s : limits_.falling_per_s, from);
    const double asked_per_s = std::abs(speed_per_s);
    constexpr double rounding = 1e-9;
    if (to > limits_.highest + tolerance_)
      found_.too_high.note(to, limits_.highest, to, up);
    else if (to < lowest - tolerance_)
      found_.too_low.note(to, lowest, to, up);
    else if (asked_per_s > largest_per_s * (1.0 + rounding))
      found_.too_fast.note(asked_per_s, largest_per_s, from, up);
    else
      return;
    ++found_.ticks;
  }
  Unreachable found() const { return found_; }

 private:
  const controllers::Reach& reach_;
  const controllers::ReachOfLoad& limits_;
  double tolerance_;
  Unreachable found_;
};

void join(std::string& text, const std::string& more) {
  text += (text.empty() ? "" : "; ") + more;
}

}  // namespace

void Beyond::note(double asked_here, double limit_here, double ratio_here, bool up_here) {
  // Speeds differ in their limits, heights only in what is asked.
  const bool worse = ticks == 0 || std::abs(asked_here - limit_here) > std::abs(asked - limit);
  ++ticks;
  if (worse) {
    asked = asked_here;
    limit = limit_here;
    ratio = ratio_here;
    up = up_here;
  }
}

Unreachable Unreachable::heights() const {
  Unreachable all = *this;
  all.ticks -= too_fast.ticks;
  all.ticks_without_current_speed = 0;
  all.too_fast = {};
  return all;
}

Unreachable Unreachable::speeds() const {
  Unreachable all = *this;
  all.ticks = too_fast.ticks;
  all.too_high = all.too_low = {};
  return all;
}

std::string Unreachable::text() const {
  std::string what, helps;
  if (too_fast.ticks > 0) {
    join(what,
         fmt::format("{} too fast: going {} at a contraction ratio of {:.3f} it asks {:.3g} /s, the largest "
                     "reachable speed there is {:.3g} /s",
                     too_fast.ticks, too_fast.up ? "up" : "down", too_fast.ratio, too_fast.asked,
                     too_fast.limit));
    join(helps, too_fast.up ? "a slower target, a higher supply pressure or a wider valve and hose"
                            : "a slower target, or a wider valve and hose");
  }
  if (too_high.ticks > 0) {
    join(what, fmt::format("{} too high: it asks a contraction ratio of {:.3f}, the largest reachable one, "
                           "coming slowly, is {:.3f}",
                           too_high.ticks, too_high.asked, too_high.limit));
    join(helps, "a lower height, a lighter load, or a higher span (and supply) pressure");
  }
  if (too_low.ticks > 0) {
    join(what,
         fmt::format(
             "{} too low: it asks a contraction ratio of {:.3f}, the smallest reachable one {} is {:.3f}",
             too_low.ticks, too_low.asked, too_low.up ? "from below" : "from above, held by the threads,",
             too_low.limit));
    join(helps, "a target that stays higher, a heavier load, or a lower zero pressure of the valve");
  }
  std::string text;
  if (ticks > 0)
    text = fmt::format("the target is out of reach at {} of {} ticks ({})", ticks, of_ticks, what);
  if (ticks_without_current_speed > 0) {
    text += fmt::format("{} {} tick{} the calibrated model has no current speed for the target's",
                        ticks > 0 ? ", and at" : "at", ticks_without_current_speed,
                        ticks_without_current_speed == 1 ? "" : "s");
    if (too_fast.ticks == 0) join(helps, "a slower target, or a calibration with faster currents");
  }
  return text + ". What would help: " + helps;
}

Unreachable unreachable(const std::vector<double>& target, double tick_s, const controllers::Reach& reach,
                        const controllers::ReachOfLoad& limits, double tolerance) {
  Looking looking(reach, limits, tolerance);
  bool up = true;
  for (std::size_t k = 0; k < target.size(); ++k) {
    const double before = target[k > 0 ? k - 1 : 0], step = target[k] - before;
    if (step != 0.0) up = step > 0.0;
    looking.tick(before, target[k], step / tick_s, up);
  }
  return looking.found();
}

Unreachable unreachable(double ratio, double speed_per_s, const controllers::Reach& reach,
                        const controllers::ReachOfLoad& limits) {
  Looking looking(reach, limits, 0.0);
  looking.tick(ratio, ratio, speed_per_s, speed_per_s > 0.0);
  return looking.found();
}

}  // namespace mckibben::run
