// A ride behind the interface that controllers know.
#include <cmath>
#include <utility>

#include <plant/instruments.hpp>
#include <sim/engine/failure.hpp>
#include <sim/ride/ride.hpp>
#include <sim/run/rig_model.hpp>

namespace mckibben::run {
namespace {

class RiddenModel final : public controllers::RigModel {
 public:
  RiddenModel(const plant::Rig& rig, double load_kg, double rest_mA, const solver::Settings& engine,
              double tick_s)
      : rest_length_m_(rig.muscle.rest_length_m),
        dac_(rig.dac),
        tick_s_(tick_s),
        ride_(ride::Hanging{rig, load_kg}, engine) {
    ride::Drive drive;
    drive.current_mA = given_mA(rest_mA);
    ride_.start(drive, 0.0);
    for (auto ticks = std::lround(rig.settling_time_s / tick_s); ticks > 0; --ticks) step(drive.current_mA);
  }

  std::unique_ptr<RigModel> copy() const override {
    return std::unique_ptr<RigModel>(new RiddenModel(*this, ride_));
  }
  double given_mA(double wanted_mA) const override { return plant::dac_output_mA(dac_, wanted_mA); }
  void step(double current_mA) override {
    ride::Drive drive;
    drive.current_mA = current_mA;
    try {
      ride_.step(drive, static_cast<double>(++tick_) * tick_s_);
    } catch (const engine::NumericalFailure& failure) {
      throw controllers::ModelFailure(failure.what());
    }
  }
  double contraction_ratio() const override { return ride_.flow().state.joint.contraction_ratio; }
  double shown_ratio() const override { return ride_.reading().wheel_m / rest_length_m_; }

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

  double rest_length_m_;
  plant::Dac dac_;
  double tick_s_;
  long tick_ = 0, kept_tick_ = 0;
  ride::Ride ride_;
  ride::Ride::Saved kept_;
};

}  // namespace

controllers::ModelMaker model_of(const plant::Rig& rig, const solver::Settings& engine, double tick_s) {
  return [=](double load_kg, double rest_mA) -> std::unique_ptr<controllers::RigModel> {
    return std::make_unique<RiddenModel>(rig, load_kg, rest_mA, engine, tick_s);
  };
}

}  // namespace mckibben::run
