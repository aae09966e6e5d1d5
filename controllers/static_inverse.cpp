// The static law, turned round at each tick's target.
#include <algorithm>
#include <cmath>

#include <controllers/static_inverse.hpp>

namespace mckibben::controllers {
namespace {

constexpr double gravity_m_per_s2 = 9.80665;

class StaticInverse final : public Controller {
 public:
  StaticInverse(double load_N, const ForceModel& model, const Knowledge& knowledge)
      : load_N_(load_N), model_(model), knowledge_(knowledge) {}

  Command rest() override { return {current_mA(0)}; }
  Command step(const Reading& reading) override { return {current_mA(reading.tick)}; }

 private:
  double pressure_Pa(double wanted) const {
    const double a = 3.0 / std::pow(std::tan(model_.braid_angle_rad), 2);
    const double b = 1.0 / std::pow(std::sin(model_.braid_angle_rad), 2);
    const double k = model_.end_correction;
    // At e_max (T 2.10) the braid pulls no more; just short of it the pressure is still finite.
    const double e = std::min(wanted, 0.999 * (1.0 - std::sqrt(b / a)) / k);
    const double area_m2 = std::numbers::pi * model_.rest_radius_m * model_.rest_radius_m;
    return load_N_ / (area_m2 * (a * std::pow(1.0 - k * e, 2) - b));
  }

  double current_mA(std::int64_t tick) const {
    const ValveLine& line = knowledge_.valve;
    const double share = (pressure_Pa(knowledge_.target_at(tick)) - line.zero_pressure_Pa) /
                         (line.span_pressure_Pa - line.zero_pressure_Pa);
    return std::lerp(line.zero_current_mA, line.span_current_mA, std::clamp(share, 0.0, 1.0));
  }

  double load_N_;
  ForceModel model_;
  Knowledge knowledge_;
};

}  // namespace

std::unique_ptr<Controller> StaticInverseSettings::make(const Knowledge& knowledge) const {
  ForceModel model = knowledge.model;
  model.rest_radius_m = rest_radius_m.value_or(model.rest_radius_m);
  model.braid_angle_rad = braid_angle_rad.value_or(model.braid_angle_rad);
  model.end_correction = end_correction.value_or(model.end_correction);
  return std::make_unique<StaticInverse>(assumed_load_kg * gravity_m_per_s2, model, knowledge);
}

}  // namespace mckibben::controllers
