// Rides and lines; see the header. One scale for all pictures, so that they can be laid side by side.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <plant/plant.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/parameter.hpp>
#include <sim/output/axes.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/effect_pictures.hpp>
#include <sim/output/svg.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::output {
namespace {

constexpr double load_kg = 16.138, low_mA = 4.0, high_mA = 14.0;

constexpr double picture_width = 600.0, picture_height = 380.0, loop_width = 250.0, loop_top = 92.0,
                 loop_bottom = 330.0;

/// A triangle of current, and where its panel lies.
struct Ride {
  const char* title;
  double period_s, duration_s;
  double left_px;
};
constexpr std::array rides{Ride{"slow: up and down in 20 s", 20.0, 40.0, 56.0},
                           Ride{"fast: up and down in 2.5 s", 2.5, 10.0, 336.0}};

/// Contraction ratios over pressures in bar.
Panel panel_of(const Ride& ride) {
  return {.x = {.from_px = ride.left_px, .to_px = ride.left_px + loop_width, .low = 0.4, .high = 3.5},
          .y = {.from_px = loop_bottom, .to_px = loop_top, .low = -0.01, .high = 0.24}};
}

/// Inks for a light and for a dark page: the picture follows what the reader's system asks for.
constexpr const char* style =
    "<style>\n"
    ".ground { fill: #ffffff } text { fill: #222222 } .grid { stroke: #e2e2e2 }\n"
    ".nominal { stroke: #a6a6a6 } .first { stroke: #0072B2 } .second { stroke: #D55E00 } .third { stroke: "
    "#009E73 }\n"
    "@media (prefers-color-scheme: dark) {\n"
    "  .ground { fill: #1e2129 } text { fill: #e6e6e6 } .grid { stroke: #3a3f4b }\n"
    "  .nominal { stroke: #737a87 } .first { stroke: #56B4E9 } .second { stroke: #E69F00 } .third { stroke: "
    "#5FD3B0 }\n"
    "}\n</style>\n";

std::string line(const char* ink, double wide, const std::string& d) {
  return fmt::format(
      "<path class='{}' fill='none' stroke-width='{}' stroke-linejoin='round' "
      "stroke-linecap='round' d='{}'/>\n",
      ink, wide, d);
}

std::string loop(const plant::Rig& rig, const Ride& ride, bool gauge, const char* ink, double wide) {
  const Panel panel = panel_of(ride);
  controllers::TriangleCurrent current;
  current.low_mA = low_mA;
  current.high_mA = high_mA;
  current.period_s = ride.period_s;
  std::string d;
  double last_x = 0.0, last_y = 0.0;
  for (const auto& [pressure_bar, ratio] : loop_of(rig, load_kg, current, ride.duration_s, gauge)) {
    const double x = panel.x.px(pressure_bar), y = panel.y.px(ratio);
    if (!d.empty() && std::hypot(x - last_x, y - last_y) < 2.5) continue;
    d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? 'M' : 'L', x, y);
    last_x = x, last_y = y;
  }
  return line(ink, wide, d);
}

/// The ratios are written beside the first panel, and hold for all.
std::string axes(const Ride& ride, bool gauge) {
  const Panel panel = panel_of(ride);
  const bool first = &ride == &rides.front();
  std::vector<Tick> ratios = round_numbers(panel.y, 6);
  if (!first)
    for (Tick& tick : ratios) tick.text.clear();
  return fmt::format("<text x='{}' y='{}'>{}</text>\n", ride.left_px, loop_top - 8, ride.title) +
         panel.across(round_numbers(panel.x, 4),
                      gauge ? "pressure the gauge shows [bar]" : "commanded pressure [bar]") +
         panel.upwards(ratios, first ? "contraction ratio" : "") + panel.frame();
}

/// How many typical sizes make the effect plain to see. Where none in reach do, as with the gas (no heat
/// exchanged at n = 1.4), the picture shows just that.
double telling_times(const diagnose::Candidate& law) {
  struct Times {
    std::string_view effect;
    double times;
  };
  constexpr Times others[] = {
      {"bladder_creep", 10.0}, {"encoder_backlash", 12.0},        {"muscle_leak", 12.0},
      {"polytropic_gas", 2.0}, {"speed_dependent_friction", 2.0}, {"supply_droop", 20.0},
      {"valve_lag", 10.0},     {"friction_warm_up", 3.0}};
  for (const auto& [effect, times] : others)
    if (law.effect == effect) return times;
  return law.own ? 1.0 : 4.0;
}

}  // namespace

