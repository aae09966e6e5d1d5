// See the header.
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include <sim/diagnose/run_gaps.hpp>

namespace mckibben::diagnose {

std::vector<RunGap> gaps_of_runs(const Experiment& experiment, const Runs& held_out, const Runs& usable,
                                 const ThreeRigs& rigs) {
  const auto& runs = experiment.data().runs;
  std::vector<RunGap> gaps(runs.size());
  for (std::size_t run = 0; run < runs.size(); ++run) {
    RunGap& gap = gaps[run];
    gap.id = runs[run].id;
    gap.load_kg = runs[run].load_kg;
    gap.held_out = std::binary_search(held_out.begin(), held_out.end(), run);
    gap.left_out = !std::binary_search(usable.begin(), usable.end(), run);
    gap.measured = runs[run].contraction_ratio;
    for (double& ratio : gap.measured) ratio += 0.5 * experiment.floor().count;
    const auto tell = [&](const plant::Rig& rig, double& rmse, std::vector<double>& readings) {
      auto simulated = experiment.readings(rig, run);
      rmse = experiment.rmse(experiment.residuals(simulated, run), {run});
      readings = std::move(simulated.contraction_ratio);
    };
    tell(rigs.nominal, gap.nominal_rmse, gap.nominal);
    tell(rigs.recalibrated, gap.recalibrated_rmse, gap.recalibrated);
    tell(rigs.corrected, gap.corrected_rmse, gap.corrected);
  }
  return gaps;
}

std::string visited(const domain::Dataset& data, const Runs& runs) {
  struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void see(double value) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  } current_mA, load_kg, ratio;
  for (const std::size_t run : runs) {
    for (const double value : data.runs[run].current_mA) current_mA.see(value);
    for (const double value : data.runs[run].contraction_ratio) ratio.see(value);
    load_kg.see(data.runs[run].load_kg);
  }
  if (data.pressure_is_given())
    return fmt::format(
        "loads of {:.4g} to {:.4g} kg and contraction ratios of {:.3f} to {:.3f}, as in these runs",
        load_kg.low, load_kg.high, ratio.low, ratio.high);
  return fmt::format(
      "currents of {:.3g} to {:.3g} mA, loads of {:.4g} to {:.4g} kg and contraction ratios of {:.3f} to "
      "{:.3f}, as in these runs",
      current_mA.low, current_mA.high, load_kg.low, load_kg.high, ratio.low, ratio.high);
}

}  // namespace mckibben::diagnose
