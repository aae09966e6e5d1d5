// What is called a current, in runs and plots; see the header.
#include <utility>
#include <vector>

#include <sim/report/own_commands.hpp>

namespace mckibben::report {
namespace {

constexpr const char* called = "current";  // the key of the quantity, and of its plot

void convert(std::vector<Quantity>& quantities, const plant::Valve& valve) {
  for (Quantity& quantity : quantities)
    if (quantity.key == called)
      quantity.at = [valve, current_mA = std::move(quantity.at)](std::size_t k) {
        return valve.command_for(current_mA(k));
      };
}

}  // namespace

bool shows_own_commands(const Contents& contents) {
  return contents.rig.valve.has_own_command() && !std::holds_alternative<plant::Pair>(contents.mechanics);
}

Contents with_own_commands(Contents contents) {
  if (!shows_own_commands(contents)) return contents;
  const plant::Valve& valve = contents.rig.valve;
  for (Group& group : contents.groups) {
    convert(group.given, valve);
    for (Run& run : group.runs) convert(run.quantities, valve);
  }
  for (Plot& plot : contents.plots) {
    if (plot.id != called) continue;
    plot.title = "Command";
    plot.unit = plant::name_of(valve.zero_command.unit);
    for (Line& line : plot.lines) line.label = "command";
  }
  return contents;
}

}  // namespace mckibben::report
