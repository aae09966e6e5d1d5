// See the header.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <sim/data/rounded.hpp>
#include <sim/data/scatter.hpp>
#include <sim/data/thresholds.hpp>

namespace mckibben::data {

std::optional<std::string> rounded(const std::vector<double>& commands, const plant::Rig& rig) {
  constexpr const PlausibleThresholds& limits = thresholds.plausible;
  const double step = step_of(commands);
  const double own = (rig.dac.largest_command - rig.dac.lowest_command) / std::exp2(rig.dac.bits);
  if (step < limits.coarser_command * own) return std::nullopt;
  std::set<double> levels;
  std::size_t stays = 0, single = 0;
  for (std::size_t k = 1; k < commands.size(); ++k) {
    levels.insert(std::round(commands[k] / step));
    const double move = std::abs(commands[k] - commands[k - 1]) / step;
    stays += move < 0.5 ? 1 : 0;
    single += move > 0.5 && move < 1.5 ? 1 : 0;
  }
  const auto rows = static_cast<double>(commands.size() - 1), staying = static_cast<double>(stays);
  // A stair stays longer, and an even ramp, which nobody rounded, not at all.
  if (levels.size() < limits.least_levels || staying < limits.least_stays * rows ||
      staying > limits.most_stays * rows ||
      static_cast<double>(single) < limits.single_steps * (rows - staying))
    return std::nullopt;
  return fmt::format(
      "is rounded to {0:.3g} {1}, and the rig's DAC has steps of {2:.2g} {1}: what was sent is not known to "
      "that. Write it down with more digits, or, if the DAC does it, dac: {{bits: {3:.0f}}} in the rig",
      step, name_of(rig.command_unit()), own,
      std::max(4.0, std::round(std::log2((rig.dac.largest_command - rig.dac.lowest_command) / step))));
}

std::optional<std::string> between_states(const std::vector<double>& commands, const plant::Valve& valve) {
  if (!valve.is_on_off() || valve.switching != plant::Switching::edges) return std::nullopt;
  constexpr const PlausibleThresholds& limits = thresholds.plausible;
  std::set<double> values;
  std::size_t rows = 0;
  for (const double command : commands)
    if (const double way = valve.way(command); way > limits.an_end && way < 1.0 - limits.an_end) {
      values.insert(command);
      ++rows;
    }
  if (values.size() <= limits.most_states ||
      static_cast<double>(rows) < limits.between_share * static_cast<double>(commands.size()))
    return std::nullopt;
  return fmt::format(
      "takes many values between {:.4g} and {:.4g} {}, and the rig's valve is open or shut (switching: "
      "edges, if it says none): are they duties? Then write in its valve switching: pwm, with pwm_frequency, "
      "or switching: averaged",
      valve.zero_command, valve.span_command, name_of(valve.command_unit));
}

}  // namespace mckibben::data
