// Limits around somebody else's program; see the header.
#include <algorithm>
#include <cmath>

#include <controllers/guest.hpp>
#include <controllers/kept_safe.hpp>
#include <controllers/line.hpp>

namespace mckibben::controllers {
namespace {

GuestTerms followed_by(GuestTerms terms, const Knowledge& known) {
  terms.follow(working_range(known));
  return terms;
}

}  // namespace

Guest::Guest(const GuestTerms& terms, const Knowledge& known)
    : terms_(followed_by(terms, known)),
      known_(allowed(terms_, known)),
      range_(terms_.within(known)),
      believed_(terms.fastest_load_per_s, known),
      before_mA_(range_.lowest_mA) {}

double Guest::obeyed_mA(double asked_mA, const CurrentRange& reach) {
  if (!std::isfinite(asked_mA)) throw ControllerFailure("its command is no finite number");
  before_mA_ = std::clamp(asked_mA, reach.lowest_mA, reach.highest_mA);
  if (before_mA_ != asked_mA) ++limited_ticks_;
  return before_mA_;
}

Command Guest::rest() {
  try {
    return {obeyed_mA(begin_mA(), range_)};
  } catch (const ControllerFailure& failure) {
    could_not_begin_ = failure.what();
    return {range_.lowest_mA};
  }
}

Command Guest::step(const Reading& reading) {
  if (!could_not_begin_.empty()) throw ControllerFailure("before the run: " + could_not_begin_);
  Told told{reading, false, known_.target_at(reading.tick)};
  told.reading.time_s = std::round(reading.time_s * 1e9) / 1e9;  // without the rounding of k * 0.012
  told.reading.counts = believed_(reading.counts);
  told.counts_lost = believed_.lost();
  try {
    return {obeyed_mA(answer_mA(told), terms_.within_reach(range_, before_mA_, known_.tick_s))};
  } catch (const ControllerFailure& failure) {
    throw ControllerFailure(at_tick(told.reading) + failure.what());
  }
}

std::vector<Finding> Guest::findings() const {
  std::vector<Finding> found;
  if (limited_ticks_ > 0) found.push_back({"ticks_limited", "1", static_cast<double>(limited_ticks_)});
  believed_.tell(found);
  return found;
}

std::string at_tick(const Reading& reading) {
  std::string text = "tick ";
  append(text, reading.tick);
  text += " (";
  append(text, std::round(1e9 * reading.time_s) / 1e9);  // k * 0.012 has digits of rounding
  return text + " s): ";
}

}  // namespace mckibben::controllers
