// See the header.
#include <algorithm>

#include <sim/run/briefing.hpp>
#include <sim/run/reachable.hpp>
#include <sim/run/rig_model.hpp>
#include <sim/run/simulate.hpp>
#include <sim/run/track.hpp>

namespace mckibben::run {

Briefing briefing_of(const domain::Scenario& scenario) {
  const plant::Rig& rig = scenario.rig;
  const auto ticks = plan_of(scenario, 0.0, 0).ticks;
  Briefing all{scenario.controllers, knowledge_of(rig, controllers::sample(scenario.target, ticks, rig.tick_s,
                                                                           rig.muscle.rest_length_m))};
  if (std::any_of(all.settings.begin(), all.settings.end(),
                  [](auto& each) { return controllers::calibrated(each); }))
    all.knowledge.reach = reachable(scenario.rig);  // only the model-based ones ask for it
  for (auto& settings : all.settings)
    if (auto* terms = controllers::model_terms(settings)) {
      const auto named = scenario.believed.find(controllers::name_of(settings));
      const domain::RigFile& believed = named == scenario.believed.end() ? scenario.rig : named->second;
      terms->model = model_of(believed, believed.integrator, rig.tick_s);
    }
  return all;
}

std::unique_ptr<controllers::Controller> Briefing::make(const controllers::Settings& one,
                                                        double load_kg) const {
  const auto* guest = controllers::guest_terms(one);
  if (guest == nullptr || !guest->tell_load) return controllers::make(one, knowledge);
  controllers::Knowledge told = knowledge;
  told.load_kg = load_kg;
  return controllers::make(one, told);
}

}  // namespace mckibben::run
