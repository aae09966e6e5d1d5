// Rigs as a file says them.
#pragma once

#include <string>

#include <sim/input/rigs.hpp>

namespace mckibben::input {

/// The rig of a file with this text, without its line `schema`. Throws BadInput.
inline Rig rig_of(const std::string& text) {
  const YamlFile file = parse_yaml(Source("rig.yaml", text, ""));
  Rig rig;
  Problems problems;
  read_named(file.source, file.root, rig, problems);
  problems.raise();
  return rig;
}

}  // namespace mckibben::input
