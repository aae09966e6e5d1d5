// Layout of calibration.json.
#include <cmath>

#include <sim/output/calibration_report.hpp>
#include <sim/output/json_parts.hpp>
#include <sim/thesis/figures.hpp>

namespace mckibben::output {
namespace {

using input::Json;
using thesis::Direction;

Json finite(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json estimate_json(const thesis::Estimate& estimate) {
  Json entry{{"value", estimate.determined() ? Json(estimate.value) : Json(nullptr)},
             {"standard_error", finite(estimate.standard_error)},
             {"condition", finite(estimate.condition)}};
  if (!estimate.determined()) entry["not_determined"] = estimate.why_not;
  return entry;
}

Json dropped_json(const thesis::Dropped& dropped) {
  return {{"current_off_the_line", dropped.off_the_line},
          {"too_near_zero_for_ln_e", dropped.near_zero},
          {"above_e_max", dropped.beyond_limit},
          {"still_or_not_following", dropped.not_following},
          {"before_the_current_moves", dropped.first_rows}};
}

/// `named`: a key, in the unit of the rig's commands.
Json friction_json(const thesis::FrictionFit& fit, const auto& named) {
  Json document{{"mean", fit.mean},
                {"standard_deviation", fit.standard_deviation},
                {"spread", fit.spread()},
                {"f0", estimate_json(fit.f0)},
                {named("f1_s2_per_mA2"), estimate_json(fit.f1)},
                {"f2", estimate_json(fit.f2)},
                {"f3", estimate_json(fit.f3)}};
  Json& speeds = document["speeds"] = Json::array();
  for (const auto& at : fit.speeds) {
    const auto n = static_cast<Eigen::Index>(speeds.size());
    Json entry{{named("current_speed_mA_per_s"), at.speed_mA_per_s},
               {"samples", at.samples.size()},
               {"mean", at.mean},
               {"intercept", estimate_json(fit.common.estimate(n))},
               {"standard_deviation", at.common_deviation}};
    entry["chi_square"] = {{"degrees_of_freedom", estimate_json(at.chi_square.parameter_estimate())},
                           {"amplitude", estimate_json(at.chi_square.estimate(0))},
                           {"standard_deviation", at.chi_square.linear.standard_deviation}};
    Json polynomial = Json::array();
    for (Eigen::Index i = 0; i < at.fifth_order.values.size(); ++i)
      polynomial.push_back(estimate_json(at.fifth_order.estimate(i)));
    entry["fifth_order"] = {{"p", std::move(polynomial)},
                            {"standard_deviation", at.fifth_order.standard_deviation}};
    entry["superposition"] = {{"constant", estimate_json(at.superposition.estimate(0))},
                              {"f2", estimate_json(at.superposition.estimate(1))},
                              {"f3", estimate_json(at.superposition.estimate(2))},
                              {"standard_deviation", at.superposition.standard_deviation}};
    speeds.push_back(std::move(entry));
  }
  return document;
}

Json stages_json(const thesis::Stages& stages) {
  return {{"own", stages.own},         {"averaged_at_once", stages.fixed_at_once},
          {"averaged", stages.fixed},  {"in_speed", stages.in_speed},
          {"in_load", stages.in_load}, {"joint", stages.joint}};
}

Json pressure_json(const thesis::PressureFit& fit, const std::vector<double>& loads_kg, const auto& named) {
  Json document{{"mean_Pa", fit.mean_Pa}, {"standard_deviation_Pa", stages_json(fit.deviation)}};
  Json& curves = document["coefficients"] = Json::object();
  for (std::size_t c = 0; c < fit.shape.curves.size(); ++c) {
    const auto& law = fit.shape.curves[c];
    Json entry{{"equation", law.equation}, {"figure", law.figure}, {"order_in_load", law.load_order}};
    for (std::size_t load = 0; load < loads_kg.size(); ++load) {
      Json at{{"load_kg", loads_kg[load]}, {"value", fit.at_load[c](static_cast<Eigen::Index>(load))}};
      if (law.part != thesis::exponent && fit.shape.follows_speed(law.part))
        at["fit_in_speed"] = estimate_json(fit.speed_estimates[c][load]);
      entry["at_load"].push_back(std::move(at));
    }
    for (int i = 0; i <= law.load_order; ++i) {
      entry["sequence"].push_back(estimate_json(fit.in_load[c].estimate(i)));
      entry["joint"].push_back(estimate_json(fit.joint_estimates[c][static_cast<std::size_t>(i)]));
    }
    curves[law.name] = std::move(entry);
  }
  Json& cells = document["cells"] = Json::array();
  for (const auto& cell : fit.cells) {
    Json own = Json::array();
    for (const Eigen::Index i : {0, 1, 2}) own.push_back(estimate_json(cell.own.estimate(i)));
    own.push_back(estimate_json(cell.own.parameter_estimate()));
    own.push_back(estimate_json(cell.own.estimate(3)));
    cells.push_back({{"load_kg", cell.load_kg},
                     {named("current_speed_mA_per_s"), cell.speed_mA_per_s},
                     {"mean_Pa", cell.mean_Pa},
                     {"own_fit", std::move(own)},
                     {"standard_deviation_Pa", stages_json(cell.deviation)}});
  }
  return document;
}

}  // namespace

std::string json_of(const domain::Dataset& dataset, const thesis::CalibrationResult& result,
                    const thesis::Options& options) {
  const auto& grid = result.grid;
  const auto named = [&](const char* key) { return in_unit(result.command_unit(), key); };
  Json document = heading_json("mckibben-calibration-report/1", dataset.inputs);
  document["report"] = "report.html";
  document["options"] = {
      {"pressure", options.processing.pressure == thesis::PressureSource::current ? "current" : "gauge"},
      {"acceleration",
       options.processing.acceleration == thesis::Acceleration::counted ? "counted" : "neglected"},
      {"fit", options.fitting == thesis::PressureFitting::joint ? "joint" : "sequence"},
      {"order_in_load", options.orders.load},
      {"order_in_speed", options.orders.speed}};
  document["rules"] = {
      {"largest_condition", thesis::largest_condition},    {"standard_errors_from_zero", 2},
      {"lowest_counts", options.processing.lowest_counts}, {"window_ticks", options.processing.window_ticks},
      {"window_counts", options.processing.window_counts}, {"most_dots_in_a_figure", thesis::most_dots}};
  document["loads_kg"] = grid.loads_kg;
  document[named("current_speeds_mA_per_s")] = grid.speeds_mA_per_s;
  document["spreads_mean"] = meanings_of(result, options);
  document["warnings"] = warnings_of(result, options);
  document["rows_dropped"] = dropped_json(grid.dropped);
  document["runs_left_out"] = Json::array();
  for (const auto& run : grid.left_out)
    document["runs_left_out"].push_back({{"id", run.id}, {"why", run.why}});
  for (const Direction direction : thesis::directions) {
    const std::string name(name_of(direction));
    document["friction"][name] = friction_json(result.friction_of(direction), named);
    document["pressure"][name] = pressure_json(result.pressure_of(direction), grid.loads_kg, named);
  }
  return text_of(document);
}

}  // namespace mckibben::output