std::vector<std::pair<double, double>> loop_of(const plant::Rig& rig, double load_kg,
                                               const controllers::TriangleCurrent& current, double duration_s,
                                               bool gauge) {
  const auto ticks = static_cast<std::size_t>(std::lround(duration_s / rig.tick_s));
  const auto controller = current.make(run::knowledge_of(rig, std::vector<double>(ticks, 0.0)));
  const run::Recording recording =
      run::simulate({.rig = rig, .load_kg = load_kg, .ticks = ticks}, *controller);
  if (!recording.failure.empty()) throw std::runtime_error(recording.failure);
  const plant::Plant plant(rig, load_kg);
  const double count = run::contraction_per_count(rig);
  std::vector<std::pair<double, double>> points;
  for (const run::Sample& sample : recording.samples) {
    const double pressure_Pa =
        gauge ? sample.shown[plant::Sensed::muscle_pressure] : plant.reference_pressure_Pa(sample.current_mA);
    points.emplace_back(pressure_Pa / 1e5, (static_cast<double>(sample.counts) + 0.5) * count);
  }
  return points;
}

std::string effect_svg(std::string_view effect, const plant::Rig& nominal) {
  std::vector<std::pair<std::string, plant::Rig>> laws;
  double times = 1.0;
  for (const auto& law : diagnose::catalogue(nominal)) {
    if (law.effect != effect) continue;
    auto& [words, rig] =
        laws.emplace_back(law.variant.empty() ? "" : law.variant + ": ", law.chosen(nominal));
    const auto set = [&, &words = words, &rig = rig](const std::string& path, double value) {
      const auto found = diagnose::find(rig, path);
      *found.value = value;
      words += fmt::format("{}{} {}", words.empty() || words.ends_with(": ") ? "" : ", ",
                           path.substr(path.rfind('.') + 1), readable(value, found.unit));
    };
    for (const auto& term : diagnose::catalogue(nominal)) {
      if (term.effect != effect || (term.variant != law.variant && term.variant != law.adds_to)) continue;
      set(term.amplitude, (law.own ? 0.0 : term.absent) + telling_times(term) * term.typical);
      times = std::max(times, telling_times(term));
      if (!term.shape.empty()) set(term.shape, term.shapes[1]);
      for (const auto& further : term.further) set(further.path, further.value);
    }
  }
  if (laws.empty()) throw std::invalid_argument("no picture of " + std::string(effect));

  constexpr std::array inks{"first", "second", "third"};
  std::string svg = svg_begin(picture_width, picture_height, 14, style) +
                    fmt::format("<text x='12' y='22'><tspan font-weight='bold'>{}</tspan>{}</text>\n", effect,
                                times > 1.0 ? fmt::format(" exaggerated, {:g} \u00d7 typical", times) : "");
  const auto legend = [&](double x, double y, const char* ink, double wide, const std::string& words) {
    svg += line(ink, wide, fmt::format("M{} {}h22", x, y - 5)) +
           fmt::format("<text x='{}' y='{}'>{}</text>\n", x + 30, y, words);
  };
  legend(404, 22, "nominal", 4.0, fmt::format("nominal rig, {:g} kg", load_kg));
  for (std::size_t i = 0; i < laws.size(); ++i)
    legend(12, 44.0 + 20.0 * static_cast<double>(i), inks[i], 2.2, laws[i].first);
  const bool gauge = effect == plant::GaugeError::name;
  for (const Ride& ride : rides) {
    svg += axes(ride, gauge) + loop(nominal, ride, gauge, "nominal", 4.0);
    for (std::size_t i = 0; i < laws.size(); ++i) svg += loop(laws[i].second, ride, gauge, inks[i], 2.2);
  }
  return svg + "</svg>\n";
}

}  // namespace mckibben::output
