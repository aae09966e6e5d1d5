// See the header.
#include <algorithm>

#include <sim/run/briefing.hpp>
#include <sim/run/reachable.hpp>
#include <sim/run/rig_model.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

double dead_time_s(const plant::Rig& rig) {
  const plant::Pair* pair = rig.pair();
  return std::max(rig.effects.command_delay_s(), pair ? pair->opposite.effects.command_delay_s() : 0.0);
}

}  // namespace

Briefing briefing_of(const domain::Scenario& scenario) {
  Briefing all{scenario.controllers, wanted_of(scenario), {}};
  for (const Wanted& wanted : all.targets) all.knowledge.push_back(knowledge_of(scenario, wanted));
  if (std::any_of(all.settings.begin(), all.settings.end(),
                  [](auto& each) { return controllers::part_of<controllers::CalibrationTerms>(each); }))
    all.knowledge.front().reach = reachable(scenario.rig);  // only the model-based ones ask for it
  for (auto& settings : all.settings)
    if (auto* terms = controllers::part_of<controllers::PlansWithModel>(settings)) {
      const auto named = scenario.believed.find(controllers::name_of(settings));
      const plant::Rig& believed = named == scenario.believed.end() ? scenario.rig : named->second;
      terms->model = model_of(believed, scenario.rig.tick_s, scenario.hand_m);
      if (!terms->look_ahead_s) terms->look_ahead_s = controllers::usual_look_ahead_s + dead_time_s(believed);
    }
  return all;
}

std::unique_ptr<controllers::Controller> Briefing::make(const controllers::Settings& one, std::size_t target,
                                                        double load_kg) const {
  const auto* guest = controllers::part_of<controllers::GuestTerms>(one);
  if (guest == nullptr || !guest->tell_load) return controllers::make(one, knowledge[target]);
  controllers::Knowledge told = knowledge[target];
  told.load_kg = load_kg;
  return controllers::make(one, told);
}

}  // namespace mckibben::run
