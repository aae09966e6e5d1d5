// Laws of a user's own without a file: what a law needs to be at work in a rig.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <plant/effects/own_laws.hpp>
#include <sim/law/compile.hpp>

namespace mckibben {

struct OwnParameter {
  std::string name;
  law::Dimension dimension;
  double value;
  double typical = value, lowest = 0.0, highest = 1e9;  ///< of a diagnosis
};

/// Units that tests of laws write.
inline std::optional<law::UnitSize> few_units(std::string_view unit) {
  if (unit == "N") return law::UnitSize{law::newton};
  if (unit == "m") return law::UnitSize{law::metre};
  if (unit == "mm/s") return law::UnitSize{law::metre_per_second, 1e-3};
  if (unit == "s") return law::UnitSize{law::second};
  if (unit == "Pa") return law::UnitSize{law::pascal};
  return std::nullopt;
}

/// Throws std::invalid_argument with the first fault.
inline plant::OwnLawOf<double> own_law(
    plant::LawTarget adds, const std::string& law, const std::vector<OwnParameter>& parameters,
    const std::vector<std::pair<std::string, std::string>>& memories = {}) {
  law::Wording wording{adds, law, {}, {}};
  plant::LawText text;
  text.name = "own";
  text.sentence = "of a test";
  text.adds = adds;
  text.law = law;
  plant::OwnLawOf<double> own;
  for (const auto& p : parameters) {
    own.values.at(text.parameters.size()) = p.value;
    wording.parameters.push_back({p.name, p.dimension});
    text.parameters.push_back({p.name, p.dimension.unit(), p.typical, p.lowest, p.highest});
  }
  for (const auto& [name, rate] : memories) wording.memories.push_back({name, rate});
  std::vector<law::Fault> faults;
  auto programs = law::compile(wording, few_units, faults);
  if (!programs) throw std::invalid_argument(faults.front().message);
  text.program = std::move(programs->law);
  text.knows_time = programs->knows_time;
  for (std::size_t i = 0; i < memories.size(); ++i)
    text.memories.push_back({memories[i].first, memories[i].second, programs->memories[i].dimension.unit(),
                             0.1, std::move(programs->memories[i].rate)});
  own.text = std::make_shared<const plant::LawText>(std::move(text));
  return own;
}

/// Twelve equal springs that creep, and one that waits for a time that does not come.
inline plant::OwnLawOf<double> law_of_twelve() {
  const law::Dimension newton_per_metre = law::newton.times(law::metre, -1.0);
  std::string sum = "0 * x * tanh(t / tau)";
  std::vector<std::pair<std::string, std::string>> memories;
  for (int i = 1; i <= 12; ++i) {
    memories.emplace_back("q" + std::to_string(i), "(x - q" + std::to_string(i) + ") / tau");
    sum += " + q" + std::to_string(i) + " - x";
  }
  return own_law(plant::LawTarget::force, "k * (" + sum + ")",
                 {{"k", newton_per_metre, 50.0}, {"tau", law::second, 0.4}}, memories);
}

}  // namespace mckibben
