// See the header.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <sim/diagnose/remaining.hpp>
#include <sim/diagnose/where.hpp>
#include <sim/domain/number.hpp>

namespace mckibben::diagnose {

std::vector<Dense> densest(std::span<const Cell> map) {
  const WhereThresholds& least = thresholds.where;
  std::map<std::string, std::size_t> rows;
  for (const Cell& cell : map) rows[cell.factor] += cell.rows;
  std::map<std::string, Dense> best;
  for (const Cell& cell : map) {
    if (!cell.significant || cell.rows == 0 || cell.share_of_gap < least.dense_share) continue;
    const Dense found{cell, static_cast<double>(cell.rows) / static_cast<double>(rows.at(cell.factor))};
    if (found.density() <= least.density) continue;
    const auto [place, first] = best.emplace(cell.factor, found);
    if (!first && found.density() > place->second.density()) place->second = found;
  }
  std::vector<Dense> all;
  all.reserve(best.size());
  for (auto& [factor, found] : best) all.push_back(std::move(found));
  std::stable_sort(all.begin(), all.end(),
                   [](const Dense& a, const Dense& b) { return a.density() > b.density(); });
  return all;
}

Remaining remaining(const Experiment& experiment, const Rig& corrected, const Runs& runs, const Gap& gap,
                    std::uint64_t seed) {
  Remaining left{.floors = gap.floors_left(), .share = 1.0 - gap.closed};
  if (left.is_more_than_noise()) left.pattern = densest(where(experiment, corrected, runs, seed));
  return left;
}

std::string sentence_of(const Remaining& remaining) {
  if (!remaining.is_more_than_noise()) return "";
  std::string text =
      fmt::format(" {:g} times the noise floor remains", domain::significant(remaining.floors, 2));
  if (remaining.pattern.empty()) return text + ", in no part of the data more than in others.";
  const Dense& most = remaining.pattern.front();
  return text + fmt::format(", {:.0f} % of it in {:.0f} % of the readings: {} {}.",
                            100.0 * most.cell.share_of_gap, 100.0 * most.share_of_time, most.cell.factor,
                            most.cell.cell);
}

}  // namespace mckibben::diagnose
