// What holds for every controller of the table.
#include <controllers/settings.hpp>

namespace mckibben::controllers {

std::unique_ptr<Controller> make(const Settings& settings, const Knowledge& knowledge) {
  return std::visit([&](const auto& one) { return one.make(knowledge); }, settings);
}

const std::string& name_of(const Settings& settings) {
  return std::visit([](const auto& one) -> const std::string& { return one.name; }, settings);
}

}  // namespace mckibben::controllers
