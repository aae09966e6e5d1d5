// See the header.
#include <algorithm>

#include <controllers/kept_safe.hpp>

namespace mckibben::controllers {
namespace {

class KeptSafe final : public Controller {
 public:
  KeptSafe(const SafetyTerms& terms, const Knowledge& knowledge, std::unique_ptr<Controller> inside)
      : terms_(terms),
        inside_(std::move(inside)),
        range_{std::min(0.0, knowledge.valve.zero_current_mA), knowledge.largest_current_mA},
        tick_s_(knowledge.tick_s),
        believed_(terms.fastest_load_per_s, knowledge) {}

  Command rest() override {
    const Command command = inside_->rest();
    before_mA_ = command.current_mA;
    return command;
  }
  std::int64_t preparation_ticks() const override { return inside_->preparation_ticks(); }
  Command step(const Reading& reading) override {
    Reading shown = reading;
    shown.counts = believed_(reading.counts);
    const CurrentRange reach = terms_.within_reach(range_, before_mA_, tick_s_);
    before_mA_ = std::clamp(inside_->step(shown).current_mA, reach.lowest_mA, reach.highest_mA);
    return {before_mA_};
  }
  std::vector<Finding> findings() const override {
    std::vector<Finding> found = inside_->findings();
    believed_.tell(found);
    return found;
  }
  bool already_quantised() const override { return inside_->already_quantised(); }

 private:
  SafetyTerms terms_;
  std::unique_ptr<Controller> inside_;
  CurrentRange range_;
  double tick_s_;
  BelievedCounts believed_;
  double before_mA_ = 0.0;
};

}  // namespace

Knowledge allowed(const SafetyTerms& terms, Knowledge knowledge) {
  for (double& ratio : knowledge.target) ratio = terms.allowed(ratio);
  return knowledge;
}

std::unique_ptr<Controller> kept_safe(const SafetyTerms& terms, const Knowledge& knowledge,
                                      const MakeController& make) {
  if (!terms.any()) return make(knowledge);
  return std::make_unique<KeptSafe>(terms, knowledge, make(allowed(terms, knowledge)));
}

}  // namespace mckibben::controllers
