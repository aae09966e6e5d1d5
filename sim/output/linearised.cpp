// The table, and the systems for other programs; see the header.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <plant/constants.hpp>
#include <sim/domain/number.hpp>
#include <sim/output/json_parts.hpp>
#include <sim/output/linearised.hpp>

namespace mckibben::output {
namespace {

using domain::write_number;
using linear::Complex, linear::Matrix, linear::Study;

constexpr double turn_rad = 2.0 * std::numbers::pi;

std::string command_unit(const Linearised& all) {
  return std::string(plant::name_of(all.rig.command_unit()));
}

std::string root_lines(const char* what, const std::vector<Complex>& roots) {
  std::string text;
  for (const Complex& root : roots) {
    if (root.imag() > 0.0) continue;  // its other half is there
    const double size = std::abs(root);
    const std::string value = root.imag() == 0.0 ? fmt::format("{:.4g}", root.real())
                                                 : fmt::format("{:.4g} ± {:.4g}i", root.real(), -root.imag());
    text += fmt::format("  {:5} {:24} {:>9.3g} Hz", what, value, size / turn_rad);
    if (root.imag() != 0.0) text += fmt::format("  damping {:.3g}", -root.real() / size);
    text += '\n';
  }
  return text;
}

std::string margins_line(const linear::Loop& loop, bool in_a_swing) {
  const linear::Margins& has = loop.margins;
  if (!has.stable && loop.calmed_m_per_s > 0.0)
    return fmt::format(
        "  {:18} unstable {}; swings slower than {:.3g} m/s die out: --swing \"{:.2g} m/s\" gives margins\n",
        loop.name, in_a_swing ? "in this swing" : "without friction", loop.calmed_m_per_s,
        0.5 * loop.calmed_m_per_s);
  if (!has.stable) return fmt::format("  {:18} unstable\n", loop.name);
  const auto at = [](double rad_per_s) { return fmt::format("at {:.3g} Hz", rad_per_s / turn_rad); };
  const std::string gain = has.gain ? fmt::format("{:.3g} ({:.1f} dB) {}", *has.gain,
                                                  20.0 * std::log10(*has.gain), at(has.gain_rad_per_s))
                                    : "no bound";
  const std::string phase = has.phase_rad ? fmt::format("{:.1f} deg {}", *has.phase_rad / plant::degree_rad,
                                                        at(has.phase_rad_per_s))
                                          : "no bound";
  const std::string shrunk =
      has.shrunk_gain ? fmt::format("; swings too at {:.3g} times its gain", *has.shrunk_gain) : "";
  // A resonance just below a gain of 1 binds, too.
  const bool elsewhere = std::abs(std::log(loop.binds_rad_per_s / has.phase_rad_per_s)) > std::log(1.05);
  const std::string binds = loop.binds.empty() ? ""
                            : loop.binds_rad_per_s > 0.0 && elsewhere
                                ? fmt::format(
                                      "; the resonance {} is just below 0 dB: any more gain, and the phase "
                                      "margin there is {:.0f} deg",
                                      at(loop.binds_rad_per_s), loop.left_rad / plant::degree_rad)
                                : fmt::format("; the {} margin binds", loop.binds);
  const std::string faster = loop.calmed_m_per_s > 0.0
                                 ? fmt::format("; swings faster than {:.3g} m/s grow", loop.calmed_m_per_s)
                                 : "";
  return fmt::format("  {:18} {:30} {}{}{}{}{}\n", loop.name, gain, phase, shrunk, faster, binds,
                     loop.shortest ? "; the shortest integral_time searched" : "");
}

std::string position_words(const Linearised& all, const linear::Point& point) {
  return all.rig.has_angle() ? fmt::format("angle {:.2f} deg", point.position / plant::degree_rad)
                             : fmt::format("contraction ratio {:.4f}", point.position);
}

std::string remarks_on(const Linearised& all, const linear::Point& point) {
  std::string text = all.question.threads == linear::Threads::sliding ? "threads slide" : "threads stick";
  if (all.question.swing_m_per_s)
    text += fmt::format(", in a swing of {:.4g} mm/s", *all.question.swing_m_per_s * 1e3);
  if (point.shut) {
    using enum linear::Opening;
    const auto opening = all.question.opening;
    text += opening == both      ? "; the valve is shut: mean of filling and venting"
            : opening == filling ? "; the valve fills"
                                 : "; the valve vents";
  }
  if (point.friction_N > 0.0) text += fmt::format("; friction holds {:.3g} N either way", point.friction_N);
  if (point.on_stop) text += "; IT LIES ON A STOP: take a higher command or less load";
  if (!point.settled) text += "; STILL MOVING after 10 min: memories of effects creep on";
  return text;
}

std::string lqr_line(const Study& study, const std::string& unit) {
  std::string text = "  lqr: command = base - K (x - x0), K in " + unit + " per unit:";
  for (std::size_t i = 0; i < study.point.slopes.states.size(); ++i)
    text += fmt::format("{} {} {:.4g}", i == 0 ? "" : ",", study.point.slopes.states[i].name,
                        study.lqr[static_cast<Eigen::Index>(i)]);
  if (study.lqr_before.size() > 0) {
    text += "\n       - F (commands before - base), F of the latest first:";
    for (const double each : study.lqr_before) text += fmt::format(" {:.4g}", each);
  }
  if (study.point.reading_delay_s > 0.0)
    text += fmt::format("; x is {:.4g} s late, as it is read", study.point.reading_delay_s);
  return text + "\n";
}

std::string of_study(const Linearised& all, const Study& study) {
  const linear::Point& point = study.point;
  const std::string unit = command_unit(all);
  std::string text = fmt::format("{}, {}: {}, muscle pressure {:.3f} bar", all.name, title_of(all, study),
                                 position_words(all, point), point.pressure_Pa[0] * 1e-5);
  if (all.rig.pair()) text += fmt::format(" and {:.3f} bar", point.pressure_Pa[1] * 1e-5);
  text += "\n  " + remarks_on(all, point) + "\n";
  const linear::System plant = point.system();
  const double gain = gain_at_rest(plant);
  text += fmt::format("  gain at rest {:.4g} {}/{}; muscle pressure {:.4g} bar/{}\n",
                      all.rig.has_angle() ? gain / plant::degree_rad : gain,
                      all.rig.has_angle() ? "deg" : "1", unit, gain_at_rest(point.system(1)) * 1e-5, unit);
  text += root_lines("pole", poles(plant)) + root_lines("zero", zeros(plant));
  if (point.delay_s() > 0.0)
    text += fmt::format("  delays: command {:.4g} s, reading {:.4g} s\n", point.command_delay_s,
                        point.reading_delay_s);
  if (!study.loops.empty()) text += fmt::format("  {:18} {:30} {}\n", "loop", "gain margin", "phase margin");
  for (const auto& loop : study.loops) text += margins_line(loop, all.question.swing_m_per_s.has_value());
  if (all.question.margins)
    text += study.by_margins ? "  " + pid_line(all, study) + "\n" : "  no PID has these margins here\n";
  if (all.question.lqr) text += lqr_line(study, unit);
  return text;
}

std::string matrix_text(const Matrix& matrix, const char* row_begin, const char* row_end,
                        const char* between) {
  std::string text;
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    text += (r == 0 ? "" : between) + std::string(row_begin);
    for (Eigen::Index c = 0; c < matrix.cols(); ++c)
      text += (c == 0 ? "" : ", ") + write_number(matrix(r, c));
    text += row_end;
  }
  return text;
}
std::string in_python(const Matrix& matrix) {
  return "[" + matrix_text(matrix, "[", "]", ", ") + "]";
}
std::string in_matlab(const Matrix& matrix) {
  return "[" + matrix_text(matrix, "", "", "; ") + "]";
}

std::string names_text(const std::vector<engine::Signal>& signals) {
  std::string text;
  for (const auto& signal : signals) text += (text.empty() ? "'" : ", '") + signal.name + "'";
  return text;
}

/// What the gain of a state feedback acts on, as comment lines.
std::string words_on_lqr(const Linearised& all, const std::string& name, const std::string& before) {
  if (!all.question.lqr) return "";
  std::vector<std::string> lines{
      fmt::format("{}: u = -K x, of the system sampled every tick ({:g} s), not of the one in time.", name,
                  all.rig.tick_s)};
  if (all.rig.pair())
    lines.push_back(fmt::format(
        "u is one of two inputs in one: it goes to muscle 1 with plus and to muscle 2 with minus; "
        "the column is B [1; {:.6g}].",
        all.studies.front().point.direction[1]));
  if (std::ranges::any_of(all.studies, [](const Study& one) { return one.lqr_before.size() > 0; }))
    lines.push_back(fmt::format(
        "{}_of_commands_before: F, u = -K x - F (u before), the latest first; x as late as it is read.",
        name));
  std::string text;
  for (const std::string& line : lines) text += before + line + "\n";
  return text;
}

}  // namespace

