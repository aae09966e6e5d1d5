// See the header. A unit is suspected from the slope between readings and model.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include <sim/diagnose/columns.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::diagnose {
namespace {

/// What a column would be multiplied by, if it were in this unit.
struct Unit {
  double factor;
  std::string_view name;
};

/// The unit that explains a slope between measured and predicted values.
std::optional<std::string_view> other_unit(double slope, std::initializer_list<Unit> units) {
  for (const Unit& unit : units) {
    const bool far_from_right = std::abs(std::log(unit.factor)) > std::log(2.0);
    if (far_from_right && slope > 0.0 && std::abs(std::log(slope / unit.factor)) < std::log(1.25))
      return unit.name;
  }
  return std::nullopt;
}

}  // namespace

double range(std::span<const double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

Line::Line(const Series& values, const Series& model) {
  const auto rows = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / rows;
  const double model_mean = std::accumulate(model.begin(), model.end(), 0.0) / rows;
  double along = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    along += (values[k] - mean) * (model[k] - model_mean);
    squares += (model[k] - model_mean) * (model[k] - model_mean);
  }
  if (squares > 0.0) slope = along / squares;
  mean_difference = mean - model_mean;
}

void check_units(const input::Dataset& data, const std::vector<Readings>& model) {
  const plant::Rig& rig = data.rig;
  const double count = run::contraction_per_count(rig);
  const double dead_mA = rig.valve.zero_current_mA, amperes_mA = rig.valve.span_current_mA / 400.0;
  std::vector<input::Problem> problems;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const input::Run& run = data.runs[i];
    const auto bad = [&](std::string message) {
      input::Problem problem;
      problem.file = (data.path.parent_path() / run.file).lexically_normal().string();
      problem.message = std::move(message);
      problems.push_back(std::move(problem));
    };
    const double largest_mA = *std::max_element(run.current_mA.begin(), run.current_mA.end());
    if (largest_mA > 0.0 && largest_mA < amperes_mA)
      bad(fmt::format("current_mA: never above {:.3g}; this looks like amperes, not mA", largest_mA));
    else if (largest_mA < dead_mA && range(run.contraction_ratio) > 20.0 * count)
      bad(fmt::format(
          "current_mA: never above {:.3g}, where the valve does nothing (below {:.3g} mA), yet the "
          "muscle moves; is this another unit, or a share of the range?",
          largest_mA, dead_mA));
    if (range(model[i].contraction_ratio) > 20.0 * count) {
      const double length_m = rig.muscle.rest_length_m;
      const double slope = Line(run.contraction_ratio, model[i].contraction_ratio).slope;
      const auto unit = other_unit(slope, {{100.0, "per cent"},
                                           {length_m, "metres"},
                                           {1e3 * length_m, "millimetres"},
                                           {1.0 / count, "counts"}});
      if (slope < -0.3)
        bad(fmt::format(
            "contraction_ratio: from {:.3g} to {:.3g}, and it falls while the current rises; is its "
            "sign or its zero another?",
            run.contraction_ratio.front(),
            *std::min_element(run.contraction_ratio.begin(), run.contraction_ratio.end())));
      if (unit)
        bad(fmt::format("contraction_ratio: up to {:.4g}; this looks like {}, not a ratio",
                        *std::max_element(run.contraction_ratio.begin(), run.contraction_ratio.end()),
                        *unit));
    }
    if (!run.muscle_pressure_Pa) continue;
    const Series& shown = *run.muscle_pressure_Pa;
    const Line pressure(shown, model[i].pressure_Pa);
    if (range(model[i].pressure_Pa) > 0.3 * bar_Pa) {
      const auto unit = other_unit(
          pressure.slope, {{100.0, "kPa"}, {14.504, "psi"}, {1e3, "mbar"}, {0.1, "MPa"}, {1e5, "Pa"}});
      if (unit)
        bad(fmt::format("muscle_pressure_bar: up to {:.4g}; this looks like {}, not bar",
                        *std::max_element(shown.begin(), shown.end()) / bar_Pa, *unit));
      if (pressure.slope < 0.5 || pressure.slope > 2.0) continue;
    }
    const auto lowest = [](const Series& values) { return *std::min_element(values.begin(), values.end()); };
    const auto an_atmosphere = [&](double difference_Pa) {
      return std::abs(difference_Pa / rig.gas.atmosphere_Pa - 1.0) < 0.2;
    };
    if (an_atmosphere(pressure.mean_difference) &&
        an_atmosphere(lowest(shown) - lowest(model[i].pressure_Pa)))
      bad("muscle_pressure_bar: about one atmosphere too high; this looks like absolute, not gauge pressure");
  }
  if (!problems.empty()) throw input::BadInput(std::move(problems));
}

}  // namespace mckibben::diagnose
