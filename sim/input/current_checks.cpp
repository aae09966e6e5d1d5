// Limits and currents of controllers and weighing; see the header.
#include <string_view>

#include <fmt/format.h>

#include <sim/input/current_checks.hpp>
#include <sim/input/quantity.hpp>

namespace mckibben::input {
namespace {

std::string mA(double value_mA) {
  return write_quantity(value_mA, "mA");
}

class CurrentChecker {
 public:
  CurrentChecker(const Source& source, const Node& node, const plant::Rig& rig, Problems& problems)
      : source_(source), node_(node), range_(working_range(rig)), problems_(problems) {
    top_ = rig.dac.largest_current_mA < rig.valve.span_current_mA ? "the DAC's largest_current"
                                                                  : "the valve's span_current";
  }

  /// Two ends, each given or not, of a current that is to move the valve. False if it cannot.
  bool ends(std::string_view low_key, double low_mA, std::string_view high_key, double high_mA) {
    const bool below = high_mA <= range_.lowest_mA, above = low_mA >= range_.highest_mA;
    if (below || above || high_mA <= low_mA) {
      const bool low_is_at_fault = above || node_.find(high_key) == nullptr;
      const std::string_view key = low_is_at_fault ? low_key : high_key;
      problems_.error(source_, place(key),
                      fmt::format("{} = {}: from {} to {} no current moves the rig's valve, "
                                  "which works from {} to {}",
                                  key, mA(low_is_at_fault ? low_mA : high_mA), mA(low_mA), mA(high_mA),
                                  mA(range_.lowest_mA), mA(range_.highest_mA)));
      return false;
    }
    if (low_mA < range_.lowest_mA)
      warn(low_key, low_mA, fmt::format("below the valve's zero_current, {}", mA(range_.lowest_mA)));
    if (high_mA > range_.highest_mA)
      warn(high_key, high_mA, fmt::format("above {}, {}", top_, mA(range_.highest_mA)));
    return true;
  }

  void rest(double rest_mA, double low_mA, double high_mA) {
    if (rest_mA < low_mA || rest_mA > high_mA)
      problems_.error(
          source_, place("rest_current"),
          fmt::format("rest_current = {}: must lie between lowest_current and highest_current, {} and {}",
                      mA(rest_mA), mA(low_mA), mA(high_mA)));
  }

 private:
  Place place(std::string_view key) const {
    const Node* given = node_.find(key);
    return given != nullptr ? given->place : node_.place;
  }
  void warn(std::string_view key, double value_mA, const std::string& how) {
    problems_.warning(
        source_, place(key),
        fmt::format("{} = {} is {}: from there on the pressure does not change", key, mA(value_mA), how));
  }

  const Source& source_;
  const Node& node_;
  controllers::CurrentRange range_;
  std::string_view top_;
  Problems& problems_;
};

}  // namespace

controllers::CurrentRange working_range(const plant::Rig& rig) {
  return controllers::working_range({rig.valve.zero_current_mA, rig.valve.span_current_mA,
                                     rig.valve.zero_pressure_Pa, rig.valve.span_pressure_Pa},
                                    rig.dac.largest_current_mA);
}

void follow_valve(controllers::Settings& settings, const Source& source, const Node& node,
                  const plant::Rig& rig, Problems& problems) {
  controllers::follow(settings, working_range(rig));
  if (const auto* terms = controllers::part_of<controllers::OutputLimits>(settings)) {
    CurrentChecker output(source, node, rig, problems);
    const bool works = output.ends("lowest_current", *terms->lowest_current_mA, "highest_current",
                                   *terms->highest_current_mA);
    if (const auto* one = std::get_if<controllers::PidSettings>(&settings); one != nullptr && works)
      output.rest(*one->rest_current_mA, *terms->lowest_current_mA, *terms->highest_current_mA);
  }
  if (const auto* contractions = controllers::weighing_of(settings))
    if (const Node* weighing = node.find("weighing"))
      CurrentChecker(source, *weighing, rig, problems)
          .ends("low", *contractions->low_mA, "high", *contractions->high_mA);
}

void check_dac(const plant::Rig& rig, const Source& source, Place place, Problems& problems) {
  const double largest_mA = rig.dac.largest_current_mA;
  if (largest_mA <= rig.valve.zero_current_mA)
    problems.error(source, place,
                   fmt::format("dac.largest_current = {}: cannot move the valve, whose zero_current is {}",
                               mA(largest_mA), mA(rig.valve.zero_current_mA)));
  else if (largest_mA < rig.valve.span_current_mA)
    problems.warning(source, place,
                     fmt::format("dac.largest_current = {} is below the valve's span_current, {}: the span "
                                 "pressure is never reached",
                                 mA(largest_mA), mA(rig.valve.span_current_mA)));
}

}  // namespace mckibben::input
