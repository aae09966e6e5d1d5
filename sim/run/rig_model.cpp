// A ride behind the interface that controllers know.
#include <cmath>
#include <utility>

#include <plant/instruments.hpp>
#include <plant/joint_stiffness.hpp>
#include <sim/engine/failure.hpp>
#include <sim/ride/ride.hpp>
#include <sim/run/rig_model.hpp>

namespace mckibben::run {
namespace {

class RiddenModel final : public controllers::RigModel {
 public:
  RiddenModel(const plant::Rig& rig, ride::Ride ride, const controllers::Command& rest, double tick_s)
      : rest_length_m_(rig.muscle.rest_length_m), dac_(rig.dac), tick_s_(tick_s), ride_(std::move(ride)) {
    const controllers::Command given{given_mA(rest.current_mA), given_mA(rest.opposite_mA)};
    ride_.start(drive_of(given), 0.0);
    for (auto ticks = std::lround(rig.settling_time_s / tick_s); ticks > 0; --ticks) step(given, 1);
  }

  std::unique_ptr<RigModel> copy() const override {
    return std::unique_ptr<RigModel>(new RiddenModel(*this, ride_));
  }
  double given_mA(double wanted_mA) const override { return plant::dac_output_mA(dac_, wanted_mA); }
  void step(const controllers::Command& command, int ticks) override {
    try {
      ride_.step(drive_of(command), static_cast<double>(tick_ += ticks) * tick_s_);
    } catch (const engine::NumericalFailure& failure) {
      throw controllers::ModelFailure(failure.what());
    }
  }
  double contraction_ratio() const override {
    return ride_.plant().shown_ratio(ride_.flow().state.joint.contraction_ratio);
  }
  double shown_ratio() const override { return ride_.reading().wheel_m / rest_length_m_; }
  double stiffness_N_m_per_rad() const override {
    const engine::Flow& now = ride_.flow();
    return plant::joint_stiffness_N_m_per_rad(ride_.plant(), now.state, now.memory, ride_.held());
  }

  void keep() override {
    ride_.save(kept_);
    kept_tick_ = tick_;
  }
  void go_back() override {
    ride_.restore(kept_);
    tick_ = kept_tick_;
  }

 private:
  RiddenModel(const RiddenModel& other, const ride::Ride& ride)
      : rest_length_m_(other.rest_length_m_),
        dac_(other.dac_),
        tick_s_(other.tick_s_),
        tick_(other.tick_),
        ride_(ride) {}

  static ride::Drive drive_of(const controllers::Command& command) {
    ride::Drive drive;
    drive.current_mA = command.current_mA;
    drive.opposite.current_mA = command.opposite_mA;
    return drive;
  }

  double rest_length_m_;
  plant::Dac dac_;
  double tick_s_;
  long tick_ = 0, kept_tick_ = 0;
  ride::Ride ride_;
  ride::Ride::Saved kept_;
};

}  // namespace

controllers::ModelMaker model_of(const plant::Rig& rig, double tick_s, double hand_m) {
  return [=](double load_kg, const controllers::Command& rest) -> std::unique_ptr<controllers::RigModel> {
    ride::Loaded loaded{rig, load_kg};
    if (plant::Pair* pair = loaded.rig.pair()) *pair = plant::with_load_in_hand(*pair, load_kg, hand_m);
    return std::make_unique<RiddenModel>(rig, ride::Ride(loaded, rig.integrator), rest, tick_s);
  };
}

}  // namespace mckibben::run
