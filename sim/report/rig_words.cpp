// One line for each part.
#include <algorithm>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/html.hpp>
#include <sim/report/length.hpp>

namespace mckibben::report {
namespace {

using output::readable;

std::string mm(double length_m) {
  return fmt::format("{:.4g} mm", 1e3 * length_m);
}

std::string muscle(const plant::Muscle& muscle) {
  return (muscle.count == 1 ? "" : fmt::format("{} side by side, each ", muscle.count)) +
         fmt::format("{} long, {} in radius and braided at {:.3g} deg, at rest", mm(muscle.rest_length_m),
                     mm(muscle.rest_radius_m), muscle.braid_angle_rad / plant::degree_rad);
}

std::string spring(const plant::Joint& joint) {
  std::string says;
  if (joint.moving_mass_kg > 0.0) says += "; " + readable(joint.moving_mass_kg, "kg") + " move with the cord";
  if (joint.has_spring())
    says += fmt::format("; a return spring of {} and, at rest, {}{}", readable(joint.spring_N_per_m, "N/m"),
                        readable(joint.spring_preload_N, "N"),
                        joint.spring_ways == plant::SpringWays::one ? ", which only pulls" : "");
  return says;
}

std::string valve(const plant::Valve& valve) {
  if (valve.seals()) return fmt::format("none: sealed, filled to {}", readable(valve.fill_pressure_Pa, "Pa"));
  std::string says =
      fmt::format("{:g} to {:g} {} for {} to {}; supply {}", valve.zero_command, valve.span_command,
                  name_of(valve.command_unit), readable(valve.zero_pressure_Pa, "Pa"),
                  readable(valve.span_pressure_Pa, "Pa"), readable(valve.supply_pressure_Pa, "Pa"));
  if (valve.is_on_off())
    says = fmt::format("open or shut ({}), by {:g} to {:g} {}; supply {}", name_of(valve.ports),
                       valve.zero_command, valve.span_command, name_of(valve.command_unit),
                       readable(valve.supply_pressure_Pa, "Pa"));
  if (valve.swings())
    says += fmt::format("; a regulator of {} and damping {:.3g}", readable(valve.natural_frequency_Hz, "Hz"),
                        valve.damping);
  else if (valve.is_regulator())
    says += fmt::format("; a regulator with a lag of {}", readable(valve.time_constant_s, "s"));
  return says;
}

std::string effects(const plant::Effects& effects) {
  std::vector<std::string> names;
  const auto note = [&](const auto& effect) {
    if (!effect.absent()) names.emplace_back(effect.name);
  };
  std::apply([&](const auto&... effect) { (note(effect), ...); }, effects.all);
  return names.empty() ? "none: nominal laws only" : output::listed(names);
}

std::string link(const plant::Pair& pair) {
  return fmt::format(
      "{} whose centre of mass is {} from the axis; inertia {}; the muscles are mounted at {:.3g} and "
      "{:.3g} of contraction",
      readable(pair.mass_kg, "kg"), mm(pair.length_m), readable(pair.inertia_kg_m2, "kg.m2"),
      pair.contraction_ratio, pair.opposite_contraction_ratio);
}

std::string lever(const plant::Lever& lever) {
  const std::string pulled =
      lever.by_points()
          ? fmt::format("the cord pulls {} from the pivot, the muscle is fixed {} from it, {:.3g} deg apart",
                        mm(lever.attached_m), mm(lever.base_m), lever.opening_rad / plant::degree_rad)
          : fmt::format("the cord's arm is {}", mm(lever.arms.front().arm_m)) +
                (lever.arms.size() > 1 ? " to " + mm(lever.arms.back().arm_m) : "");
  std::string says =
      fmt::format("{}; {} whose centre of mass is {} from the pivot; inertia {}; the load at {}", pulled,
                  readable(lever.mass_kg, "kg"), mm(lever.centre_m), readable(lever.inertia_kg_m2, "kg.m2"),
                  mm(lever.load_at_m));
  if (lever.spring_N_m_per_rad > 0.0 || lever.spring_preload_N_m != 0.0)
    says += "; a spring of " + readable(lever.spring_N_m_per_rad, "N.m/rad");
  if (lever.plane == plant::Plane::horizontal) says += "; turns horizontally";
  return says;
}

std::string encoder(const plant::Rig& rig) {
  const double height_m = plant::count_height_m(rig);
  const std::string step = rig.has_angle()
                               ? readable(height_m / rig.joint.wheel_radius_m, "rad") + " of angle"
                               : readable(height_m, "m") + " of height";
  const plant::Sensor& position = rig.sensors.position();
  if (!position.counts_pulses()) return "in steps of " + step;
  return fmt::format(
      "on the {}{}: a count is {}", rig.lever() != nullptr ? "joint" : "wheel",
      position.wheel_ratio == 1.0 ? "" : fmt::format(", geared {:g} to 1", position.wheel_ratio), step);
}

std::string in_words(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

/// What a sensor reads that is not the position.
std::string sensor(const plant::Sensor& sensor) {
  std::string says = sensor.signal == plant::Sensed::muscle_pressure
                         ? "on the muscle"
                         : "reads " + in_words(name_of(sensor.signal));
  if (sensor.resolution > 0.0)
    says += ", in steps of " + readable(sensor.resolution, std::string(sensor.sheet().unit));
  return says;
}

}  // namespace

std::string rig_html(const Contents& contents) {
  const plant::Rig& rig = contents.rig;
  const plant::Pair* pair = rig.pair();
  std::string html = "<dl class='small'>";
  const auto part = [&](const char* name, const std::string& says) {
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, output::escaped(says));
  };
  part(pair != nullptr ? "muscle 1" : "muscle", muscle(rig.muscle));
  if (pair != nullptr) part("muscle 2", muscle(pair->opposite.muscle));
  if (pair != nullptr) part("link", link(*pair));
  if (rig.lever() != nullptr)
    part("lever", lever(*rig.lever()));
  else
    part("wheel", mm(rig.joint.wheel_radius_m) + " in radius" +
                      (rig.joint.load_offset_kg == 0.0 ? ""
                                                       : "; " + readable(rig.joint.load_offset_kg, "kg") +
                                                             " hang on it in addition to the load") +
                      spring(rig.joint));
  html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", in_words(name_of(rig.sensors.position().kind)),
                      text_html(encoder(rig), rig));
  part("valve", valve(rig.valve));
  part("hose", "sonic conductance " + readable(rig.hose.conductance_m3_per_s_Pa, "m3/(s.Pa)"));
  const plant::Sensor* gauge = rig.sensors.of(plant::Sensed::muscle_pressure);
  part("gauge", contents.gauge ? sensor(gauge != nullptr ? *gauge : plant::gauge()) : "none");
  for (const plant::Sensor& other : rig.sensors)
    if (&other != &rig.sensors.position() && &other != gauge)
      part(in_words(name_of(other.kind)).c_str(), sensor(other));
  if (!contents.handed_out) part("effects", effects(rig.effects));
  return html + "</dl>\n";
}

}  // namespace mckibben::report
