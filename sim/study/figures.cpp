// The page, picture and document of the comparison with the thesis's figures.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <controllers/open_loop.hpp>
#include <sim/output/calibration_report.hpp>
#include <sim/run/simulate.hpp>
#include <sim/study/counting.hpp>
#include <sim/study/figures.hpp>
#include <sim/study/lag.hpp>
#include <sim/study/page.hpp>
#include <sim/thesis/quality.hpp>

namespace mckibben::study {
namespace {

using input::Json;
using thesis::Direction;

std::string per_cent(double ratio) {
  return fmt::format("{:.1f} %", 100.0 * ratio);
}

std::string spread(double ratio) {
  return output::spread_text(ratio, 1, " %");
}

double largest_error(const std::vector<Weighing>& weighings) {
  double largest = 0.0;
  for (const Weighing& one : weighings)
    if (one.failure.empty()) largest = std::max(largest, std::abs(one.error()));
  return largest;
}

std::vector<Weighing> weigh_all(const Evidence& evidence, const thesis::CalibrationResult& calibration) {
  std::vector<Weighing> all{weigh(evidence, calibration, printed_load_kg)};
  for (const double load_kg : evidence.from_current.grid.loads_kg)
    all.push_back(weigh(evidence, calibration, load_kg));
  return all;
}

struct Spreads {
  thesis::Acceleration acceleration;
  thesis::PressureSource pressure;
  std::array<double, 2> friction;  ///< by Direction
};

/// Spread of the friction coefficient round T 4.6, for each way to process the data.
std::vector<Spreads> friction_spreads(const Evidence& evidence) {
  std::vector<Spreads> all;
  for (const auto pressure : {thesis::PressureSource::current, thesis::PressureSource::gauge})
    for (const auto acceleration : {thesis::Acceleration::counted, thesis::Acceleration::neglected}) {
      thesis::ProcessingOptions options;
      options.pressure = pressure;
      options.acceleration = acceleration;
      const thesis::Grid grid = thesis::make_grid(evidence.dataset, options);
      Spreads spreads{acceleration, pressure, {}};
      for (std::size_t i = 0; i < thesis::directions.size(); ++i)
        spreads.friction[i] = thesis::fit_friction(grid, thesis::directions[i], 1).spread();
      all.push_back(spreads);
    }
  return all;
}

std::string name_of(const Spreads& spreads) {
  return fmt::format("pressure {}, acceleration {}",
                     spreads.pressure == thesis::PressureSource::current ? "from the current" : "true",
                     spreads.acceleration == thesis::Acceleration::counted ? "counted" : "neglected");
}

struct Ours {
  std::vector<Weighing> weighed;      ///< the printed load first
  std::vector<Weighing> without_lag;  ///< the same with the friction found with the true pressure
  std::vector<Spreads> friction;      ///< as the thesis first
};

std::string verdict(double ours, double printed) {
  return ours < printed ? "below" : "above";
}

std::string side_by_side(const Evidence& evidence, const Ours& ours) {
  const Weighing& unseen = ours.weighed.front();
  std::vector<std::vector<std::string>> rows{{"", "thesis", "ours", "ours is"}};
  if (unseen.failure.empty())
    rows.push_back({fmt::format("{:g} kg, unseen, weighed in five contractions (T 4.3)", printed_load_kg),
                    fmt::format("{:g} kg, {}", printed_weighed_kg, per_cent(printed_error)),
                    fmt::format("{:.2f} kg, {}", unseen.weighed_kg, per_cent(unseen.error())),
                    verdict(std::abs(unseen.error()), printed_error)});
  const double largest = largest_error(ours.weighed);
  rows.push_back({"largest error of a weighed load (T 5)", "below " + per_cent(printed_largest_error),
                  per_cent(largest), verdict(largest, printed_largest_error)});
  const auto add = [&](const std::string& name, double printed, double value) {
    rows.push_back({name, "below " + per_cent(printed), spread(value), verdict(value, printed)});
  };
  for (const Direction direction : thesis::directions)
    add(fmt::format("friction coefficient, spread over mean, {}", thesis::name_of(direction)),
        thesis::printed_friction_spread, ours.friction.front().friction[static_cast<std::size_t>(direction)]);
  const std::pair<const char*, double thesis::Stages::*> stages[] = {
      {"each load and speed by itself (T 4.7)", &thesis::Stages::own},
      {"the thesis's sequence of fits (T 4.14 to 4.28)", &thesis::Stages::in_load},
      {"the same equations, all samples at once", &thesis::Stages::joint}};
  for (const Direction direction : thesis::directions)
    for (const auto& [name, stage] : stages) {
      const thesis::PressureFit& fit = evidence.from_current.pressure_of(direction);
      add(fmt::format("pressure, spread over mean, {}, {}", thesis::name_of(direction), name),
          thesis::printed_pressure_spread, fit.deviation.*stage / fit.mean_Pa);
    }
  return table(rows);
}

std::string loads(const Ours& ours) {
  std::vector<std::vector<std::string>> rows{
      {"load [kg]", "weighed [kg]", "spread [kg]", "error", "error with friction from the true pressure"}};
  for (std::size_t i = 0; i < ours.weighed.size(); ++i) {
    const Weighing &one = ours.weighed[i], &other = ours.without_lag[i];
    const bool done = one.failure.empty();
    rows.push_back({fmt::format("{:g}", one.load_kg), done ? fmt::format("{:.2f}", one.weighed_kg) : "-",
                    done ? fmt::format("{:.3f}", one.spread_kg) : "-",
                    done ? per_cent(one.error()) : one.failure,
                    other.failure.empty() ? per_cent(other.error()) : other.failure});
  }
  return table(rows);
}

std::string friction(const Ours& ours) {
  std::vector<std::vector<std::string>> rows{
      {"spread over mean of the friction coefficient", "contraction", "relaxation"}};
  for (const Spreads& spreads : ours.friction)
    rows.push_back({name_of(spreads), spread(spreads.friction[0]), spread(spreads.friction[1])});
  return table(rows);
}

std::string why_friction(const Evidence& evidence, const Ours& ours) {
  Tally friction_N, rounding_N;
  for (const Row& row : evidence.rows) {
    friction_N.add(row.friction_N);
    rounding_N.add(row.load_kg * (row.counted.acceleration_m_per_s2 - row.late.acceleration_m_per_s2));
  }
  std::string text = fmt::format(
      "- **Friction.** Rounding to counts adds a force of {:.1f} N (rms over all rows; "
      "[counting](counting.md)) to a friction of {:.1f} N in the mean: {:.0f} % of it, before anything else.",
      rounding_N.rms(), friction_N.mean(), 100.0 * rounding_N.rms() / friction_N.mean());
  bool reached = true;
  for (std::size_t i = 0; i < thesis::directions.size(); ++i) {
    const auto& best =
        *std::min_element(ours.friction.begin(), ours.friction.end(),
                          [&](const auto& a, const auto& b) { return a.friction[i] < b.friction[i]; });
    text += fmt::format(" In {} the least spread is {} ({}).", thesis::name_of(thesis::directions[i]),
                        spread(best.friction[i]), name_of(best));
    reached = reached && best.friction[i] < thesis::printed_friction_spread;
  }
  text += fmt::format(
      " The spread is divided by the mean, which the lag takes from {:.4f} to {:.4f} in contraction "
      "([lag](lag.md)). {} The thesis does not say whether its speeds and accelerations were smoothed, or "
      "whether its samples are means.\n",
      evidence.from_gauge.friction_of(Direction::contraction).mean,
      evidence.from_current.friction_of(Direction::contraction).mean,
      reached ? "So the printed figure can be reached by processing alone."
              : "No way of processing reaches the printed figure in both directions.");
  return text;
}

double weighing_speed_mA_per_s(const plant::Rig& rig) {
  controllers::WeighingSettings weighing;
  weighing.follow(controllers::working_range(run::knowledge_of(rig, {})));
  return *weighing.speed_mA_per_s;
}

std::string why_load(const Evidence& evidence, const Ours& ours) {
  const Weighed all = measure_lag(evidence).weighed_all;
  const Errors runs = measure_counting(evidence).alone.runs;
  const double counting_kg = runs[counted].mean() - runs[truly].mean();
  return fmt::format(
      "- **Load.** While the current rises, the pressure taken from it is too high. Over the rows of the "
      "calibration that alone would make loads wrong by {:+.2f} kg, but the friction calibrated with it is "
      "wrong as well, and {:+.2f} kg are left ([lag](lag.md)). The same in the weighing, at {:g} mA/s: with "
      "the calibrated friction errors reach {}, with the friction found with the true pressure, which has no "
      "lag in it, {}. Counting shifts the mean of a whole run by {:+.2f} kg ([counting](counting.md)).\n",
      all.true_friction.mean(), all.from_current.mean(), weighing_speed_mA_per_s(evidence.campaign.rig),
      per_cent(largest_error(ours.weighed)), per_cent(largest_error(ours.without_lag)), counting_kg);
}

std::string why_pressure(const Evidence& evidence) {
  const auto& contraction = evidence.from_current.pressure_of(Direction::contraction);
  const auto& relaxation = evidence.from_current.pressure_of(Direction::relaxation);
  const bool lost = contraction.deviation.in_load > 2.0 * contraction.deviation.joint ||
                    relaxation.deviation.in_load > 2.0 * relaxation.deviation.joint;
  return fmt::format(
      "- **Pressure.** Each load and speed by itself is described to {} and {} (contraction, relaxation). {} "
      "Which of its stages the thesis's figure is for, it does not say. See "
      "[calibration](../calibration.md#pressure-against-contraction).\n",
      spread(contraction.deviation.own / contraction.mean_Pa),
      spread(relaxation.deviation.own / relaxation.mean_Pa),
      lost
          ? "The sequence of fits loses that, because factor and exponent become polynomials in load that do "
            "not know of each other; all samples at once keep it."
          : "The polynomials in load keep that.");
}

thesis::Figure figures_picture(const Ours& ours) {
  thesis::Figure figure;
  figure.title = "error of the weighed load, five contractions";
  figure.x_label = "load [kg]";
  figure.y_label = "error [%]";
  std::vector<double> load, error;
  const auto add = [&](const std::vector<Weighing>& weighings, const char* label) {
    const std::size_t begin = load.size();
    for (const Weighing& one : weighings) {
      if (!one.failure.empty()) continue;
      load.push_back(one.load_kg);
      error.push_back(100.0 * one.error());
    }
    figure.curves.push_back({label, 0, 1, true, begin, load.size()});
  };
  add(ours.weighed, "ours");
  figure.curves.push_back({"the thesis's", 0, 1, true, load.size(), load.size() + 1});
  load.push_back(printed_load_kg);
  error.push_back(100.0 * printed_error);
  add(ours.without_lag, "ours, friction from the true pressure");
  const double lightest = std::min(printed_load_kg, ours.weighed[1].load_kg);
  for (const double limit : {printed_largest_error, -printed_largest_error}) {
    figure.curves.push_back({fmt::format("the thesis's limit, {:+g} %", 100.0 * limit), 0, 1, false,
                             load.size(), load.size() + 2});
    load.insert(load.end(), {lightest, ours.weighed.back().load_kg});
    error.insert(error.end(), {100.0 * limit, 100.0 * limit});
  }
  figure.columns = {{"load_kg", std::move(load)}, {"error_per_cent", std::move(error)}};
  return figure;
}

Json json_of(const std::vector<Weighing>& weighings) {
  Json all = Json::array();
  for (const Weighing& one : weighings) {
    Json entry{{"load_kg", one.load_kg}};
    if (one.failure.empty())
      entry.update({{"weighed_kg", one.weighed_kg}, {"spread_kg", one.spread_kg}, {"error", one.error()}});
    else
      entry["failure"] = one.failure;
    all.push_back(std::move(entry));
  }
  return all;
}

Json document(const Evidence& evidence, const Ours& ours) {
  Json all{{"printed",
            {{"load_kg", printed_load_kg},
             {"weighed_kg", printed_weighed_kg},
             {"error", printed_error},
             {"largest_error_below", printed_largest_error},
             {"friction_spread_below", thesis::printed_friction_spread},
             {"pressure_spread_below", thesis::printed_pressure_spread}}}};
  all["weighed"] = json_of(ours.weighed);
  all["weighed_with_friction_from_true_pressure"] = json_of(ours.without_lag);
  for (const Spreads& spreads : ours.friction)
    all["friction_spread"].push_back({{"processing", name_of(spreads)},
                                      {"contraction", spreads.friction[0]},
                                      {"relaxation", spreads.friction[1]}});
  for (const Direction direction : thesis::directions) {
    const thesis::PressureFit& fit = evidence.from_current.pressure_of(direction);
    all["pressure_spread"][std::string(thesis::name_of(direction))] = {
        {"own", fit.deviation.own / fit.mean_Pa},
        {"sequence", fit.deviation.in_load / fit.mean_Pa},
        {"joint", fit.deviation.joint / fit.mean_Pa}};
  }
  return all;
}

}  // namespace

Weighing weigh(const Evidence& evidence, const thesis::CalibrationResult& calibration, double load_kg) {
  controllers::OpenLoopSettings settings;
  settings.model = calibration.calibration;
  settings.extrapolate_load = true;  // the thesis's 8.87 kg is lighter than all it calibrated with
  const domain::Campaign& campaign = evidence.campaign;
  const auto controller = settings.make(run::knowledge_of(campaign.rig, {}));
  const run::Recording recording = run::simulate({.rig = campaign.rig,
                                                  .load_kg = load_kg,
                                                  .ticks = 1,
                                                  .engine = campaign.rig.integrator,
                                                  .noise = campaign.noise,
                                                  .seed = campaign.seed},
                                                 *controller);
  Weighing result{.load_kg = load_kg, .failure = recording.failure};
  result.weighed_kg = controllers::value_of(recording.findings, "weighed_load");
  result.spread_kg = controllers::value_of(recording.findings, "weighed_load_spread");
  return result;
}

Study study_figures(const Evidence& evidence) {
  const Ours ours{weigh_all(evidence, evidence.from_current), weigh_all(evidence, evidence.from_gauge),
                  friction_spreads(evidence)};
  std::string page = heading(evidence, "figures", "The thesis's figures and ours");
  page +=
      "What the thesis prints about its accuracy (T 4.3, T 5) beside the same numbers of the simulated rig, "
      "calibrated as the thesis did: pressure from the current, accelerations by counts.\n\n" +
      side_by_side(evidence, ours) +
      "## Weighed loads\n\nEach by the thesis's controller, five contractions, "
      "mean and standard deviation of their means.\n\n" +
      loads(ours) + "## Spread of friction by how the data are processed\n\n" + friction(ours) +
      "## Why they differ\n\n" + why_friction(evidence, ours) + why_load(evidence, ours) +
      why_pressure(evidence);
  return {"figures", std::move(page), figures_picture(ours), document(evidence, ours)};
}

}  // namespace mckibben::study
