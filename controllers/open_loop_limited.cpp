// Slowed target, then the inverse with the lag taken out of its pressure and put into the time.
//
// The calibrated pressure is the valve's reference, not the muscle's: at a current speed nu it contains the
// s nu L by which the muscle stays behind in a ramp. That is right for a ramp of that speed, wrong as soon as
// the target turns or rests. So s nu L is taken off, which leaves the muscle's own pressure, and it is asked
// for L earlier, which is right for any target that changes little within L.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <controllers/kept_safe.hpp>
#include <controllers/open_loop_limited.hpp>

namespace mckibben::controllers {
namespace {

class Limited final : public CalibratedController {
 public:
  Limited(const CalibratedSettings& settings, const Knowledge& known)
      : CalibratedController(settings, known) {}

  std::vector<Finding> findings() const override {
    std::vector<Finding> found = CalibratedController::findings();
    const auto& target = knowledge().target;
    double furthest = 0.0;
    for (std::size_t k = 0; k < followed_.size(); ++k)
      furthest = std::max(furthest, std::abs(followed_[k] - target[k]));
    found.push_back({"target_moved_by_at_most", "1", furthest});
    return found;
  }

 private:
  void prepare() override {
    reach_ = knowledge().reach.at_load(load_kg());
    followed_ = slowed(knowledge().target, knowledge().tick_s, knowledge().reach, reach_);
  }
  double first_mA() override { return begin_mA(at(0.0), lag_s(Branch::contraction, at(0.0))); }

  double drive_mA(const Reading& reading) override {
    const auto now = static_cast<double>(reading.tick);
    const double e = at(now);
    const double falling_lag_s = lag_s(Branch::relaxation, e), rising_lag_s = lag_s(Branch::contraction, e);
    const double falling = now + falling_lag_s / knowledge().tick_s;
    const double rising = now + rising_lag_s / knowledge().tick_s;
    if (speed_per_s(falling) < 0.0)
      return ask_mA(Branch::relaxation, at(falling), speed_per_s(falling), falling_lag_s);
    if (speed_per_s(rising) > 0.0)
      return ask_mA(Branch::contraction, at(rising), speed_per_s(rising), rising_lag_s);
    return current_mA();
  }

  // Half a tick is added: a current is held for a tick, so on average it is that old.
  double lag_s(Branch branch, double e) const {
    const auto& column = branch == Branch::contraction ? reach_.rising_lag_s : reach_.falling_lag_s;
    return knowledge().reach.at_ratio(column, e) + 0.5 * knowledge().tick_s;
  }

  // The slowed target between two ticks, and its speed over the tick before.
  double at(double tick) const {
    if (followed_.empty()) return 0.0;
    const double inside = std::clamp(tick, 0.0, static_cast<double>(followed_.size() - 1));
    const auto before = static_cast<std::size_t>(inside);
    const auto after = std::min(before + 1, followed_.size() - 1);
    return std::lerp(followed_[before], followed_[after], inside - static_cast<double>(before));
  }
  double speed_per_s(double tick) const { return (at(tick) - at(tick - 1.0)) / knowledge().tick_s; }

  ReachOfLoad reach_;
  std::vector<double> followed_;
};

}  // namespace

std::unique_ptr<Controller> OpenLoopLimitedSettings::make(const Knowledge& knowledge) const {
  if (knowledge.reach.empty()) throw std::invalid_argument(name + ": what is reachable was not computed");
  return kept_safe(*this, knowledge,
                   [&](const Knowledge& known) { return std::make_unique<Limited>(*this, known); });
}

}  // namespace mckibben::controllers
