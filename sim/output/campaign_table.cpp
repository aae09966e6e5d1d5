// The table of a campaign: what its runs were, load by load or current by current.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include <sim/output/grid.hpp>
#include <sim/output/run_results.hpp>

namespace mckibben::output {
namespace {

/// What runs of a campaign that belong together come to.
struct Together {
  std::size_t runs = 0, rows = 0;
  double largest_contraction_ratio = 0.0;
  std::optional<run::Span> angle_rad{};
  long steps = 0, right_hand_sides = 0;

  void add(const run::EndedRun& run) {
    ++runs;
    rows += run.rows;
    largest_contraction_ratio = std::max(largest_contraction_ratio, run.largest_contraction_ratio);
    const run::Span before = angle_rad.value_or(run.angle_rad);
    angle_rad = {std::min(before.low, run.angle_rad.low), std::max(before.high, run.angle_rad.high)};
    steps += run.solver.steps;
    right_hand_sides += run.solver.right_hand_sides;
  }
};

/// Of a pair, current by current.
std::string table_of_pair(const domain::Campaign& campaign, const std::vector<Together>& currents) {
  Grid grid(
      {"current", "runs", "rows", "simulated_s", "angle_deg lowest", "highest", "steps", "right_hand_sides"},
      1);
  for (std::size_t i = 0; i < currents.size(); ++i) {
    const Together& all = currents[i];
    const auto degrees = [&](double run::Span::*end) {
      return all.angle_rad ? fmt::format("{:+.2f}", (*all.angle_rad).*end / plant::degree_rad) : "-";
    };
    grid.add({campaign.currents[i].name, std::to_string(all.runs), std::to_string(all.rows),
              fmt::format("{:.1f}", static_cast<double>(all.rows) * campaign.rig.tick_s),
              degrees(&run::Span::low), degrees(&run::Span::high), std::to_string(all.steps),
              std::to_string(all.right_hand_sides)});
  }
  return grid.text();
}

/// Of one muscle, load by load.
std::string table_of_loads(const domain::Campaign& campaign, const std::vector<Together>& loads) {
  const bool angle = campaign.rig.has_angle();
  Grid grid({"load_kg", "runs", "rows", "simulated_s", angle ? "angle_deg highest" : "largest_contraction",
             "steps", "right_hand_sides"},
            0);
  std::string notes;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const Together& all = loads[i];
    const std::string load = fmt::format("{:g}", campaign.loads_kg[i]);
    grid.add({load, std::to_string(all.runs), std::to_string(all.rows),
              fmt::format("{:.1f}", static_cast<double>(all.rows) * campaign.rig.tick_s),
              angle ? fmt::format("{:+.2f}", all.angle_rad.value_or(run::Span{}).high / plant::degree_rad)
                    : fmt::format("{:.4f}", all.largest_contraction_ratio),
              std::to_string(all.steps), std::to_string(all.right_hand_sides)});
    notes += contraction_note(campaign.rig, all.largest_contraction_ratio, load + " kg");
  }
  return grid.text() + section("contraction, as counted", notes);
}

}  // namespace

std::string table_of(const domain::Campaign& campaign, const std::vector<run::EndedRun>& ended) {
  const bool pair = campaign.rig.pair() != nullptr;
  std::vector<Together> parts(pair ? campaign.currents.size() : campaign.loads_kg.size());
  std::string failures, warnings;
  std::size_t rows = 0;
  for (const run::EndedRun& run : ended) {
    if (!run.failure.empty()) {
      failures += fmt::format("  {}: {}\n", run.job.id, run.failure);
      continue;
    }
    rows += run.rows;
    const auto& loads = campaign.loads_kg;
    parts[pair ? run.job.current
               : static_cast<std::size_t>(std::find(loads.begin(), loads.end(), run.job.load_kg) -
                                          loads.begin())]
        .add(run);
  }
  for (const auto& text : run::warnings_of(ended)) warnings += fmt::format("  {}\n", text);
  return fmt::format(
             "{}: {} x {} current{} x {}, {} rows, {:.1f} s simulated\n\n", campaign.name,
             pair ? "two muscles" : fmt::format("{} load{}", parts.size(), parts.size() == 1 ? "" : "s"),
             campaign.currents.size(), campaign.currents.size() == 1 ? "" : "s", campaign.repeats, rows,
             static_cast<double>(rows) * campaign.rig.tick_s) +
         (pair ? table_of_pair(campaign, parts) : table_of_loads(campaign, parts)) +
         section("failed", failures) + section("warnings", warnings);
}

}  // namespace mckibben::output
