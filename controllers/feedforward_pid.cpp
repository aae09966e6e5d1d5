// The inverse's current is the base of the PID's output; without error the output is the inverse's. The loop
// is closed as soon as the load is known.
#include <controllers/feedforward_pid.hpp>

namespace mckibben::controllers {
namespace {

class FeedforwardPid final : public CalibratedController {
 public:
  FeedforwardPid(const FeedforwardPidSettings& settings, const Knowledge& known)
      : CalibratedController(settings, known), loop_(settings, known) {}

 private:
  double first_mA() override { return loop_.clamped(begin_mA(knowledge().target_at(0))); }
  double settle_mA(const Reading& reading, double way_mA) override { return loop_.step(reading, way_mA); }
  double drive_mA(const Reading& reading) override {
    return loop_.step(reading, follow_mA(knowledge().target_at(reading.tick)));
  }

  PidLoop loop_;
};

}  // namespace

std::unique_ptr<Controller> FeedforwardPidSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<FeedforwardPid>(*this, knowledge);
}

}  // namespace mckibben::controllers
