// The static law, turned round at each tick's target.
#include <algorithm>

#include <controllers/kept_safe.hpp>
#include <controllers/static_inverse.hpp>

namespace mckibben::controllers {
namespace {

class StaticInverse final : public Controller {
 public:
  StaticInverse(double load_N, const ForceModel& model, const Knowledge& knowledge)
      : load_N_(load_N), model_(model), knowledge_(knowledge) {}

  Command rest() override { return {current_mA(0)}; }
  Command step(const Reading& reading) override { return {current_mA(reading.tick)}; }

 private:
  double current_mA(std::int64_t tick) const {
    // At e_max (T 2.10) the braid pulls no more; just short of it the pressure is still finite.
    const double e = std::min(knowledge_.target_at(tick), 0.999 * model_.largest_contraction_ratio());
    return knowledge_.valve.current_mA(load_N_ / model_.force_N(e, 1.0));
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
  return kept_safe(*this, knowledge, [&](const Knowledge& known) {
    return std::make_unique<StaticInverse>(assumed_load_kg * gravity_m_per_s2, model, known);
  });
}

}  // namespace mckibben::controllers
