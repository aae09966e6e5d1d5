// Loads that are not what hung are said to be so, whatever the rig has.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <sim/domain/number.hpp>
#include <sim/run/look.hpp>

#include "measured_on.hpp"
#include "says.hpp"
#include "switched_on.hpp"

namespace mckibben::run {
namespace {

TEST(Sanity, AllLoadsInAnotherUnitAreSaid) {
  const auto expect = [](domain::Dataset data, double factor, const char* words) {
    for (domain::Run& run : data.runs) run.load_kg *= factor;
    const std::string text = says(data);
    EXPECT_TRUE(holds(text, ": all runs: load = ")) << words << text;
    EXPECT_TRUE(holds(text, words, ", here load: ")) << words << text;
    return text.starts_with("measured/dataset.yaml: error");
  };
  EXPECT_TRUE(expect(sound(), 1e-3, "these look like kg that are written in g: write kg"));
  EXPECT_TRUE(expect(sound(), 9.80665, "these look like N, not kg: write the mass, N / 9.81"));
  expect(sound(), 2.20462, "these look like pounds, not kg: write lb");
  EXPECT_FALSE(expect(sound(), 1.0 / 2.20462, "these look like kg that are written in lb: write kg"));
}

// What hangs beside half of it, simulated, is weighed with another friction: effects make the factors uneven.
TEST(Sanity, KilogramsWrittenInPoundsAreAskedAboutWhateverTheRigHas) {
  for (const auto& [name, rig] : plant::rigs_with_one_effect()) {
    auto data = measured_on(rig);
    for (domain::Run& run : data.runs) run.load_kg *= domain::pound_kg;
    const auto list = said(data);
    EXPECT_TRUE(!list.empty() &&
                list.front().find("kg that are written in lb: write kg") != std::string::npos)
        << name << ": " << fmt::format("{}", fmt::join(list, "; "));
  }
}

TEST(Sanity, APointThatIsMisplacedIsNoOtherZeroOfTheContraction) {
  plant::Rig rig;
  rig.valve.zero_pressure_Pa = 1.2e5;  // lifts at once
  auto& tube = rig.effects.get<plant::BladderElasticity>();
  tube.variant = plant::BladderLaw::saturating;
  tube.force_N = 80.0;
  tube.ratio = 0.024;
  auto data = measured_on(rig, {2.0, 4.0, 6.0, 8.0}, rig);
  EXPECT_EQ(said(data), std::vector<std::string>{});
  for (const std::size_t run : {6U, 7U}) data.runs[run].load_kg = 80.0;
  EXPECT_TRUE(holds(says(data), "warning: runs r07, r08: is a point misplaced? r07 (80 kg) moves like ",
                    " kg: write load: 8 kg; r08 (80 kg)"));
}

TEST(Sanity, AMuscleThatLiftsQuiteOtherLoadsIsAskedAbout) {
  auto data = sound();
  for (const auto& [factor, fits] : {std::pair{1.3, "times 0.7"}, std::pair{0.77, "times 1."}}) {
    data.rig.muscle.rest_radius_m = factor * plant::Rig{}.muscle.rest_radius_m;
    EXPECT_TRUE(holds(says(data), "dataset.yaml: warning: all loads move like ",
                      std::string("is the rig this muscle? rest_radius ") + fits));
  }
}

TEST(Sanity, ALoadThatIsNeverLiftedIsSaid) {
  auto data = measured_on({}, {11.138, 16.138, 111.38});
  const auto list = said(data);
  ASSERT_FALSE(list.empty());
  EXPECT_TRUE(
      holds(list.front(), "warning: runs r05, r06: the load hardly leaves its stop: load = 111.38 kg is "))
      << list.front();
}

/// Runs 0 and 1 have the first load, 2 and 3 the second, 4 and 5 the third.
domain::Dataset labelled(const domain::Dataset& sound_data, std::vector<std::size_t> runs,
                         const std::vector<double>& labels_kg) {
  domain::Dataset data = sound_data;
  data.runs.clear();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    data.runs.push_back(sound_data.runs[runs[i]]);
    data.runs.back().load_kg = labels_kg[i];
  }
  return data;
}

TEST(Sanity, ExchangedLabelsOfTwoOrThreeRunsAreFound) {
  const std::string two = says(labelled(sound(), {0, 2, 4}, {16.138, 11.138, 23.406}));
  EXPECT_TRUE(two.starts_with("measured/dataset.yaml: warning: runs r01, r03: ")) << two;
  EXPECT_TRUE(two.ends_with("write load: 11.138 kg for r01, load: 16.138 kg for r03")) << two;
  const std::string pair = says(labelled(sound(), {1, 5}, {23.406, 11.138}));
  EXPECT_TRUE(pair.ends_with("write load: 11.138 kg for r02, load: 23.406 kg for r06")) << pair;
  const std::string around = says(labelled(sound(), {0, 2, 4}, {16.138, 23.406, 11.138}));
  EXPECT_TRUE(
      around.ends_with("write load: 11.138 kg for r01, load: 16.138 kg for r03, load: 23.406 kg for r05"))
      << around;
}

TEST(Sanity, ASingleWrongLabelIsSaidWithWhatItsRunLifts) {
  const auto expect = [](const domain::Dataset& data, const char* run, const char* begins, double load_kg) {
    const std::string text = says(data), line = "Then load: ";
    EXPECT_TRUE(holds(text, fmt::format("warning: run {}: {}", run, begins))) << text;
    const auto at = text.find(line);
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_NEAR(std::stod(text.substr(at + line.size())), load_kg, 0.1 * load_kg) << text;
  };
  // An exchange would bring these in order, and each of its lines would be wrong.
  expect(labelled(sound(), {0, 2}, {21.138, 16.138}), "r01", "r01 (21.138 kg) moves like 1", 11.138);
  expect(labelled(sound(), {0, 2, 4}, {19.138, 16.138, 23.406}), "r01", "r01 (19.138 kg) moves like 1",
         11.138);
  expect(labelled(sound(), {0, 1, 2, 3, 4, 5}, {11.138, 11.138, 16.138, 16.138, 9.0, 23.406}), "r05",
         "r05 (9 kg) moves like 2", 23.406);
  // No exchange would.
  expect(labelled(sound(), {0, 1, 2, 3, 4, 5}, {11.138, 11.138, 16.138, 16.138, 23.406, 43.406}), "r06",
         "r06 (43.406 kg) moves like 2", 23.406);
}

// 3 kg are a fifth: one of four runs, whatever the rig has.
TEST(Sanity, AWrongLabelThatKeepsTheOrderIsFoundAmongFourRuns) {
  auto rigs = plant::rigs_with_one_effect();
  rigs.push_back({"weak", {}});
  rigs.back().rig.muscle.rest_radius_m *= std::sqrt(2.0 / 3.0);
  for (const auto& [name, rig] : rigs) {
    const auto data = measured_on(rig, {5.0, 11.138, 16.138, 23.406});
    EXPECT_EQ(said(data), std::vector<std::string>{}) << name;
    const auto list = said(labelled(data, {0, 2, 4, 6}, {5.0, 11.138, 13.138, 23.406}));
    if (name == "end_cap_correction") continue;  // the others differ too much
    ASSERT_EQ(list.size(), 1u) << name;
    EXPECT_TRUE(holds(list.front(), "run r05: r05 (13.138 kg) moves like ", "Is this label wrong?",
                      "Or is its reading's zero elsewhere?"))
        << name << ": " << list.front();
  }
}

TEST(Sanity, ARunWithoutALoadThatCarriesOneIsSaid) {
  auto rigs = plant::rigs_with_one_effect();
  rigs.insert(rigs.begin(), {"nominal", {}});
  for (const auto& [name, rig] : rigs) {
    auto data = measured_on(rig, {0.0, 5.0, 16.138});
    EXPECT_EQ(said(data), std::vector<std::string>{}) << name;
    for (const std::size_t run : {4U, 5U}) data.runs[run].load_kg = 0.0;
    const auto list = said(data);
    ASSERT_FALSE(list.empty()) << name;
    EXPECT_TRUE(holds(list.front(), "runs r05, r06: load = 0 kg, but r05 moves like 1", "write the load"))
        << name << ": " << list.front();
  }
}

TEST(Sanity, WhatIsFarOffIsBlamedOnItsRuns) {
  auto data = labelled(sound(), {0, 2, 4}, {11.138, 16.138, 23.406});
  for (double& ratio : data.runs[1].judged().values) ratio = 0.15 - ratio;
  for (const std::string& text : said(data))
    if (text.find("rmse is up to") != std::string::npos) {
      EXPECT_TRUE(text.find("run r03: contraction") != std::string::npos) << text;
    }
}

// Also with an effect in the rig, or another muscle: the order of the loads needs no exact model.
TEST(Sanity, ExchangedLabelsAreFoundWhateverTheRigHas) {
  auto rigs = plant::rigs_with_one_effect();
  rigs.push_back({"weak", {}});
  rigs.back().rig.muscle.rest_radius_m *= std::sqrt(2.0 / 3.0);
  for (const auto& [name, rig] : rigs) {
    const auto data = measured_on(rig);
    const auto findings = look(labelled(data, {0, 2, 4}, {11.138, 23.406, 16.138})).findings;
    ASSERT_EQ(findings.size(), 1u) << name;
    EXPECT_EQ(findings.front().runs, (std::vector<std::size_t>{1, 2})) << name;
    EXPECT_FALSE(findings.front().exchanged.empty()) << name;
  }
}

}  // namespace
}  // namespace mckibben::run
