// The document of `linearise`, and its Bode plot as numbers and as a picture.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/output/axes.hpp>
#include <sim/output/json_parts.hpp>
#include <sim/output/linearised.hpp>
#include <sim/output/svg.hpp>

namespace mckibben::output {
namespace {

using input::Json;
using linear::Complex, linear::Matrix, linear::Study;

Json rows_json(const Matrix& matrix) {
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(matrix(r, c));
    rows.push_back(row);
  }
  return rows;
}

Json roots_json(const std::vector<Complex>& roots) {
  Json list = Json::array();
  for (const Complex& root : roots) list.push_back({root.real(), root.imag()});
  return list;
}

Json signals_json(const std::vector<engine::Signal>& signals, const Eigen::VectorXd& at) {
  Json list = Json::array();
  for (std::size_t i = 0; i < signals.size(); ++i)
    list.push_back(
        {{"name", signals[i].name}, {"unit", signals[i].unit}, {"at", at[static_cast<Eigen::Index>(i)]}});
  return list;
}

Json loop_json(const linear::Loop& loop) {
  const linear::Margins& has = loop.margins;
  Json one{{"name", loop.name}, {"stable", has.stable}, {"sample_s", loop.open.step_s}};
  const auto put = [&](const char* key, const std::optional<double>& value, const char* at,
                       double rad_per_s) {
    one[key] = value ? Json(*value) : Json();
    if (at != nullptr) one[at] = value ? Json(rad_per_s / (2.0 * std::numbers::pi)) : Json();
  };
  if (loop.calmed_m_per_s > 0.0) one["calmed_m_per_s"] = loop.calmed_m_per_s;
  put("gain_margin", has.gain, "gain_margin_Hz", has.gain_rad_per_s);
  put("lowest_gain_margin", has.shrunk_gain, nullptr, 0.0);
  put("phase_margin_rad", has.phase_rad, "phase_margin_Hz", has.phase_rad_per_s);
  if (!loop.binds.empty()) one["binding_margin"] = loop.binds;
  if (loop.shortest) one["at_shortest_integral_time"] = true;
  return one;
}

Json study_json(const Linearised& all, const Study& study) {
  const linear::Point& point = study.point;
  const auto& s = point.slopes;
  const linear::System plant = point.system();
  Json one{{"title", title_of(all, study)},
           {"load_kg", point.load_kg},
           {"settled", point.settled},
           {"on_stop", point.on_stop},
           {"valve_shut", point.shut},
           {"friction_N", point.friction_N},
           {"states", signals_json(s.states, s.state)},
           {"inputs", signals_json(s.inputs, s.input)},
           {"outputs", signals_json(s.outputs, s.output)}};
  one["A"] = rows_json(s.A), one["B"] = rows_json(s.B), one["C"] = rows_json(s.C), one["D"] = rows_json(s.D);
  one["command_delay_s"] = point.command_delay_s;
  one["reading_delay_s"] = point.reading_delay_s;
  one["gain_at_rest"] = gain_at_rest(plant);
  one["poles_per_s"] = roots_json(poles(plant));
  one["zeros_per_s"] = roots_json(zeros(plant));
  one["loops"] = Json::array();
  for (const auto& loop : study.loops) one["loops"].push_back(loop_json(loop));
  if (study.by_margins) one["pid_by_margins"] = pid_line(all, study);
  if (study.lqr.size() > 0) one["lqr"] = rows_json(study.lqr)[0];
  if (study.lqr_before.size() > 0) one["lqr_of_commands_before"] = rows_json(study.lqr_before)[0];
  return one;
}

/// Responses over frequency, phases without jumps [deg].
struct Curve {
  std::string name;
  std::vector<double> Hz, gain, phase_deg;
};

Curve curve_of(const std::string& name, const linear::System& system, double delay_s, double highest_Hz,
               const std::vector<double>& grid) {
  Curve curve{name, {}, {}, {}};
  double before = 0.0;
  for (const double w : grid) {
    const double Hz = w / (2.0 * std::numbers::pi);
    if (Hz > highest_Hz * (1.0 + 1e-9)) break;
    const Complex value = response(system, w) * std::exp(Complex(0.0, -w * delay_s));
    double phase = std::arg(value) * 180.0 / std::numbers::pi;
    if (!curve.Hz.empty()) phase = before + std::remainder(phase - before, 360.0);
    before = phase;
    curve.Hz.push_back(Hz);
    curve.gain.push_back(std::abs(value));
    curve.phase_deg.push_back(phase);
  }
  return curve;
}

/// The rig's, then its loops'.
std::vector<Curve> curves_of(const Linearised& all, const Study& study) {
  const auto grid = linear::frequencies(all.rig.tick_s, 300);
  const double highest_Hz = 0.5 / all.rig.tick_s;
  std::vector<Curve> curves{curve_of("rig", study.point.system(), study.point.delay_s(), highest_Hz, grid)};
  for (const auto& loop : study.loops)
    curves.push_back(curve_of(loop.name, loop.open, 0.0, 0.5 / loop.open.step_s, grid));
  return curves;
}

std::vector<Tick> frequency_ticks(const Scale& x) {
  std::vector<Tick> ticks;
  for (const Decade& line : decades(std::pow(10.0, x.low), std::pow(10.0, x.high)))
    if (line.is_power) ticks.push_back({x.px(std::log10(line.value)), fmt::format("{:g}", line.value)});
  return ticks;
}

std::string curve_path(const Panel& panel, const Curve& curve, const std::vector<double>& values,
                       const char* colour) {
  std::string d;
  for (std::size_t i = 0; i < values.size(); ++i)
    d += fmt::format("{}{:.1f} {:.1f}", i == 0 ? 'M' : 'L', panel.x.px(std::log10(curve.Hz[i])),
                     panel.y.px(values[i]));
  return fmt::format("<path fill='none' stroke='{}' stroke-width='1.8' d='{}'/>\n", colour, d);
}

}  // namespace

