// From a law as it is written to the program that the plant evaluates (plant/law.hpp): names are looked up,
// units are checked, constants are calculated once, limits are kept.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plant/law.hpp>
#include <sim/law/dimension.hpp>
#include <sim/law/expression.hpp>

namespace mckibben::law {

/// What a unit is, or nothing if it is none.
using Units = std::function<std::optional<UnitSize>(std::string_view unit)>;

/// A law in words: expressions that may use the inputs, and each other's parameters and memories.
struct Wording {
  struct Parameter {
    std::string name;
    Dimension dimension{};
  };
  struct Memory {
    std::string name, rate;  ///< the rate: an expression
  };
  plant::LawTarget adds{};
  std::string law;
  std::vector<Parameter> parameters{};
  std::vector<Memory> memories{};
};

/// What is wrong, and in which of the expressions: the law, or else the rate of a memory.
struct Fault : Problem {
  std::optional<std::size_t> memory{};
};

struct Programs {
  plant::LawProgram law;
  struct Memory {
    plant::LawProgram rate;
    Dimension dimension{};
  };
  std::vector<Memory> memories;
  bool knows_time = false;
};

/// Nothing, with faults, if something is wrong.
std::optional<Programs> compile(const Wording& wording, const Units& units, std::vector<Fault>& faults);

/// All that a law may name, to suggest what was meant.
std::vector<std::string> known_names(const Wording& wording);

/// What a target measures.
Dimension dimension_of(plant::LawTarget target);

}  // namespace mckibben::law
