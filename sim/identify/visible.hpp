// What of the catalogue the data would show.
#pragma once

#include <string>
#include <vector>

#include <sim/identify/model.hpp>

namespace mckibben::identify {

struct Visible {
  std::vector<std::string> hidden{};  ///< effects that these data would not show at their usual size
  std::size_t all = 0;
};

/// Beside a model that has no effect, after its evidence: straight lines, parameters give way.
Visible visible(const Model& model);

}  // namespace mckibben::identify
