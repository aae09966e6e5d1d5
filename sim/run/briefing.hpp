// What controllers of a scenario are told before they drive anything, simulated or not.
#pragma once

#include <memory>
#include <vector>

#include <controllers/settings.hpp>
#include <sim/domain/scenario.hpp>
#include <sim/run/track.hpp>

namespace mckibben::run {

struct Briefing {
  std::vector<controllers::Settings> settings;  ///< with the models that they plan with
  std::vector<Wanted> targets;
  std::vector<controllers::Knowledge> knowledge;  ///< of each target

  /// One of them at its beginning; it is told the load only if it asks for it. Throws std::invalid_argument
  /// where gains are missing.
  std::unique_ptr<controllers::Controller> make(const controllers::Settings& one, std::size_t target,
                                                double load_kg) const;
};

Briefing briefing_of(const domain::Scenario& scenario);

}  // namespace mckibben::run
