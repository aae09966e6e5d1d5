// The keys of a law of the user's own, as they stand in its file: those of every law, and of each parameter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <plant/law.hpp>
#include <sim/input/hypothesis_file.hpp>

namespace mckibben::input {

/// A parameter as it stands in the file, in its own unit.
struct WrittenParameter {
  std::string unit = "1";
  double typical = 0.0;
  std::vector<double> range{};
  std::optional<double> value{};

  static constexpr double largest = 1e30;

  static void fields(auto& self, auto& visit) {
    visit.required("unit", self.unit, "what it is measured in, as N.s/m; 1 for a ratio");
    visit.required("typical", self.typical, "1", -largest, largest,
                   "a value that matters, in that unit; a diagnosis begins there");
    visit.required("range", self.range, "1", -largest, largest,
                   "[lowest, highest], in that unit; that of the first parameter holds 0");
    visit(
        "value", self.value, "1", -largest, largest,
        "in a rig: what it is, in that unit; if left out, 0 of the first parameter (the law is absent), else "
        "typical");
  }
};

/// The keys that are the same in every law.
struct WrittenLaw {
  std::string name, sentence;
  plant::LawTarget adds{};
  plant::LawPlace at{};
  std::string law;

  static void fields(auto& self, auto& visit) {
    visit.required("name", self.name, "small letters, digits and _, and no effect of the catalogue");
    visit.required("sentence", self.sentence, "what it is, as a verdict would say it");
    visit.required(
        "adds", self.adds,
        "force on the load, upwards; friction_factor: to the 1 that multiplies the friction level; "
        "outflow of gas from the muscle; command: to the pressure that the valve follows; reading: "
        "to the rise that is read");
    visit("at", self.at, "a force: on the muscle's side, which its cord carries, or at the joint beyond it");
    visit.required("law", self.law, "what is added: an expression (docs/hypotheses.md)");
  }
};

/// Without text, with problems, if something is wrong.
OwnLaw read_law(const Source& source, const Node& map, Problems& problems);

}  // namespace mckibben::input
