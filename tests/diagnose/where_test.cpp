// The map of disagreement: it sees what differs between cells, and nothing where nothing differs.
#include <algorithm>
#include <map>
#include <stdexcept>

#include <gtest/gtest.h>

#include <sim/diagnose/where.hpp>
#include <sim/run/simulate.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {
namespace {

/// A map of planted data against the nominal rig.
struct Mapped {
  domain::Dataset data;
  std::vector<std::vector<bool>> masked{};
  unsigned threads = 2;

  std::vector<Cell> operator()() {
    Runs runs;
    for (const domain::Run& run : data.runs) {
      if (masked.size() <= runs.size()) masked.emplace_back(run.current_mA.size(), false);
      runs.push_back(runs.size());
    }
    return where(Experiment(data, masked, threads), data.rig, runs, 7);
  }
};

const Cell& find(const std::vector<Cell>& cells, std::string_view factor, std::string_view name) {
  for (const Cell& cell : cells)
    if (cell.factor == factor && cell.cell == name) return cell;
  throw std::out_of_range(std::string(factor) + ": " + std::string(name));
}

std::size_t significant(const std::vector<Cell>& cells) {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [](const Cell& cell) { return cell.significant; }));
}

std::map<std::string, std::size_t> rows_by_factor(const std::vector<Cell>& cells) {
  std::map<std::string, std::size_t> rows;
  for (const Cell& cell : cells) rows[cell.factor] += cell.rows;
  return rows;
}

TEST(Where, FrictionShowsInTheDirection) {
  plant::Rig truth;
  truth.effects.get<plant::GuideFriction>().coefficient = 0.06;
  const auto cells = Mapped{planted(truth, {11.138, 23.406}, three_kinds(), 1)}();
  const Cell &up = find(cells, "direction", "contracting"), &down = find(cells, "direction", "relaxing");
  EXPECT_TRUE(up.significant);
  EXPECT_TRUE(down.significant);
  EXPECT_LT(up.mean, -5e-4);  // the load hangs back
  EXPECT_GT(down.mean, 5e-4);
  std::map<std::string, double> shares;
  for (const Cell& cell : cells) shares[cell.factor] += cell.share_of_gap;
  EXPECT_EQ(shares.size(), 9u);
  for (const auto& [factor, share] : shares) EXPECT_NEAR(share, 1.0, 1e-12) << factor;
}

TEST(Where, NothingStandsOutWhereNothingIsMissing) {
  const auto cells = Mapped{planted({}, {11.138, 23.406}, three_kinds(), 2)}();
  EXPECT_EQ(significant(cells), 0u);
}

TEST(Where, WhatIsCommonToAllCellsIsNoMatterOfTheFactor) {
  auto data = planted({}, {16.138}, three_kinds(), 3);
  for (domain::Run& run : data.runs)
    for (double& ratio : run.judged().values) ratio += 10.0 * run::contraction_per_count(data.rig);
  const auto cells = Mapped{std::move(data)}();
  EXPECT_EQ(significant(cells), 1u);
  EXPECT_TRUE(find(cells, "load", "16.138 kg").significant);  // one cell: its mean itself is tested
}

TEST(Where, SaysWhatWasNeverVisited) {
  controllers::SineCurrent gentle;
  gentle.high_mA = 9.0;
  gentle.period_s = 3.0;
  const auto cells = Mapped{planted({}, {16.138}, {{"gentle", 6.0, gentle}}, 4)}();
  const Cell& high = find(cells, "pressure", "above 4.1 bar");
  EXPECT_EQ(high.rows, 0u);
  EXPECT_FALSE(high.significant);
  EXPECT_EQ(high.share_of_gap, 0.0);
  EXPECT_GT(find(cells, "pressure", "below 1.4 bar").rows, 100u);
}

TEST(Where, MaskedRowsAndRowsBeforeTheFirstTurnDoNotCount) {
  auto data = planted({}, {16.138}, three_kinds(), 5);
  const std::size_t rows = data.runs[0].current_mA.size();
  std::vector<std::vector<bool>> masked(3, std::vector<bool>(rows, false));
  std::fill(masked[1].begin() + 50, masked[1].begin() + 90, true);
  const auto counted = rows_by_factor(Mapped{std::move(data), std::move(masked)}());
  EXPECT_EQ(counted.at("direction"), 3 * rows - 40);
  EXPECT_EQ(counted.at("braid stop"), 3 * rows - 40);
  EXPECT_LT(counted.at("time since reversal"), 3 * rows - 40);
  EXPECT_GT(counted.at("time since reversal"), rows);
}

TEST(Where, TheSeedDecidesAndThreadsDoNot) {
  plant::Rig truth;
  truth.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 5e-11;
  const auto data = planted(truth, {11.138}, three_kinds(), 6);
  const auto one = Mapped{data, {}, 1}(), two = Mapped{data, {}, 2}();
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].p_value, two[i].p_value);
    EXPECT_EQ(one[i].mean, two[i].mean);
  }
}

}  // namespace
}  // namespace mckibben::diagnose