std::string json_of(const Linearised& all) {
  Json document = heading_json("mckibben-linearise/1", all.files);
  document["name"] = all.name;
  document["threads"] = all.question.threads == linear::Threads::sliding ? "sliding" : "sticking";
  if (all.question.swing_m_per_s) document["swing_m_per_s"] = *all.question.swing_m_per_s;
  document["points"] = Json::array();
  for (const Study& study : all.studies) document["points"].push_back(study_json(all, study));
  document["tuned"] = Json::array();
  for (const auto& [controller, pid] : all.tuned)
    document["tuned"].push_back({{"controller", controller}, {"gains", gains_text(all, pid)}});
  document["not_linear"] = all.not_linear;
  document["no_loop"] = all.no_loop;
  return text_of(document);
}

std::string bode_csv(const Linearised& all, const Study& study) {
  const auto curves = curves_of(all, study);
  std::string text = "frequency_Hz";
  for (const Curve& curve : curves)
    text +=
        fmt::format(",{0}_gain,{0}_phase_deg", &curve == &curves.front() ? curve.name : curve.name + "_loop");
  text += '\n';
  for (std::size_t i = 0; i < curves.front().Hz.size(); ++i) {
    text += domain::write_number(curves.front().Hz[i]);
    for (const Curve& curve : curves)
      text += i < curve.Hz.size() ? fmt::format(",{:.9g},{:.6g}", curve.gain[i], curve.phase_deg[i]) : ",,";
    text += '\n';
  }
  return text;
}

