// The little that all controllers share.
#include <algorithm>
#include <cstddef>

#include <controllers/controller.hpp>

namespace mckibben::controllers {

Controller::~Controller() = default;

double Knowledge::target_at(std::int64_t tick) const {
  if (target.empty()) return 0.0;
  const auto last = static_cast<std::int64_t>(target.size()) - 1;
  return target[static_cast<std::size_t>(std::clamp<std::int64_t>(tick, 0, last))];
}

}  // namespace mckibben::controllers
