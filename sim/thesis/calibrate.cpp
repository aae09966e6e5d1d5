// See the header.
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <sim/thesis/calibrate.hpp>

namespace mckibben::thesis {
namespace {

constexpr double largest_number = 1e300;  // what a calibration file may hold in place of infinity

std::string listed(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += fmt::format("{}{:.5g}", text.empty() ? "" : ", ", value);
  return text;
}

std::string runs_left_out(const Grid& grid) {
  if (grid.left_out.empty()) return "";
  return fmt::format("; {} run{} could not be used, the first is {}: {}", grid.left_out.size(),
                     grid.left_out.size() == 1 ? "" : "s", grid.left_out.front().id,
                     grid.left_out.front().why);
}

using Wrong = std::vector<data::Finding>;

/// What there is with one load: speeds, or as long as these are not known, runs.
struct AtLoad {
  double load_kg = 0.0;
  std::size_t speeds = 0;
  std::string words;
};

/// All that the orders need and the data set lacks, in one message; empty if nothing. `more`: whether more of
/// the same would help.
std::string too_few(const domain::Dataset& dataset, const Orders& orders, const std::vector<AtLoad>& there,
                    std::size_t merged_loads, bool more = true) {
  constexpr int highest_speed_order = 2, highest_load_order = 3;  // T 4.13, T 4.15
  const auto loads = static_cast<std::size_t>(std::min(orders.load, highest_load_order)) + 1;
  const auto speeds = static_cast<std::size_t>(std::min(orders.speed, highest_speed_order)) + 1;
  std::string kg, lacking;
  std::size_t fewest = speeds;
  for (const AtLoad& one : there) {
    kg += fmt::format("{}{:.5g}", kg.empty() ? "" : ", ", one.load_kg);
    if (one.speeds >= speeds) continue;
    fewest = std::min(fewest, one.speeds);
    lacking += fmt::format("{}{:.5g} kg ({})", lacking.empty() ? "" : ", ", one.load_kg, one.words);
  }
  const bool few_loads = there.size() < loads;
  if (!few_loads && lacking.empty()) return "";
  return in_unit(
      dataset.rig.command_unit(),
      fmt::format(
          "calibrate needs {} load{} and, with each, {} speed{} of the current. There {} {} load{} ({} "
          "kg{}){}. {} {}{}{}",
          loads, loads == 1 ? "" : "s", speeds, speeds == 1 ? "" : "s", there.size() == 1 ? "is" : "are",
          there.size(), there.size() == 1 ? "" : "s", kg,
          merged_loads > 0 ? "; loads within 0.1 % of each other are one" : "",
          lacking.empty() ? "" : "; too few speeds with " + lacking,
          more ? fmt::format("Measure {}{}{}, or set", few_loads ? "more loads" : "",
                             few_loads && !lacking.empty() ? " and " : "",
                             lacking.empty() ? "" : "sines or triangles of more periods")
               : "Or set",
          few_loads ? fmt::format("--load-order {}", there.size() - 1) : "",
          few_loads && !lacking.empty() ? " " : "",
          lacking.empty() ? "" : fmt::format("--speed-order {}", fewest - 1)));
}

/// Effects that change the pull otherwise than by what is counted, or friction: neither the force balance nor
/// a weighing would see them.
void check_effects(const domain::Dataset& dataset, Wrong& wrong) {
  std::string changed;
  const auto add = [&](std::string_view name) {
    changed += (changed.empty() ? "" : ", ") + std::string(name);
  };
  std::apply(
      [&]<class... E>(const E&... effect) {
        const auto look = [&]<class One>(const One& one) {
          if constexpr (plant::declares<One>(plant::Hook::end_correction_shift) ||
                        plant::declares<One>(plant::Hook::pressing_shift) ||
                        std::same_as<One, plant::ResidualForce>)
            if (!one.absent()) add(One::name);
        };
        (look(effect), ...);
      },
      dataset.rig.effects.all);
  for (const auto& law : dataset.rig.effects.laws.list)
    if (!law.absent() && law.text->adds == plant::LawTarget::force) add(law.text->name);
  if (!changed.empty())
    wrong.push_back(
        {.message = fmt::format(
             "the rig has {}, and the thesis's models know no muscle with it: friction (T 4.6) is "
             "computed from the braid force of T 2.8. Controllers with a model of the whole rig "
             "(model_inverse) count it; --rig names a rig without it",
             changed)});
}

/// Enough loads and speeds for the orders that are asked for. If too few because nothing moved, the cause
/// leads.
void check_grid(const domain::Dataset& dataset, const Grid& grid, const Options& options, Wrong& wrong) {
  std::vector<AtLoad> there;
  for (const double load_kg : grid.loads_kg) {
    std::vector<double> found;
    for (const Cell& cell : grid.of(Direction::contraction))
      if (cell.load_kg == load_kg) found.push_back(cell.speed_mA_per_s);
    there.push_back({load_kg, found.size(), listed(found) + " mA/s"});
  }
  const std::string still = grid.still_runs(dataset.rig.valve);
  const std::string short_of = too_few(dataset, options.orders, there, grid.merged_loads, still.empty());
  if (short_of.empty()) return;
  wrong.push_back({.message = still.empty() ? short_of + runs_left_out(grid)
                                            : fmt::format("{}. Without these runs, {}", still, short_of)});
}

/// Friction that drives the motion on the whole is no friction.
void check_friction(const domain::Dataset& dataset, const Grid& grid, Wrong& wrong) {
  for (const Direction direction : directions) {
    double sum = 0.0;
    for (const Cell& cell : grid.of(direction)) sum += vector(cell.samples.coefficient).sum();
    if (sum <= 0.0)
      wrong.push_back(
          {.message = fmt::format(
               "in {} the muscle as computed (T 2.8) pulls {} than load and inertia explain, so friction "
               "comes out negative: wrong rig or loads? rest_radius, braid_angle, end_correction{} "
               "and the valve's line decide",
               name_of(direction), direction == Direction::contraction ? "less" : "more",
               tube_pull_of(dataset.rig) ? ", bladder_elasticity" : "")});
  }
}

controllers::CalibratedRange range_of(const Grid& grid) {
  controllers::CalibratedRange range;
  range.lowest_ratio = 1.0;
  for (const Direction direction : directions)
    for (const Cell& cell : grid.of(direction)) {
      const auto e = vector(cell.samples.contraction_ratio);
      range.lowest_ratio = std::min(range.lowest_ratio, e.minCoeff());
      range.highest_ratio = std::max(range.highest_ratio, e.maxCoeff());
    }
  range.lowest_load_kg = grid.loads_kg.front();
  range.highest_load_kg = grid.loads_kg.back();
  range.lowest_speed_mA_per_s = grid.speeds_mA_per_s.front();
  range.highest_speed_mA_per_s = grid.speeds_mA_per_s.back();
  return range;
}

class Details {
 public:
  explicit Details(std::vector<controllers::FittedCoefficient>& list) : list_(list) {}