std::string bode_svg(const Linearised& all, const Study& study) {
  constexpr double width = 860.0, height = 560.0, upper[] = {70.0, 280.0}, lower[] = {310.0, 510.0};
  constexpr double left[] = {80.0, 410.0}, right[] = {500.0, 830.0};
  const std::vector<Curve> curves = curves_of(all, study);
  Rows names(left[0], right[1], 42.0);
  const double first_px = names.bottom_px();
  std::string keys;
  for (std::size_t c = 1; c < curves.size(); ++c) {
    const auto [x, y] = names.next(16.0 + width_px(curves[c].name, 12.0));
    keys += fmt::format("<text x='{:.0f}' y='{:.0f}' fill='{}'>{}</text>\n", x, y,
                        colours[c % colours.size()], escaped(curves[c].name));
  }
  const double further_px = names.bottom_px() - first_px;  // rows of names push the panels down
  std::string svg = svg_begin(width, height + further_px) +
                    fmt::format(
                        "<text x='{}' y='24' font-weight='bold'>{}</text>\n{}"
                        "<g transform='translate(0 {:.0f})'>\n",
                        left[0], escaped(all.name + ", " + title_of(all, study)), keys, further_px);
  const auto draw = [&](const double* across, std::size_t first, std::size_t end, const std::string& heading,
                        const std::string& gain_words, bool with_bounds) {
    Panel gain{.x = {across[0], across[1]}, .y = {upper[1], upper[0]}, .words_px = 52.0};
    Panel phase{.x = {across[0], across[1]}, .y = {lower[1], lower[0]}, .words_px = 52.0};
    std::vector<std::vector<double>> dB;
    for (std::size_t c = first; c < end; ++c) {
      std::vector<double>& one = dB.emplace_back();
      for (std::size_t i = 0; i < curves[c].Hz.size(); ++i) {
        one.push_back(20.0 * std::log10(curves[c].gain[i]));
        gain.x.hold(std::log10(curves[c].Hz[i]));
        gain.y.hold(std::max(one.back(), one.front() - 120.0));
        phase.y.hold(std::max(curves[c].phase_deg[i], -540.0));
      }
    }
    if (with_bounds) gain.y.hold(0.0), phase.y.hold(-180.0);
    phase.x = gain.x;
    gain.y.widen(), phase.y.widen();
    svg += gain.across(frequency_ticks(gain.x), "") + gain.upwards(round_numbers(gain.y, 6), gain_words) +
           gain.heading(heading) + phase.across(frequency_ticks(phase.x), "frequency [Hz]") +
           phase.upwards(round_numbers(phase.y, 6), "phase [deg]");
    const auto level = [&](const Panel& panel, double value) {
      svg +=
          fmt::format("<path class='axis' stroke='#888' stroke-dasharray='4 3' d='M{:.1f} {:.1f}H{:.1f}'/>\n",
                      across[0], panel.y.px(value), across[1]);
    };
    if (with_bounds) level(gain, 0.0), level(phase, -180.0);
    for (const auto& [panel, id, of_gain] :
         {std::tuple{gain, "gain", true}, std::tuple{phase, "phase", false}}) {
      svg += fmt::format(
          "<clipPath id='{0}{1}'><rect x='{2:.1f}' y='{3:.1f}' width='{4:.1f}' height='{5:.1f}'/>"
          "</clipPath><g clip-path='url(#{0}{1})'>\n",
          id, first, panel.x.from_px, panel.y.to_px, panel.x.to_px - panel.x.from_px,
          panel.y.from_px - panel.y.to_px);
      for (std::size_t c = first; c < end; ++c)
        svg += curve_path(panel, curves[c], of_gain ? dB[c - first] : curves[c].phase_deg,
                          colours[c % colours.size()]);
      svg += "</g>\n" + panel.frame();
    }
  };
  const bool angle = all.rig.has_angle();
  const std::string unit(plant::name_of(all.rig.command_unit()));
  draw(left, 0, 1, angle ? "command to angle" : "command to contraction ratio",
       fmt::format("gain [dB re {}/{}]", angle ? "1 rad" : "1", unit), false);
  if (curves.size() > 1) draw(right, 1, curves.size(), "open loops", "gain [dB]", true);
  return svg + "</g>\n</svg>\n";
}

}  // namespace mckibben::output
