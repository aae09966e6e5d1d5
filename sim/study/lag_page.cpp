// The page, picture and document of the study of the lag.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <plant/friction.hpp>
#include <sim/output/calibration_report.hpp>
#include <sim/study/lag.hpp>
#include <sim/study/page.hpp>
#include <sim/study/page_json.hpp>

namespace mckibben::study {
namespace {

using input::Json;
using thesis::Direction;
using thesis::FrictionFit;

/// The rig's own T 4.6 as a plain coefficient; nothing if its friction follows another law.
std::optional<controllers::FrictionModel> true_law(const plant::Friction& friction) {
  if (friction.law != plant::FrictionLaw::superposition) return std::nullopt;
  const double factor = 0.01 * friction.scale;
  return controllers::FrictionModel{factor * friction.f0, factor * friction.f1_s2_per_mA2,
                                    factor * friction.f2, factor * friction.f3};
}

std::string coefficients(const Evidence& evidence, Direction direction) {
  const FrictionFit& current = evidence.from_current.friction_of(direction);
  const FrictionFit& gauge = evidence.from_gauge.friction_of(direction);
  const auto truth = true_law(evidence.campaign.rig.friction);
  const double fastest = evidence.from_current.grid.speeds_mA_per_s.back(), squared = fastest * fastest;
  const auto known = [&](double value) { return truth ? fmt::format("{:.3g}", value) : "another law"; };
  const controllers::FrictionModel law = truth.value_or(controllers::FrictionModel{});
  return fmt::format("In {}:\n\n", name_of(direction)) +
         table({{"", "pressure from the current", "true pressure", "truth"},
                {"f0", text_of(current.f0), text_of(gauge.f0), known(law.f0)},
                {"f1 [s2/mA2]", text_of(current.f1), text_of(gauge.f1), known(law.f1_s2_per_mA2)},
                {"f2", text_of(current.f2), text_of(gauge.f2), known(law.f2)},
                {"f3", text_of(current.f3), text_of(gauge.f3), known(law.f3)},
                {fmt::format("f1 nu2 at {:.1f} mA/s", fastest), text_of(current.f1, squared),
                 text_of(gauge.f1, squared), known(law.f1_s2_per_mA2 * squared)},
                {"mean coefficient", fmt::format("{:.4f}", current.mean), fmt::format("{:.4f}", gauge.mean),
                 ""},
                {"spread over mean", output::spread_text(current.spread(), 0, " %"),
                 output::spread_text(gauge.spread(), 0, " %"), ""}});
}

/// How much of f1 nu2 goes away with the true pressure, in words.
std::string in_disguise(const Evidence& evidence, Direction direction) {
  const double current = evidence.from_current.friction_of(direction).f1.value;
  const thesis::Estimate& gauge = evidence.from_gauge.friction_of(direction).f1;
  const double share = 1.0 - gauge.value / current;
  if (current <= 0.0)
    return fmt::format(
        "- {}: f1 is not positive with the pressure from the current; there is nothing to explain.\n",
        name_of(direction));
  const double left = gauge.standard_error / current;
  return fmt::format(
      "- {}: {:.1f} +- {:.1f} % of f1 nu2 is the lag{}.\n", name_of(direction), 100.0 * share, 100.0 * left,
      gauge.determined() ? "; what is left is not zero" : "; what is left cannot be told from zero");
}

std::string shifts(const Lag& lag, const Evidence& evidence, Direction direction) {
  const auto shown = shown_speeds(evidence.from_current.grid);
  std::vector<std::vector<std::string>> rows{{"nu [mA/s]", "shift of the pressure [bar]", "L [ms]",
                                              "f from the current", "f from the true pressure", "true f"}};
  for (const LagAtSpeed& at : lag.of(direction)) {
    if (std::find(shown.begin(), shown.end(), at.speed_mA_per_s) == shown.end()) continue;
    rows.push_back({fmt::format("{:.1f}", at.speed_mA_per_s),
                    fmt::format("{:+.3f}", 1e-5 * at.shift_Pa.mean()), fmt::format("{:.0f}", 1e3 * at.lag_s),
                    fmt::format("{:.4f}", at.from_current.mean()),
                    fmt::format("{:.4f}", at.from_gauge.mean()), fmt::format("{:.4f}", at.truly.mean())});
  }
  return fmt::format("In {}:\n\n", name_of(direction)) + table(rows);
}

std::string loads(const Lag& lag) {
  std::vector<std::vector<std::string>> rows{{"load [kg]", "pressure and friction from the current",
                                              "both with the true pressure",
                                              "pressure from the current, true friction"}};
  const auto add = [&](const std::string& name, const Weighed& weighed) {
    rows.push_back({name, bias_and_spread(weighed.from_current), bias_and_spread(weighed.from_gauge),
                    bias_and_spread(weighed.true_friction)});
  };
  for (const auto& [load_kg, weighed] : lag.weighed) add(fmt::format("{:g}", load_kg), weighed);
  add("all", lag.weighed_all);
  return table(rows);
}

/// Means in steps of e, at the slowest and the fastest current.
thesis::Figure lag_picture(const Evidence& evidence) {
  const auto& speeds = evidence.from_current.grid.speeds_mA_per_s;
  constexpr double step = 0.01;
  thesis::Figure figure;
  figure.title = "friction coefficient in contraction, by where the pressure is from";
  figure.x_label = fmt::format("contraction ratio (means over {:g})", step);
  figure.y_label = "friction coefficient";
  figure.columns = {{"current_speed_mA_per_s", {}},
                    {"contraction_ratio", {}},
                    {"from_current", {}},
                    {"from_true_pressure", {}},
                    {"true_coefficient", {}}};
  for (const double speed : {speeds.front(), speeds.back()}) {
    std::map<int, std::array<Tally, 3>> bins;
    for (const Row& row : evidence.rows) {
      if (row.direction != Direction::contraction || row.speed_mA_per_s != speed) continue;
      const double weight_N = row.load_kg * (row.counted.acceleration_m_per_s2 + plant::gravity_m_per_s2);
      auto& bin = bins[static_cast<int>(std::floor(row.contraction_ratio / step))];
      bin[0].add((row.generated_N_per_Pa - weight_N / row.line_Pa) / row.surface_m2);
      bin[1].add((row.generated_N_per_Pa - weight_N / row.muscle_Pa) / row.surface_m2);
      bin[2].add(row.friction_N / (row.surface_m2 * row.muscle_Pa));
    }
    const std::size_t begin = figure.columns.front().values.size();
    for (const auto& [place, bin] : bins) {
      if (bin[0].count() < 20) continue;  // too few for a mean against the counter's noise
      figure.columns[0].values.push_back(speed);
      figure.columns[1].values.push_back((place + 0.5) * step);
      for (std::size_t i = 0; i < bin.size(); ++i) figure.columns[2 + i].values.push_back(bin[i].mean());
    }
    const std::size_t end = figure.columns.front().values.size();
    const std::string at = fmt::format(", {:.1f} mA/s", speed);
    figure.curves.push_back({"from current" + at, 1, 2, true, begin, end});
    figure.curves.push_back({"true pressure" + at, 1, 3, true, begin, end});
    figure.curves.push_back({"truth" + at, 1, 4, false, begin, end});
  }
  return figure;
}

Json json_of(const thesis::Estimate& estimate) {
  return {{"value", estimate.value},
          {"standard_error", estimate.standard_error},
          {"not_determined", estimate.why_not}};
}

Json json_of(const FrictionFit& fit) {
  return {{"f0", json_of(fit.f0)}, {"f1_s2_per_mA2", json_of(fit.f1)},
          {"f2", json_of(fit.f2)}, {"f3", json_of(fit.f3)},
          {"mean", fit.mean},      {"spread", fit.spread()}};
}

Json numbers_of(const Lag& lag, const Evidence& evidence) {
  Json all;
  for (const Direction direction : thesis::directions) {
    Json& here = all[std::string(name_of(direction))];
    here["pressure_from_current"] = json_of(evidence.from_current.friction_of(direction));
    here["true_pressure"] = json_of(evidence.from_gauge.friction_of(direction));
    for (const LagAtSpeed& at : lag.of(direction))
      here["speeds"].push_back({{"current_speed_mA_per_s", at.speed_mA_per_s},
                                {"pressure_shift_Pa", json_of(at.shift_Pa)},
                                {"lag_s", at.lag_s},
                                {"coefficient_from_current", json_of(at.from_current)},
                                {"coefficient_from_true_pressure", json_of(at.from_gauge)},
                                {"true_coefficient", json_of(at.truly)}});
  }
  for (const auto& [load_kg, weighed] : lag.weighed)
    all["load_error_kg"].push_back({{"load_kg", load_kg},
                                    {"from_current", json_of(weighed.from_current)},
                                    {"from_true_pressure", json_of(weighed.from_gauge)},
                                    {"from_current_true_friction", json_of(weighed.true_friction)}});
  return all;
}

}  // namespace

Study study_lag(const Evidence& evidence) {
  const Lag lag = measure_lag(evidence);
  std::string page = heading(evidence, "lag", "Friction or lag?");
  page +=
      "The thesis has no gauge: it takes the pressure from the current, as if it followed at once (T 3.3). "
      "Here the same rows are processed twice, with that pressure and with the muscle's own, and both are "
      "compared with the friction that the simulated threads really had.\n\n";
  page +=
      "## The friction law (T 4.6)\n\nStandard errors behind +-. They take residuals as independent, which "
      "they are not: read them as lower bounds.\n\n";
  for (const Direction direction : thesis::directions) page += coefficients(evidence, direction);
  page += "How much of f1 nu2 is the lag of valve and hose in disguise:\n\n";
  for (const Direction direction : thesis::directions) page += in_disguise(evidence, direction);
  page +=
      "\n## The lag itself\n\nIn a ramp the muscle's pressure stays s nu L behind the one taken from the "
      "current, with s the slope of the valve's line. L is fitted to the used rows (through zero), each with "
      "its own di/dt in the place of nu; the shift is their mean, line less muscle. f are means over the "
      "same rows. The printed shift is not s nu L of the printed nu and L: nu is a mean over whole half "
      "periods, and on a sine di/dt in the used rows is not that mean.\n\n";
  for (const Direction direction : thesis::directions) page += shifts(lag, evidence, direction);
  page +=
      "## The load weighed with it (T 4.31)\n\nError in kg over the rows of contraction, mean +- standard "
      "deviation of single rows (much of that is the [counter](counting.md)).\n\n" +
      loads(lag);
  const Weighed& all = lag.weighed_all;
  const double lightest = lag.weighed.begin()->second.from_current.mean();
  const double heaviest = lag.weighed.rbegin()->second.from_current.mean();
  const bool cancels = std::abs(all.from_current.mean()) < 0.5 * std::abs(all.true_friction.mean());
  page += fmt::format(
      "Whoever knew the true friction but took the pressure from the current would be wrong by {:+.2f} kg. "
      "With friction that was calibrated in the same way that error {} in the mean of all loads: {:+.2f} kg. "
      "It is {:+.2f} kg for the lightest load and {:+.2f} kg for the heaviest{}.\n",
      all.true_friction.mean(), cancels ? "mostly cancels" : "does not cancel", all.from_current.mean(),
      lightest, heaviest,
      lightest * heaviest < 0.0 ? ": one coefficient for all loads (T 4.6) cannot take the lag out of each"
                                : "");
  return {"lag", std::move(page), lag_picture(evidence),
          document_of(evidence, "lag", numbers_of(lag, evidence))};
}

}  // namespace mckibben::study
