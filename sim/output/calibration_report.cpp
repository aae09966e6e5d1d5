// Layout of the printed report.
#include <cmath>

#include <fmt/format.h>

#include <sim/output/calibration_report.hpp>
#include <sim/output/grid.hpp>
#include <sim/thesis/quality.hpp>

namespace mckibben::output {
namespace {

using thesis::Direction;

std::string number_of(const thesis::Estimate& estimate, double factor) {
  if (estimate.determined())
    return fmt::format("{:.5g} +- {:.1g}", factor * estimate.value, factor * estimate.standard_error);
  const double bound = factor * (std::abs(estimate.value) + 2.0 * estimate.standard_error);
  const bool bounded = estimate.why_not == "not significant";
  return "not determined: " + estimate.why_not + (bounded ? fmt::format(", below {:.2g}", bound) : "");
}

bool usable(double spread) {
  return spread >= 0.0 && spread <= thesis::largest_usable_spread;
}

std::string heading(const domain::Dataset& dataset, const thesis::CalibrationResult& result,
                    const thesis::Options& options) {
  const auto& grid = result.grid;
  std::string text = fmt::format(
      "{} of {} runs used; {} loads from {:g} to {:g} kg, {} current speeds from {:.3g} to {:.3g} mA/s\n",
      dataset.runs.size() - grid.left_out.size(), dataset.runs.size(), grid.loads_kg.size(),
      grid.loads_kg.front(), grid.loads_kg.back(), grid.speeds_mA_per_s.size(), grid.speeds_mA_per_s.front(),
      grid.speeds_mA_per_s.back());
  text += fmt::format(
      "pressure from the {}, acceleration {}, contact surface {}\n",
      options.processing.pressure == thesis::PressureSource::current ? "current by the valve's line (T 3.3)"
                                                                     : "gauge",
      options.processing.acceleration == thesis::Acceleration::counted ? "by differences of counts (T 3.3)"
                                                                       : "neglected (T 4.3)",
      dataset.rig.muscle.contact_surface == plant::ContactSurface::squared ? "with the cosine squared"
                                                                           : "as printed (T 4.3)");
  return dataset.path.string() + ": " + in_unit(result.command_unit(), text);
}

std::string rows_text(const thesis::Grid& grid) {
  std::size_t used[2] = {0, 0};
  for (const Direction direction : thesis::directions)
    for (const auto& cell : grid.of(direction))
      used[static_cast<std::size_t>(direction)] += cell.samples.size();
  return fmt::format(
      "\nrows\n  used: {} in contraction, {} in relaxation\n  dropped: {} with a current off the valve's "
      "line, {} too near e = 0 for ln e,\n           {} where the muscle is still or does not follow the "
      "current, {} before the current moves,\n           {} with a contraction ratio above e_max (T 2.10)\n",
      used[0], used[1], grid.dropped.off_the_line, grid.dropped.near_zero, grid.dropped.not_following,
      grid.dropped.first_rows, grid.dropped.beyond_limit);
}

std::string spreads(const thesis::CalibrationResult& result) {
  Grid grid({"", "contraction", "relaxation"}, 1);
  const auto& fc = result.friction_of(Direction::contraction);
  const auto& fr = result.friction_of(Direction::relaxation);
  const auto& pc = result.pressure_of(Direction::contraction);
  const auto& pr = result.pressure_of(Direction::relaxation);
  grid.add({"friction coefficient, mean", fmt::format("{:.5f}", fc.mean), fmt::format("{:.5f}", fr.mean)});
  grid.add({"  superposition (T 4.6), spread %", spread_text(fc.spread(), 1), spread_text(fr.spread(), 1)});
  grid.add({"pressure, mean [bar]", fmt::format("{:.3f}", pc.mean_Pa * 1e-5),
            fmt::format("{:.3f}", pr.mean_Pa * 1e-5)});
  const std::pair<const char*, double thesis::Stages::*> stages[] = {
      {"  each load and speed by itself (T 4.7), spread %", &thesis::Stages::own},
      {"  all steady coefficients averaged at once", &thesis::Stages::fixed_at_once},
      {"  exponent averaged first, then the others", &thesis::Stages::fixed},
      {"  polynomials in speed (T 4.8 to 4.13)", &thesis::Stages::in_speed},
      {"  polynomials in load of those (T 4.14 to 4.28)", &thesis::Stages::in_load},
      {"  the same equations, all samples at once", &thesis::Stages::joint}};
  for (const auto& [name, stage] : stages)
    grid.add({name, spread_text(pc.deviation.*stage / pc.mean_Pa, 2),
              spread_text(pr.deviation.*stage / pr.mean_Pa, 2)});
  return "\nspread (standard deviation over mean)\n" + grid.text();
}

std::string friction(const thesis::CalibrationResult& result) {
  std::string text = "\nfriction coefficient f0 + f1 nu2 + f2 e + f3 ln e (T 4.6), nu in mA/s\n";
  for (const Direction direction : thesis::directions) {
    const auto& fit = result.friction_of(direction);
    text += fmt::format("  {}\n    f0  {}\n    f1  {}\n    f2  {}\n    f3  {}\n", name_of(direction),
                        number_of(fit.f0, 1.0), number_of(fit.f1, 1.0), number_of(fit.f2, 1.0),
                        number_of(fit.f3, 1.0));
  }
  return text;
}

std::string pressure(const thesis::CalibrationResult& result, const thesis::Options& options, bool kgf) {
  const bool joint = options.fitting == thesis::PressureFitting::joint;
  std::string text =
      fmt::format("\npressure coefficients [{}], highest power of the load first: {}\n",
                  kgf ? "kgf/m2" : "Pa", joint ? "all samples at once" : "the thesis's sequence of fits");
  for (const Direction direction : thesis::directions) {
    const auto& fit = result.pressure_of(direction);
    text += fmt::format("  {}\n", name_of(direction));
    for (std::size_t curve = 0; curve < fit.shape.curves.size(); ++curve) {
      const auto& law = fit.shape.curves[curve];
      const double factor = kgf && law.part != thesis::exponent ? 1.0 / thesis::kgf_per_m2_Pa : 1.0;
      for (int i = 0; i <= law.load_order; ++i) {
        const auto estimate =
            joint ? fit.joint_estimates[curve][static_cast<std::size_t>(i)] : fit.in_load[curve].estimate(i);
        text += fmt::format("    {:<5} m^{}  {}\n", i == 0 ? law.name : "", law.load_order - i,
                            number_of(estimate, factor));
      }
    }
  }
  return text;
}

}  // namespace

std::string spread_text(double spread, int decimals, const char* unit) {
  return usable(spread) ? fmt::format("{:.{}f}{}", 100.0 * spread, decimals, unit)
                        : "not usable (above 100 %)";
}

std::vector<std::string> meanings_of(const thesis::CalibrationResult& result,
                                     const thesis::Options& options) {
  std::vector<std::string> lines;
  for (const auto& model : thesis::quality_of(result, options))
    lines.push_back(
        fmt::format("{}: {}: {}", model.name(), spread_text(model.spread, 1, " %"), model.meaning()));
  return lines;
}

std::vector<std::string> warnings_of(const thesis::CalibrationResult& result,
                                     const thesis::Options& options) {
  using thesis::Quality;
  std::vector<std::string> warnings;
  for (const Quality& quality : thesis::quality_of(result, options)) {
    if (quality.grade() != Quality::Grade::not_usable) continue;
    const std::string pressure_help = options.fitting == thesis::PressureFitting::joint
                                          ? "more loads or lower orders may help"
                                          : "fit all samples at once (--fit joint)";
    warnings.push_back(
        quality.name() +
        (quality.model == Quality::Model::friction
             ? " is not usable: samples scatter round the fitted coefficient (T 4.6) by more than its mean, "
               "and so will what is weighed with it; larger currents, more periods, smaller noise or "
               "pressure from a gauge may help"
             : " is not usable: samples scatter round the fitted pressure by more than its mean; " +
                   pressure_help));
  }
  return warnings;
}

std::string report_of(const domain::Dataset& dataset, const thesis::CalibrationResult& result,
                      const thesis::Options& options, bool kgf) {
  std::string text = heading(dataset, result, options) + spreads(result) + "\nwhat the spreads mean\n";
  for (const auto& line : meanings_of(result, options)) text += "  " + line + "\n";
  text += in_unit(result.command_unit(), friction(result)) + pressure(result, options, kgf) +
          in_unit(result.command_unit(), rows_text(result.grid));
  if (!result.grid.left_out.empty()) text += "\nruns left out\n";
  for (const auto& run : result.grid.left_out) text += fmt::format("  {}: {}\n", run.id, run.why);
  const auto warnings = warnings_of(result, options);
  if (!warnings.empty()) text += "\nwarnings\n";
  for (const auto& warning : warnings) text += "  " + warning + "\n";
  return text;
}

}  // namespace mckibben::output
