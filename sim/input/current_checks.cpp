// Limits and currents of controllers and weighing; see the header.
#include <algorithm>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include <sim/input/current_checks.hpp>
#include <sim/input/quantity.hpp>

namespace mckibben::input {
namespace {

/// A command in words.
class Say {
 public:
  explicit Say(const plant::Rig& rig) : unit_(name_of(rig.command_unit())) {}
  std::string operator()(double command) const { return write_quantity(command, unit_); }

 private:
  std::string_view unit_;
};

class CurrentChecker {
 public:
  CurrentChecker(const Source& source, const Node& node, const plant::Rig& rig, Problems& problems)
      : source_(source), node_(node), range_(working_range(rig)), say_(rig), problems_(problems) {
    top_ = rig.dac.largest_command < rig.valve.span_command ? "the DAC's largest_command"
                                                            : "the valve's span_command";
  }

  /// Two ends, each given or not, of a command that is to move the valve. False if it cannot.
  bool ends(std::string_view low_key, double low_mA, std::string_view high_key, double high_mA) {
    const bool below = high_mA <= range_.lowest_mA, above = low_mA >= range_.highest_mA;
    if (below || above || high_mA <= low_mA) {
      const bool low_is_at_fault = above || node_.find(high_key) == nullptr;
      const std::string_view key = low_is_at_fault ? low_key : high_key;
      problems_.error(source_, place(key),
                      fmt::format("{} = {}: from {} to {} no command moves the rig's valve, "
                                  "which works from {} to {}",
                                  key, say_(low_is_at_fault ? low_mA : high_mA), say_(low_mA), say_(high_mA),
                                  say_(range_.lowest_mA), say_(range_.highest_mA)));
      return false;
    }
    if (low_mA < range_.lowest_mA)
      warn(place(low_key), low_key, low_mA,
           fmt::format("below the valve's zero_command, {}", say_(range_.lowest_mA)));
    not_above(place(high_key), high_key, high_mA);
    return true;
  }

  /// A command that the valve does not answer to, or the DAC does not give. Below zero_command benches rest,
  /// as the thesis's sines do.
  void not_above(Place place, std::string_view key, double mA) {
    if (mA > range_.highest_mA)
      warn(place, key, mA, fmt::format("above {}, {}", top_, say_(range_.highest_mA)));
  }

  void rest(double rest_mA, double low_mA, double high_mA) {
    if (rest_mA < low_mA || rest_mA > high_mA)
      problems_.error(
          source_, place("rest_command"),
          fmt::format("rest_command = {}: must lie between lowest_command and highest_command, {} and {}",
                      say_(rest_mA), say_(low_mA), say_(high_mA)));
  }

 private:
  Place place(std::string_view key) const {
    const Node* given = node_.find(key);
    return given != nullptr ? given->place : node_.place;
  }
  void warn(Place place, std::string_view key, double value_mA, const std::string& how) {
    problems_.warning(
        source_, place,
        fmt::format("{} = {} is {}: from there on the pressure does not change", key, say_(value_mA), how));
  }

  const Source& source_;
  const Node& node_;
  controllers::CurrentRange range_;
  std::string_view top_;
  Say say_;
  Problems& problems_;
};

/// Looks at what a waveform gives; the visitor of its fields.
class GivenCommands {
 public:
  GivenCommands(const Node& node, CurrentChecker& checker) : node_(node), checker_(checker) {}

  template <class T, class Unit>
  void operator()(std::string_view key, const T& value, const Unit& unit, const auto&...) {
    const Node* given = node_.find(key);
    if (given == nullptr) return;
    if constexpr (std::is_same_v<T, std::vector<controllers::CurrentMove>>)
      for (std::size_t i = 0; i < value.size(); ++i) {
        GivenCommands of_move(given->children[i], checker_);
        controllers::CurrentMove::fields(value[i], of_move);
      }
    if constexpr (std::is_convertible_v<T, std::optional<double>> && !std::is_integral_v<T>)
      if (const std::optional<double> mA = value; std::string_view(unit) == "mA")
        checker_.not_above(given->place, key, *mA);
  }
  void required(std::string_view key, const auto&... rest) { (*this)(key, rest...); }

 private:
  const Node& node_;
  CurrentChecker& checker_;
};

}  // namespace

controllers::CurrentRange working_range(const plant::Rig& rig) {
  return controllers::working_range(domain::valve_line(rig.valve), rig.dac.largest_command);
}

void follow_valve(controllers::Settings& settings, const Source& source, const Node& node,
                  const plant::Rig& rig, Problems& problems) {
  controllers::follow(settings, working_range(rig));
  CurrentChecker output(source, node, rig, problems);
  if (const auto* terms = controllers::part_of<controllers::OutputLimits>(settings)) {
    const bool works = output.ends("lowest_command", *terms->lowest_current_mA, "highest_command",
                                   *terms->highest_current_mA);
    if (const auto* one = controllers::part_of<controllers::RestTerms>(settings); one != nullptr && works)
      output.rest(*one->rest_current_mA, *terms->lowest_current_mA, *terms->highest_current_mA);
  }
  std::visit(
      [&]<class One>(const One& one) {
        GivenCommands given(node, output);
        if constexpr (requires { one.at(0.0); }) One::fields(one, given);
        if constexpr (std::is_same_v<One, controllers::RecordedCurrent>)
          if (!one.samples_mA.empty())
            output.not_above(node.find("file")->place, one.column, std::ranges::max(one.samples_mA));
      },
      settings);
  if (const auto* contractions = controllers::weighing_of(settings))
    if (const Node* weighing = node.find("weighing"))
      CurrentChecker(source, *weighing, rig, problems)
          .ends("low", *contractions->low_mA, "high", *contractions->high_mA);
}

void check_dac(const plant::Rig& rig, const Source& source, Place place, Problems& problems) {
  const Say say(rig);
  const plant::Dac& dac = rig.dac;
  if (dac.largest_command <= rig.valve.zero_command)
    problems.error(source, place,
                   fmt::format("dac.largest_command = {}: cannot move the valve, whose zero_command is {}",
                               say(dac.largest_command), say(rig.valve.zero_command)));
  else if (dac.largest_command < rig.valve.span_command)
    problems.warning(source, place,
                     fmt::format("dac.largest_command = {} is below the valve's span_command, {}: the span "
                                 "pressure is never reached",
                                 say(dac.largest_command), say(rig.valve.span_command)));
  if (dac.lowest_command > rig.valve.zero_command)
    problems.warning(source, place,
                     fmt::format("dac.lowest_command = {} is above the valve's zero_command, {}: the zero "
                                 "pressure is never reached",
                                 say(dac.lowest_command), say(rig.valve.zero_command)));
}

}  // namespace mckibben::input
