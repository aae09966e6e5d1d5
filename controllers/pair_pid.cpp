// The loop of one muscle, whose output is the difference; see the header. Contraction ratios are those of
// muscle 1, R theta/l0.
#include <algorithm>

#include <controllers/pair_pid.hpp>

namespace mckibben::controllers {
namespace {

PidTerms terms_of(const PairPidSettings& settings, const Knowledge& known, double width_mA) {
  PidTerms terms;
  static_cast<PidForm&>(terms) = settings;
  if (settings.proportional_mA) terms.proportional_mA = *settings.proportional_mA / ratio_per_rad(known);
  terms.fastest_load_per_s = settings.fastest_load_per_s(known);
  terms.lowest_current_mA = -width_mA;
  terms.highest_current_mA = width_mA;
  return terms;
}

class PairPid final : public Controller {
 public:
  PairPid(const PairPidSettings& settings, const Knowledge& known)
      : co_contraction_(settings, known),
        loop_(terms_of(settings, known, co_contraction_.width_mA()), known) {}

  Command rest() override { return given(0.0); }
  Command step(const Reading& reading) override {
    co_contraction_.begin_tick(reading.tick, difference_mA_);
    return given(loop_.step(reading, 0.0, co_contraction_.differences()));
  }
  std::vector<Finding> findings() const override {
    std::vector<Finding> found;
    loop_.tell(found);
    return found;
  }

 private:
  /// An output that was held may lie outside what goes with the P0 of now.
  Command given(double wanted_mA) {
    const CurrentRange& most = co_contraction_.differences();
    difference_mA_ = std::clamp(wanted_mA, most.lowest_mA, most.highest_mA);
    const Command command = co_contraction_.command(difference_mA_);
    co_contraction_.give(command);
    return command;
  }

  CoContraction co_contraction_;
  PidLoop loop_;
  double difference_mA_ = 0.0;
};

}  // namespace

std::unique_ptr<Controller> PairPidSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<PairPid>(*this, within_angles(knowledge));
}

}  // namespace mckibben::controllers
