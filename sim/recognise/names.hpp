// Loads as people write them: into the names of files and folders, or above the headings.
#pragma once

#include <optional>
#include <string>

#include <sim/recognise/unknown_table.hpp>

namespace mckibben::recognise {

struct LoadGuess {
  std::string quantity;  ///< "5 kg"
  std::string reason;
};

/// None if nothing tells the load of this run.
std::optional<LoadGuess> load_of(const UnknownTable& table);

/// "5 kg" in "load_5kg_run2", "5,5 kg" in "m5,5kg", with a decimal p as well: "5p5kg".
std::optional<std::string> load_in(const std::string& text);

}  // namespace mckibben::recognise
