// Lines, and where the marks go; see the header.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <sim/report/rig_parts.hpp>

namespace mckibben::report {
namespace {

/// Effects, then the first keys of a rig file.
constexpr auto sits_at = [] {
  using enum Part;
  return std::to_array<std::pair<std::string_view, Part>>({{"viscous_damping", muscle},
                                                           {"guide_friction", guide},
                                                           {"speed_dependent_friction", threads},
                                                           {"bladder_elasticity", muscle},
                                                           {"bladder_creep", muscle},
                                                           {"bladder_hysteresis", muscle},
                                                           {"isometric_hysteresis", muscle},
                                                           {"end_cap_correction", muscle},
                                                           {"pressure_threshold", muscle},
                                                           {"muscle_leak", muscle},
                                                           {"polytropic_gas", muscle},
                                                           {"gas_temperature", muscle},
                                                           {"valve_lag", valve},
                                                           {"valve_dead_band", valve},
                                                           {"valve_hysteresis", valve},
                                                           {"supply_droop", supply},
                                                           {"exhaust_restriction", valve},
                                                           {"command_delay", command},
                                                           {"friction_warm_up", threads},
                                                           {"encoder_backlash", encoder},
                                                           {"encoder_scale", encoder},
                                                           {"reading_delay", encoder},
                                                           {"gauge_error", gauge},
                                                           {"residual_law", muscle},
                                                           {"muscle", muscle},
                                                           {"friction", threads},
                                                           {"valve", valve},
                                                           {"hose", hose},
                                                           {"joint", guide},
                                                           {"gas", muscle}});
}();

std::pair<double, double> place_of(Part part) {
  using enum Part;
  switch (part) {
    case supply:
      return {13, 118};
    case command:
      return {46, 143};
    case valve:
      return {46, 118};
    case hose:
      return {46, 82};
    case muscle:
      return {64, 38};
    case threads:
      return {102, 38};
    case guide:
      return {174, 97};
    case encoder:
      return {156, 56};
    case gauge:
      return {96, 82};
  }
  return {};
}

constexpr std::string_view rig_lines =
    "<path class='frame' d='M6 16V60M8 32h8v12H8zM128 32h8v12h-8z'/>\n"
    "<path class='frame' d='M16 34C22 22 30 20 42 20H102C114 20 122 22 128 34V42C122 54 114 56 102 "
    "56H42C30 56 22 54 16 42z'/>\n"
    "<path class='axis' fill='none' d='M36 20L52 56M56 20L72 56M76 20L92 56M96 20L112 56M52 20L36 56M72 "
    "20L56 56M92 20L76 56M112 20L96 56'/>\n"
    "<path class='frame' d='M136 38H156A18 18 0 0 1 174 56V84M158 84h32v26h-32z'/>\n"
    "<circle class='frame' cx='156' cy='56' r='18'/>\n"
    "<path class='frame' d='M46 106V56M28 106h36v24H28zM2 118H26M21 113L27 118L21 123M46 150V132M41 137L46 "
    "131L51 137'/>\n";

}  // namespace

std::optional<Part> part_of(std::string_view name) {
  constexpr std::string_view of_effects = "effects.";
  if (const auto at = name.find(of_effects); at != name.npos) name.remove_prefix(at + of_effects.size());
  name = name.substr(0, name.find('.'));
  const auto* place = std::ranges::find(sits_at, name, &std::pair<std::string_view, Part>::first);
  return place == sits_at.end() ? std::nullopt : std::optional(place->second);
}

std::string rig_drawing(const std::vector<Part>& marks, bool with_gauge) {
  std::string svg(rig_lines);
  if (with_gauge) svg += "<path class='frame' d='M96 56V72m-10 10a10 10 0 1 0 20 0a10 10 0 1 0 -20 0'/>\n";
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const auto before = std::count(marks.begin(), marks.begin() + static_cast<std::ptrdiff_t>(i), marks[i]);
    const auto [x, y] = place_of(marks[i]);
    svg += fmt::format(
        "<circle class='mark c0' cx='{0:g}' cy='{1:g}' r='10'/><text class='on-mark' x='{0:g}' y='{2:g}' "
        "text-anchor='middle'>{3}</text>\n",
        x + 20.0 * static_cast<double>(before), y, y + 4.5, i + 1);
  }
  return svg;
}

}  // namespace mckibben::report
