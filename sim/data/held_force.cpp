// The force of a muscle that is held goes with the pressure it is given, as steeply as its braid says
// (T 2.8).
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/data/gains.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>

namespace mckibben::data {
namespace {

/// How many times as steeply as the braid's the force of a run follows its pressure; 0 if it does not.
double steepness(const domain::Run& run, const plant::Braid& braid) {
  const domain::Measurement& measured = *run.measured;
  const auto &ratio = measured.given("contraction"), &pressure_Pa = measured.given("muscle_pressure");
  const domain::Reading& force = run.judged();
  std::vector<double> read_N, braid_N;
  for (std::size_t k = 0; k < force.values.size(); ++k) {
    const std::size_t stamp = measured.rows.empty() ? k : measured.rows[k];
    if (force.is_missing(k) || !braid.in_domain(ratio[stamp])) continue;
    read_N.push_back(force.values[k]);
    braid_N.push_back(braid.force_N(ratio[stamp], pressure_Pa[stamp]));
  }
  if (read_N.size() < 2) return 0.0;
  const Line line(read_N, braid_N);
  return line.correlation > thresholds.column.alike ? line.slope : 0.0;
}

}  // namespace

std::vector<Finding> pressures_of_a_held_muscle(const domain::Dataset& data) {
  std::vector<Finding> findings;
  if (data.judged() != domain::Judged::force) return findings;
  const plant::Braid braid(data.rig.muscle);
  const std::vector<Unit> units = units_of_pressure();
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const domain::Run& run = data.runs[i];
    if (!run.measured->gives_length() || !run.measured->gives("muscle_pressure")) continue;
    domain::ColumnPlace place = domain::merged(data.columns, run.columns)["muscle_pressure"];
    const Unit* const said = find_unit(units, place.unit);
    const double steep = steepness(run, braid);
    if (said == nullptr || !(steep > 1.0)) continue;  // too large a pressure is beyond the supply, too
    const auto off = [&](const Unit& unit) { return std::abs(std::log(steep * said->size / unit.size)); };
    const Unit& nearest = *std::ranges::min_element(units, {}, off);
    if (&nearest == said || off(nearest) > std::log(thresholds.column.held_steepness)) continue;
    place.unit = nearest.name;
    add(findings, "muscle_pressure", {i}, fmt::format("force follows muscle_pressure {:.3g} times", steep),
        fmt::format(
            " as steeply as this braid would: the pressure looks like {}, not {}; write columns: {{{}}}",
            nearest.name, said->name, line_in_unit("muscle_pressure", place)));
  }
  return findings;
}

}  // namespace mckibben::data