  void add(std::string name, const Estimate& estimate) {
    list_.push_back({std::move(name), estimate.value, std::min(estimate.standard_error, largest_number),
                     std::min(estimate.condition, largest_number), estimate.determined()});
  }
  void add(Direction direction, const FrictionFit& fit) {
    const std::string name = fmt::format("{}_friction.", name_of(direction));
    add(name + "f0", fit.f0);
    add(name + "f1", fit.f1);
    add(name + "f2", fit.f2);
    add(name + "f3", fit.f3);
  }
  void add(const PressureFit& fit, PressureFitting fitting) {
    for (std::size_t curve = 0; curve < fit.shape.curves.size(); ++curve)
      for (int i = 0; i <= fit.shape.curves[curve].load_order; ++i)
        add(fmt::format("{}[{}]", fit.shape.curves[curve].name, i),
            fitting == PressureFitting::joint ? fit.joint_estimates[curve][static_cast<std::size_t>(i)]
                                              : fit.in_load[curve].estimate(i));
  }

 private:
  std::vector<controllers::FittedCoefficient>& list_;
};

}  // namespace

void require_pressure_valve(const domain::Dataset& dataset) {
  if (dataset.rig.valve.is_on_off())
    refuse(dataset,
           "the rig's valve is on_off, which sets a flow: the thesis's models are of a valve that sets a "
           "pressure (servo, regulator). Controllers with a model of the whole rig (model_inverse) count it");
}

void require_enough_runs(const domain::Dataset& dataset, const Orders& orders) {
  std::map<double, std::size_t> runs;
  for (const domain::Run& run : dataset.runs) ++runs[run.load_kg];
  std::vector<AtLoad> there;
  for (const auto& [load_kg, count] : runs)
    there.push_back({load_kg, count, fmt::format("{} run{}", count, count == 1 ? "" : "s")});
  if (std::string message = too_few(dataset, orders, there, 0); !message.empty())
    refuse(dataset, std::move(message));
}

CalibrationResult calibrate(const domain::Dataset& dataset, const Options& options) {
  require_pressure_valve(dataset);
  CalibrationResult result;
  Wrong wrong;
  check_effects(dataset, wrong);
  result.grid = make_grid(dataset, options.processing, std::move(wrong));
  wrong.clear();
  check_grid(dataset, result.grid, options, wrong);
  check_friction(dataset, result.grid, wrong);
  if (!wrong.empty()) throw data::UnfitData(dataset, std::move(wrong));

  controllers::Calibration& calibration = result.calibration;
  Details details(calibration.details);
  for (const Direction direction : directions) {
    const auto i = static_cast<std::size_t>(direction);
    result.friction[i] = fit_friction(result.grid, direction, std::min(options.orders.speed, 1));
    result.pressure[i] = fit_pressure(result.grid, direction, options.orders);
    details.add(direction, result.friction[i]);
    details.add(result.pressure[i], options.fitting);
  }
  const auto chosen = [&](Direction direction) -> const PressureModel& {
    const PressureFit& fit = result.pressure_of(direction);
    return options.fitting == PressureFitting::joint ? fit.joint : fit.sequence;
  };
  calibration.contraction_friction = result.friction_of(Direction::contraction).model();
  calibration.relaxation_friction = result.friction_of(Direction::relaxation).model();
  calibration.contraction = contraction_model(chosen(Direction::contraction));
  calibration.relaxation = relaxation_model(chosen(Direction::relaxation));
  calibration.range = range_of(result.grid);
  calibration.tube_pull = tube_pull_of(dataset.rig);
  if (const auto unit = dataset.rig.command_unit(); unit != plant::CommandUnit::mA)
    calibration.command_unit = name_of(unit);
  return result;
}

}  // namespace mckibben::thesis
