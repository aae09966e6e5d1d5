// The result of a job over several runs, as Python sees it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <sim/python/recordings.hpp>

namespace mckibben::python {

struct Result {
  std::vector<std::shared_ptr<Simulated>> runs;
  std::vector<std::string> warnings, unmet;
  /// As files hold them; made when they are asked for.
  std::function<std::string()> table, document, report;
};

}  // namespace mckibben::python
