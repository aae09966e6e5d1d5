// Words for other units; see the header.
#include <plant/command.hpp>

namespace mckibben::plant {

std::string in_unit(CommandUnit unit, std::string_view of_current) {
  std::string text(of_current);
  if (unit == CommandUnit::mA) return text;
  const auto replace = [&](std::string_view from, std::string_view to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  replace("mA", name_of(unit));
  replace("current", "command");
  replace("Current", "Command");
  return text;
}

}  // namespace mckibben::plant
