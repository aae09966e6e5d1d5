// A simulated run as Python sees it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sim/run/gaps.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::python {

struct Simulated {
  std::shared_ptr<const run::Recording> recording;
  std::vector<plant::Channel> channels;
  std::string name{}, controller{}, failure{};
  double load_kg = 0.0;  ///< 0 where none hangs
  std::shared_ptr<const std::vector<double>>
      target{};  ///< contraction ratio or angle [rad] at each row; none
  std::vector<std::pair<std::string, std::optional<double>>> metrics{};
  std::vector<run::Gap> gaps{};
};

}  // namespace mckibben::python
