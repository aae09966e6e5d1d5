// What Python's objects of inputs hold.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/domain/scenario.hpp>
#include <sim/python/module.hpp>

namespace mckibben::python {

struct Scenario {
  domain::Scenario what;
  std::vector<std::string> warnings;  ///< of its reader
};

/// From a Rig, a name, a path or a dict, whose relative paths start at `folder`.
Rig rig_of(const py::object& from, const std::filesystem::path& folder = ".");

}  // namespace mckibben::python
