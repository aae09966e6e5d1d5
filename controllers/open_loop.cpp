// The two ways of the thesis's controller.
#include <controllers/kept_safe.hpp>
#include <controllers/open_loop.hpp>
#include <controllers/waveform.hpp>

namespace mckibben::controllers {
namespace {

class Trajectory final : public CalibratedController {
 public:
  using CalibratedController::CalibratedController;

 private:
  double first_mA() override { return begin_mA(knowledge().target_at(0)); }
  double drive_mA(const Reading& reading) override { return follow_mA(knowledge().target_at(reading.tick)); }
};

// One triangle at the speed of current that T 4.38 or T 4.45 gives. Going up, its top is the current for the
// target; going down, it starts from the span current and passes the target's on its way.
class ToOnePoint final : public CalibratedController {
 public:
  ToOnePoint(const OpenLoopSettings& settings, const Knowledge& knowledge)
      : CalibratedController(settings, knowledge),
        ratio_(settings.to.ratio(knowledge.model.rest_length_m)),
        speed_per_s_(settings.speed_per_s),
        slowest_mA_per_s_(settings.model.range.lowest_speed_mA_per_s) {}

  std::vector<Finding> findings() const override {
    std::vector<Finding> found = CalibratedController::findings();
    found.push_back({"target_current", "mA", target_mA_});
    found.push_back({"current_speed", "mA/s", wave_.speed_mA_per_s.value_or(0.0)});
    found.push_back({"arrival", "s", arrival_s_});
    return found;
  }

 private:
  void prepare() override {
    const Branch branch = speed_per_s_ > 0.0 ? Branch::contraction : Branch::relaxation;
    const double nu = inverse()(branch, ratio_, speed_per_s_).current_speed_mA_per_s;
    const ValveLine& valve = knowledge().valve;
    target_mA_ = ask_mA(branch, ratio_, speed_per_s_);
    wave_.low_mA = valve.zero_current_mA;
    wave_.high_mA = branch == Branch::contraction ? target_mA_ : valve.span_current_mA;
    wave_.speed_mA_per_s = nu > 0.0 ? nu : slowest_mA_per_s_;
    wave_.cycles = 1.0;
    arrival_s_ = (2.0 * wave_.high_mA - target_mA_ - wave_.low_mA) / *wave_.speed_mA_per_s;
  }
  double first_mA() override { return wave_.low_mA; }
  double drive_mA(const Reading& reading) override {
    return wave_.high_mA > wave_.low_mA ? wave_.at(reading.time_s) : wave_.low_mA;
  }

  double ratio_, speed_per_s_, slowest_mA_per_s_;
  TriangleCurrent wave_;
  double target_mA_ = 0.0, arrival_s_ = 0.0;
};

}  // namespace

std::unique_ptr<Controller> OpenLoopSettings::make(const Knowledge& knowledge) const {
  return kept_safe(*this, knowledge, [&](const Knowledge& known) -> std::unique_ptr<Controller> {
    if (mode == OpenLoopMode::triangle) return std::make_unique<ToOnePoint>(*this, known);
    return std::make_unique<Trajectory>(*this, known);
  });
}

}  // namespace mckibben::controllers
