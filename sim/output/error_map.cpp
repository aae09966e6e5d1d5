// Layout of the maps' files; see the header.
#include <algorithm>

#include <fmt/format.h>

#include <sim/input/rigs.hpp>
#include <sim/output/error_map.hpp>
#include <sim/output/grid.hpp>
#include <sim/output/json_parts.hpp>

namespace mckibben::output {
namespace {

using controllers::Branch;
using input::Json;
using run::covers;

const char* name_of(Branch branch) {
  return branch == Branch::contraction ? "up" : "down";
}

/// What a branch comes to.
struct Summary {
  explicit Summary(const run::BranchMap& map)
      : within(error_over(map, [](const auto& cell) { return cell.reachable; })),
        beyond(error_over(map, [](const auto& cell) { return !cell.reachable; })),
        as_asked(error_over(map, [](const auto& cell) { return cell.reachable && cell.as_asked(); })) {
    const auto count = [&](const auto& is_one) {
      return static_cast<std::size_t>(std::count_if(map.cells.begin(), map.cells.end(), is_one));
    };
    reachable = count([](const auto& cell) { return cell.reachable; });
    not_run = count([](const auto& cell) { return !cell.arrival; });
  }

  run::MapError within, beyond, as_asked;
  std::size_t reachable = 0, not_run = 0;
};

std::vector<std::string> errors(const run::MapError& error) {
  if (error.cells == 0) return {"-", "-"};
  return {fmt::format("{:.4f}", error.ratio), fmt::format("{:.3f}", error.speed_per_s)};
}

Json error_json(const run::MapError& error) {
  if (error.cells == 0) return {{"targets", 0}};
  return {{"targets", error.cells}, {"ratio_rms", error.ratio}, {"speed_rms_per_s", error.speed_per_s}};
}

Json branch_json(const run::ErrorMaps& maps, const run::MapPlan& plan, const run::LoadMap& load,
                 const run::BranchMap& map) {
  const Summary summary(map);
  const auto& fastest =
      map.branch == Branch::contraction ? load.limits.rising_per_s : load.limits.falling_per_s;
  Json border = Json::array();
  for (const double ratio : plan.ratios) border.push_back(maps.reach.at_ratio(fastest, ratio));
  return {{"branch", name_of(map.branch)},
          {"targets", map.cells.size()},
          {"reachable", summary.reachable},
          {"not_run", summary.not_run},
          {"within_reach", error_json(summary.within)},
          {"beyond_reach", error_json(summary.beyond)},
          {"within_reach_and_answered_as_asked", error_json(summary.as_asked)},
          {"fastest_per_s", std::move(border)}};
}

}  // namespace

std::string csv_of(const run::ErrorMaps& maps) {
  std::string text =
      "load_kg,weighed_load_kg,load_extrapolated,branch,target_ratio,target_speed_per_s,reached_ratio,"
      "reached_speed_per_s,"
      "ratio_error,speed_error_per_s,reachable,ratio_outside_calibration,current_speed_outside_calibration,"
      "no_current_speed,off_the_valves_line\n";
  for (const auto& load : maps.loads)
    for (const auto& map : load.branches)
      for (const auto& cell : map.cells) {
        text += fmt::format("{},{},{:d},{},{},{},", load.load_kg, load.weighed_kg, load.extrapolated,
                            name_of(map.branch), cell.ratio, cell.speed_per_s);
        text += cell.arrival ? fmt::format("{},{},{},{}", cell.arrival->ratio, cell.arrival->speed_per_s,
                                           cell.ratio_error(), cell.speed_error_per_s())
                             : ",,,";
        text += fmt::format(",{:d},{:d},{:d},{:d},{:d}\n", cell.reachable, cell.asked.ratio_outside,
                            cell.asked.speed_outside, cell.asked.unreachable, cell.off_the_line);
      }
  return text;
}

std::string table_of(const run::MapPlan& plan, const run::ErrorMaps& maps) {
  std::string text = fmt::format(
      "error maps of open_loop (T 4.3): {} contraction ratios from {:.3g} to {:.3g} x {} speeds from {:.3g} "
      "to {:.3g} /s\n"
      "rms errors of contraction ratio (0.001 = {:.2g} mm) and speed [1/s], at the time of arrival\n\n",
      plan.ratios.size(), plan.ratios.front(), plan.ratios.back(), plan.speeds_per_s.size(),
      plan.speeds_per_s.front(), plan.speeds_per_s.back(), plan.rig.muscle.rest_length_m);
  Grid grid({"branch", "load_kg", "weighed_kg", "error_%", "reachable_%", "ratio", "speed", "beyond: ratio",
             "speed", "asked_%", "ratio", "speed"},
            1);
  std::string notes;
  for (const auto& load : maps.loads) {
    if (!load.failure.empty()) notes += fmt::format("  {:g} kg: no map: {}\n", load.load_kg, load.failure);
    const auto& range = plan.calibration.range;
    if (load.extrapolated)
      notes += fmt::format("  {:g} kg: extrapolated; calibrated are {:g} to {:g} kg\n", load.load_kg,
                           range.lowest_load_kg, range.highest_load_kg);
    else if (load.failure.empty() && !covers(range, load.weighed_kg))
      notes += fmt::format("  {:g} kg: weighed within 10 % of the calibrated loads, taken as {:g} kg\n",
                           load.load_kg, load.believed_kg);
    for (const auto& map : load.branches) {
      const Summary summary(map);
      const auto per_cent = [&](std::size_t part) {
        return fmt::format("{:.0f}",
                           100.0 * static_cast<double>(part) / static_cast<double>(map.cells.size()));
      };
      std::vector<std::string> row{
          name_of(map.branch), fmt::format("{:g}", load.load_kg), fmt::format("{:.3f}", load.weighed_kg),
          fmt::format("{:+.1f}", 100.0 * load.weighing_error()), per_cent(summary.reachable)};
      for (const auto& error : {summary.within, summary.beyond})
        for (auto& number : errors(error)) row.push_back(std::move(number));
      row.push_back(per_cent(summary.as_asked.cells));
      for (auto& number : errors(summary.as_asked)) row.push_back(std::move(number));
      grid.add(std::move(row));
      if (summary.not_run > 0)
        notes += fmt::format("  {:g} kg {}: {} of {} targets have no run\n", load.load_kg,
                             name_of(map.branch), summary.not_run, map.cells.size());
    }
  }
  if (!grid.empty()) text += grid.text();
  text +=
      "\nreachable: what the rig can pass at that speed; beyond: the other targets. asked: those reachable "
      "that the inverse\nanswers as asked, inside its calibrated contraction ratios and current speeds and "
      "on the valve's line.\n";
  return notes.empty() ? text : text + "\n" + notes;
}

std::string json_of(const run::MapPlan& plan, const run::ErrorMaps& maps,
                    const std::vector<domain::InputFile>& files) {
  Json document = heading_json("mckibben-map/1", files);
  document["report"] = "report.html";
  document["tolerance"] = plan.rig.integrator.tolerance;
  document["rig"] = input::rig_json(plan.rig);
  document["extrapolate_load"] = plan.extrapolate_load;
  document["extrapolate_target"] = plan.extrapolate_target;
  document["calibrated"] = input::to_json(plan.calibration.range, {plan.rig.command_unit()});
  document["target_ratios"] = plan.ratios;
  document["target_speeds_per_s"] = plan.speeds_per_s;
  document["loads"] = Json::array();
  for (const auto& load : maps.loads) {
    Json entry{{"load_kg", load.load_kg}, {"extrapolated", load.extrapolated}};
    if (!load.failure.empty()) {
      entry["failure"] = load.failure;
    } else {
      entry["weighed_load_kg"] = load.weighed_kg;
      entry["weighed_load_spread_kg"] = load.spread_kg;
      entry["believed_load_kg"] = load.believed_kg;
      entry["weighing_error"] = load.weighing_error();
    }
    entry["lowest_ratio_rising"] = load.limits.lowest_rising;
    entry["lowest_ratio_falling"] = load.limits.lowest_falling;
    entry["highest_ratio"] = load.limits.highest;
    entry["branches"] = Json::array();
    for (const auto& map : load.branches) entry["branches"].push_back(branch_json(maps, plan, load, map));
    document["loads"].push_back(std::move(entry));
  }
  if (maps.interrupted) document["interrupted"] = true;
  return text_of(document);
}

}  // namespace mckibben::output
