// See the header.
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include <sim/diagnose/visited.hpp>

namespace mckibben::diagnose {

namespace {

/// Values that were seen.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void see(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// What the runs of a pair were driven with, and where that took them.
std::string visited_by_pair(const domain::Dataset& data, const Runs& runs) {
  Range current_mA, pressure_bar, angle_deg;
  for (const std::size_t run : runs) {
    for (const std::size_t muscle : {1U, 2U}) {
      const domain::Measurement& measured = *data.runs[run].measured;
      for (const double value : measured.given("command", muscle)) current_mA.see(value);
      for (const double value : measured.given("muscle_pressure", muscle))
        pressure_bar.see(value / plant::Pa_per_bar);
    }
    for (const double value : data.runs[run].values("angle")) angle_deg.see(value / plant::degree_rad);
  }
  const bool given = data.pressure_is_given();
  const Range& driven = given ? pressure_bar : current_mA;
  return fmt::format("{} of {:.3g} to {:.3g} {} and joint angles of {:.3g} to {:.3g} deg, as in these runs",
                     given ? "pressures" : plant::command_key(data.rig) + "s", driven.low, driven.high,
                     given ? "bar" : name_of(data.rig.command_unit()), angle_deg.low, angle_deg.high);
}

}  // namespace

std::string visited(const domain::Dataset& data, const Runs& runs) {
  if (data.rig.pair() != nullptr) return visited_by_pair(data, runs);
  Range current_mA, load_kg, ratio, pressure_bar, angle_deg;
  for (const std::size_t run : runs) {
    for (const double value : data.runs[run].current_mA) current_mA.see(value);
    const domain::Run& measured = data.runs[run];
    for (const double value : measured.length_is_given() ? measured.measured->given("contraction")
                                                         : measured.values("contraction"))
      ratio.see(value);
    for (const double value : measured.values("angle")) angle_deg.see(value / plant::degree_rad);
    if (data.pressure_is_given())
      for (const double value : measured.measured->given("muscle_pressure"))
        pressure_bar.see(value / plant::Pa_per_bar);
    load_kg.see(measured.load_kg);
  }
  const std::string driven =
      data.pressure_is_given()
          ? fmt::format("pressures of {:.3g} to {:.3g} bar", pressure_bar.low, pressure_bar.high)
          : in_unit(data.rig.command_unit(),
                    fmt::format("currents of {:.3g} to {:.3g} mA", current_mA.low, current_mA.high));
  if (data.force_is_judged())
    return fmt::format("{} and contraction ratios of {:.3f} to {:.3f}, as in these runs", driven, ratio.low,
                       ratio.high);
  if (data.rig.lever() != nullptr)
    return fmt::format(
        "{}, loads of {:.4g} to {:.4g} kg and joint angles of {:.3g} to {:.3g} deg, as in these runs", driven,
        load_kg.low, load_kg.high, angle_deg.low, angle_deg.high);
  if (data.pressure_is_given())
    return fmt::format(
        "loads of {:.4g} to {:.4g} kg and contraction ratios of {:.3f} to {:.3f}, as in these runs",
        load_kg.low, load_kg.high, ratio.low, ratio.high);
  return fmt::format(
      "{}, loads of {:.4g} to {:.4g} kg and contraction ratios of {:.3f} to {:.3f}, as in these runs", driven,
      load_kg.low, load_kg.high, ratio.low, ratio.high);
}

}  // namespace mckibben::diagnose
