// See the header.
#include <algorithm>
#include <type_traits>
#include <utility>

#include <plant/instruments.hpp>
#include <sim/run/two_currents.hpp>

namespace mckibben::run {
namespace {

class TwoPlayed final : public controllers::Controller {
 public:
  TwoPlayed(domain::CampaignWaveform current_1, domain::CampaignWaveform current_2, const plant::Rig& rig)
      : current_1_(std::move(current_1)),
        current_2_(std::move(current_2)),
        dac_(rig.dac),
        tick_s_(rig.tick_s) {}

  controllers::Command rest() override { return at(0); }
  controllers::Command step(const controllers::Reading& reading) override {
    return at(static_cast<std::size_t>(std::max<std::int64_t>(reading.tick, 0)));
  }
  bool already_quantised() const override { return true; }

 private:
  controllers::Command at(std::size_t tick) const {
    return {given_mA(current_1_, tick), given_mA(current_2_, tick)};
  }
  double given_mA(const domain::CampaignWaveform& waveform, std::size_t tick) const {
    return std::visit(
        [&](const auto& one) {
          if constexpr (std::is_same_v<std::remove_cvref_t<decltype(one)>, controllers::RecordedCurrent>)
            return one.samples_mA[std::min(tick, one.samples_mA.size() - 1)];
          else
            return plant::dac_output_mA(dac_, one.at(static_cast<double>(tick) * tick_s_));
        },
        waveform);
  }

  domain::CampaignWaveform current_1_, current_2_;
  plant::Dac dac_;
  double tick_s_;
};

}  // namespace

std::unique_ptr<controllers::Controller> play(const domain::CampaignWaveform& current_1,
                                              const domain::CampaignWaveform& current_2,
                                              const plant::Rig& rig) {
  return std::make_unique<TwoPlayed>(current_1, current_2, rig);
}

}  // namespace mckibben::run