std::string title_of(const Linearised& all, const Study& study) {
  const std::string unit = command_unit(all);
  std::string text =
      fmt::format("{:g} kg at {:.4g} {}", study.point.load_kg, study.point.command.current_mA, unit);
  if (all.rig.pair()) text += fmt::format(" and {:.4g} {}", study.point.command.opposite_mA, unit);
  return text;
}

std::string gains_text(const Linearised& all, const controllers::PidForm& pid) {
  return fmt::format("proportional: {:.4g} {}{}, integral_time: {:.4g} s, derivative_time: {:.4g} s",
                     *pid.proportional_mA, command_unit(all), all.rig.has_angle() ? "/rad" : "",
                     *pid.integral_time_s, *pid.derivative_time_s);
}

std::string pid_line(const Linearised& all, const Study& study) {
  return fmt::format("{{kind: pid, name: pid_by_margins, {}}}",
                     gains_text(all, linear::pid_of(*study.by_margins)));
}

std::string table_of(const Linearised& all) {
  std::string text;
  for (const Study& study : all.studies) text += (text.empty() ? "" : "\n") + of_study(all, study);
  if (!all.tuned.empty()) text += "\ngains tuned, as by `run`\n";
  for (const auto& [controller, pid] : all.tuned)
    text += fmt::format("  {}: {}\n", controller, gains_text(all, pid));
  for (const auto& name : all.not_linear)
    text += fmt::format("{}: not linear, and has no margins here\n", name);
  for (const auto& name : all.no_loop) text += fmt::format("{}: plays a command and has no loop\n", name);
  return text;
}

