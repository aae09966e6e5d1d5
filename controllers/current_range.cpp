// The valve's ends and the DAC's; see the header.
#include <algorithm>

#include <controllers/current_range.hpp>

namespace mckibben::controllers {

CurrentRange working_range(const ValveLine& valve, double largest_mA) {
  return {valve.zero_current_mA, std::min(valve.span_current_mA, largest_mA), valve.closed_current_mA};
}

CurrentRange working_range(const Knowledge& knowledge) {
  return working_range(knowledge.valve, knowledge.largest_current_mA);
}

}  // namespace mckibben::controllers