std::string python_control(const Linearised& all) {
  std::string text = fmt::format(
      "\"\"\"{} as `mckibben linearise` found it, in SI units: `points`, systems of python-control.\n\n"
      "x, u and y count from the point. dead_time_s: of command and reading together, not in the "
      "systems.\n{}\"\"\"\nimport control\n\npoints, dead_time_s, lqr, lqr_of_commands_before = [], [], [], "
      "[]\n",
      all.name, words_on_lqr(all, "lqr", ""));
  for (const Study& study : all.studies) {
    const auto& s = study.point.slopes;
    text += fmt::format(
        "\n# {}\npoints.append(control.ss(\n    {},\n    {},\n    {},\n    {},\n    states=[{}],\n    "
        "inputs=[{}],\n    outputs=[{}]))\ndead_time_s.append({})\nlqr.append({})\n"
        "lqr_of_commands_before.append({})\n",
        title_of(all, study), in_python(s.A), in_python(s.B), in_python(s.C), in_python(s.D),
        names_text(s.states), names_text(s.inputs), names_text(s.outputs),
        write_number(study.point.delay_s()), study.lqr.size() > 0 ? in_python(study.lqr) : "None",
        study.lqr_before.size() > 0 ? in_python(study.lqr_before) : "None");
  }
  return text + "\nrig = points[0]\n";
}

std::string matlab(const Linearised& all) {
  std::string text = fmt::format(
      "% {} as `mckibben linearise` found it, in SI units. x, u and y count from the point.\n{}points = "
      "{{}};\nlqr_gain = {{}};\nlqr_gain_of_commands_before = {{}};\n",
      all.name, words_on_lqr(all, "lqr_gain", "% "));
  for (std::size_t i = 0; i < all.studies.size(); ++i) {
    const Study& study = all.studies[i];
    const auto& s = study.point.slopes;
    text += fmt::format(
        "\n% {}\npoints{{{}}} = ss({}, ...\n  {}, ...\n  {}, ...\n  {}, ...\n  'StateName', {{{}}}, ...\n  "
        "'InputName', {{{}}}, ...\n  'OutputName', {{{}}}, ...\n  'InputDelay', {});\nlqr_gain{{{}}} = {};\n"
        "lqr_gain_of_commands_before{{{}}} = {};\n",
        title_of(all, study), i + 1, in_matlab(s.A), in_matlab(s.B), in_matlab(s.C), in_matlab(s.D),
        names_text(s.states), names_text(s.inputs), names_text(s.outputs),
        write_number(study.point.delay_s()), i + 1, in_matlab(study.lqr), i + 1, in_matlab(study.lqr_before));
  }
  return text + "\nrig = points{1};\n";
}

}  // namespace mckibben::output
