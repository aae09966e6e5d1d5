// Bad data: each kind is found and named, and sound data with a hidden effect are left alone.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <sim/data/finding.hpp>
#include <sim/diagnose/check.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/run/simulate.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {
namespace {

/// Two loads under three currents.
domain::Dataset sound() {
  static const domain::Dataset data = planted({}, {11.138, 16.138}, three_kinds(), 1);
  return data;
}
domain::Dataset with_gauge() {
  static const domain::Dataset data = [] {
    plant::Rig truth;
    truth.sensors.put(plant::gauge());
    return planted(truth, {11.138, 16.138}, three_kinds(), 2);
  }();
  return data;
}

bool says(const Checked& checked, std::string_view words) {
  return std::any_of(checked.warnings.begin(), checked.warnings.end(),
                     [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
}

/// Row numbers that are masked in a run.
std::vector<std::size_t> masked(const Checked& checked, std::size_t run) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < checked.masked[run].size(); ++k)
    if (checked.masked[run][k]) rows.push_back(k);
  return rows;
}

/// The message of the error that the data end in; empty if they do not.
std::string error(const domain::Dataset& data) {
  try {
    check(data, 2);
  } catch (const data::UnfitData& unfit) {
    return unfit.what();
  }
  return "";
}

void expect_no_doubts(const Checked& checked) {
  EXPECT_EQ(checked.warnings, std::vector<std::string>{});
  EXPECT_EQ(checked.left_out, Runs{});
  EXPECT_EQ(checked.dead_gauges, Runs{});
  EXPECT_FALSE(checked.cannot_tell);
  for (std::size_t run = 0; run < checked.masked.size(); ++run) EXPECT_TRUE(masked(checked, run).empty());
}

TEST(Checks, SoundDataRaiseNoDoubts) {
  expect_no_doubts(check(sound(), 2));
  expect_no_doubts(check(with_gauge(), 1));
}

TEST(Checks, HiddenEffectsAreNotTakenForBadData) {
  plant::Rig friction, leak, backlash;
  friction.effects.get<plant::SpeedDependentFriction>().ratio = 0.4;
  leak.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 3e-10;
  backlash.effects.get<plant::EncoderBacklash>().width_m = 2e-3;
  const auto kinds = three_kinds();
  for (const plant::Rig& truth : {friction, leak, backlash})
    expect_no_doubts(check(planted(truth, {11.138, 23.406}, {kinds[0], kinds[1]}, 3), 2));
}

TEST(Checks, ReadingsThatNoLoadCouldFollowAreMaskedOneByOne) {
  auto data = sound();
  auto& readings = data.runs[1].contraction_ratio;
  readings[200] += 0.05;
  for (std::size_t k = 330; k < 333; ++k) readings[k] -= 0.04;
  readings[0] += 0.03;
  const Checked checked = check(data, 2);
  EXPECT_EQ(masked(checked, 1), (std::vector<std::size_t>{0, 200, 330, 331, 332}));
  EXPECT_TRUE(says(checked, "run r02: 3 outliers in contraction_ratio, at 0.000 s, 2.400 s, 3.960 s"));
  EXPECT_EQ(checked.left_out, Runs{});
  EXPECT_TRUE(masked(checked, 0).empty());
}

TEST(Checks, AnEncoderThatSticksIsMaskedWhileItSticks) {
  auto data = sound();
  auto& readings = data.runs[0].contraction_ratio;
  std::fill(readings.begin() + 36, readings.begin() + 110, readings[36]);
  const Checked checked = check(data, 2);
  EXPECT_TRUE(says(
      checked,
      fmt::format("run r01: contraction_ratio is frozen at {:.4g} from 0.432 s to 1.308 s", readings[36])));
  EXPECT_TRUE(checked.masked[0][37]);
  EXPECT_TRUE(checked.masked[0][109]);
  EXPECT_FALSE(checked.masked[0][110]);
  EXPECT_EQ(checked.left_out, Runs{});
}

TEST(Checks, ReadingsFrozenWhileTheLoadLeavesTheStopAreMasked) {
  auto data = sound();
  auto& readings = data.runs[0].contraction_ratio;  // a sine, which begins on the stop
  const auto leaves =
      std::find_if(readings.begin(), readings.end(), [](double ratio) { return ratio > 0.0; });
  std::fill(leaves, leaves + 60, 0.0);
  const auto end = static_cast<std::size_t>(leaves - readings.begin()) + 60;
  const Checked checked = check(data, 2);
  EXPECT_TRUE(says(checked, "run r01: contraction_ratio is frozen at 0 from"));
  EXPECT_TRUE(checked.masked[0][end - 1]);
  EXPECT_FALSE(checked.masked[0][end]);
  EXPECT_EQ(checked.left_out, Runs{});
}

TEST(Checks, ReadingsCutOffByTheEndOfTheirRangeAreSaidAndNotTakenForAnotherLoad) {
  controllers::TriangleCurrent slow;
  slow.low_mA = 4.0;
  slow.high_mA = 14.0;
  slow.speed_mA_per_s = 8.0;
  auto data = planted({}, {11.138, 13.87, 16.138, 18.87}, {{"triangle", 5.0, slow}}, 5);
  auto& readings = data.runs[0].contraction_ratio;
  const double count = run::contraction_per_count(data.rig);
  const double most =
      count * std::floor(0.8 * *std::max_element(readings.begin(), readings.end()) / count + 0.5);
  for (double& ratio : readings) ratio = std::min(ratio, most);
  const Checked checked = check(data, 2);
  EXPECT_TRUE(says(
      checked, fmt::format("run r01: contraction_ratio is saturated at {:.4g} 2 times, first from ", most)));
  for (const std::size_t row : masked(checked, 0)) EXPECT_EQ(readings[row], most);
  EXPECT_TRUE(says(checked, "run r01: too little of it is left"));
  EXPECT_EQ(checked.left_out, Runs{0});
}

TEST(Checks, AValveThatStuckCostsItsRun) {
  auto data = sound();
  domain::Run stuck = data.runs[0];
  std::fill(stuck.current_mA.begin() + 150, stuck.current_mA.end(), stuck.current_mA[150]);
  const Loaded hanging{data.rig, stuck.load_kg};
  data.runs[0].contraction_ratio = predict(stuck, {&hanging, 1}).front().judged;
  const double count = run::contraction_per_count(data.rig);
  for (double& ratio : data.runs[0].contraction_ratio) ratio = count * std::floor(ratio / count);
  const Checked checked = check(data, 2);
  EXPECT_TRUE(says(checked, "run r01: the load stands still from"));
  EXPECT_TRUE(says(checked, "the valve was stuck, or something held the load"));
  EXPECT_EQ(checked.left_out, Runs{0});
}

TEST(Checks, ARunThatLostCountsIsLeftOut) {
  auto data = sound();
  auto& readings = data.runs[1].contraction_ratio;  // a staircase, standing still at 3.4 s
  for (std::size_t k = 280; k < readings.size(); ++k) readings[k] += 0.03;
  const Checked checked = check(data, 2);
  EXPECT_EQ(checked.left_out, Runs{1});
  EXPECT_TRUE(says(checked, "run r02: contraction_ratio jumps by 0.03 at 3.360 s"));
}

TEST(Checks, RunsThatNeverMoveAreLeftOut) {
  auto data = sound();
  std::fill(data.runs[2].current_mA.begin(), data.runs[2].current_mA.end(), 3.9);
  std::fill(data.runs[2].contraction_ratio.begin(), data.runs[2].contraction_ratio.end(), 0.0);
  std::fill(data.runs[4].contraction_ratio.begin(), data.runs[4].contraction_ratio.end(), 0.0);
  const Checked checked = check(data, 2);
  EXPECT_EQ(checked.left_out, (Runs{2, 4}));
  EXPECT_TRUE(says(checked, "run r03: the current stays at or below 3.9 mA"));
  EXPECT_TRUE(says(checked, "run r05: the reading never changes, though"));
  EXPECT_FALSE(checked.cannot_tell);
}

TEST(Checks, TooFewRunsCannotTell) {
  auto data = sound();
  data.runs.resize(2);
  const Checked two = check(data, 2);
  ASSERT_TRUE(two.cannot_tell);
  EXPECT_NE(two.cannot_tell->find("at least four runs"), std::string::npos);
  for (domain::Run& run : data.runs)
    std::fill(run.contraction_ratio.begin(), run.contraction_ratio.end(), 0.0);
  const Checked none = check(data, 2);
  EXPECT_EQ(none.left_out, (Runs{0, 1}));
  EXPECT_TRUE(none.cannot_tell);
}

TEST(Checks, OneLoadOnlyIsSaid) {
  const Checked checked = check(planted({}, {16.138}, three_kinds(), 4), 2);
  EXPECT_TRUE(says(checked, "all runs have the same load, 16.138 kg"));
  EXPECT_FALSE(checked.cannot_tell);
}

TEST(Checks, WrongUnitsAreErrorsThatNameFileAndColumn) {
  auto amperes = sound();
  for (double& current : amperes.runs[3].current_mA) current *= 1e-3;
  EXPECT_EQ(
      error(amperes),
      "planted/dataset.yaml: error: run r04: current: never above 0.02 mA; this looks like amperes, not "
      "mA; write columns: {current: {column: current_mA, unit: A}}");
  auto share = sound();
  for (double& current : share.runs[0].current_mA) current = (current - 4.0) / 16.0;
  EXPECT_NE(error(share).find("a share of the range"), std::string::npos);
  auto per_cent = sound();
  for (double& ratio : per_cent.runs[1].contraction_ratio) ratio *= 100.0;
  EXPECT_EQ(
      error(per_cent),
      "planted/dataset.yaml: error: run r02: contraction is up to 31.15, 100 times what the rig would do; "
      "this looks like per cent, not a ratio; write columns: {contraction: "
      "{column: contraction_ratio, unit: \"%\"}}");
  auto metres = sound();
  for (double& ratio : metres.runs[1].contraction_ratio) ratio *= metres.rig.muscle.rest_length_m;
  EXPECT_NE(error(metres).find("metres"), std::string::npos);
}

TEST(Checks, ContractionWithTheOtherSignIsAnError) {
  auto data = sound();
  for (double& ratio : data.runs[0].contraction_ratio) ratio *= -0.5;
  EXPECT_NE(error(data).find("it goes the other way than the rig would; its sign is the other one"),
            std::string::npos);
}

TEST(Checks, PressureInAnotherUnitIsAnError) {
  auto kilopascal = with_gauge(), absolute = with_gauge();
  for (double& pressure : *kilopascal.runs[5].muscle_pressure_Pa) pressure *= 100.0;
  EXPECT_EQ(error(kilopascal),
            "planted/dataset.yaml: error: run r06: muscle_pressure is up to 435.8 bar, 100 times what the "
            "rig would do; this looks like kPa, not bar; write columns: {muscle_pressure: {column: "
            "muscle_pressure_bar, unit: kPa}}");
  for (double& pressure : *absolute.runs[0].muscle_pressure_Pa) pressure += 1.013e5;
  EXPECT_NE(error(absolute).find("run r01: muscle_pressure is about one atmosphere"), std::string::npos);
}

TEST(Checks, ADeadGaugeIsIgnoredNotTheRun) {
  auto data = with_gauge();
  for (double& pressure : *data.runs[1].muscle_pressure_Pa) pressure = 2.5e5;
  const Checked checked = check(data, 2);
  EXPECT_EQ(checked.dead_gauges, Runs{1});
  EXPECT_EQ(checked.left_out, Runs{});
  EXPECT_TRUE(says(checked, "run r02: muscle_pressure_bar is 2.5 throughout"));
}

TEST(Checks, AMislabelledLoadIsFoundAndSaid) {
  plant::Rig truth;
  truth.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 2e-10;
  const auto kinds = three_kinds();
  auto data = planted(truth, {11.138, 16.138}, {kinds[0], kinds[1]}, 5);
  data.runs[1].load_kg = 16.138;
  const Checked checked = check(data, 2);
  EXPECT_EQ(checked.left_out, Runs{1});
  EXPECT_TRUE(says(checked, "run r02: the load is labelled 16.138 kg, but everything else says about 11."));
  EXPECT_EQ(check(data, 1).warnings, checked.warnings);
}

TEST(Checks, TwoExchangedLabelsOfFourAreBothFound) {
  const auto kinds = three_kinds();
  auto data = planted({}, {11.138, 16.138, 18.87, 23.406}, {kinds[0]}, 6);
  std::swap(data.runs[0].load_kg, data.runs[2].load_kg);
  const Checked checked = check(data, 2);
  EXPECT_EQ(checked.left_out, (Runs{0, 2}));
  EXPECT_TRUE(checked.cannot_tell);  // two of four
}

TEST(Checks, ExchangedLabelsOfThreeRunsAreNamedAndNothingElseIs) {
  const auto kinds = three_kinds();
  auto data = planted({}, {11.138, 16.138, 23.406}, {kinds[0]}, 6);
  std::swap(data.runs[0].load_kg, data.runs[1].load_kg);
  const Checked checked = check(data, 2);
  EXPECT_EQ(checked.left_out, (Runs{0, 1}));
  ASSERT_TRUE(checked.cannot_tell);
  EXPECT_NE(checked.cannot_tell->find("runs r01, r02: "), std::string::npos);
  EXPECT_NE(checked.cannot_tell->find("write load: 11.138 kg for r01, load: 16.138 kg for r02"),
            std::string::npos);
}

TEST(Checks, LoadsInGramsAreAnError) {
  auto data = sound();
  for (domain::Run& run : data.runs) run.load_kg *= 1e-3;
  EXPECT_NE(error(data).find("kg that are written in g"), std::string::npos);
}

TEST(Checks, ARunWithAnotherZeroIsNotTakenForAnotherLoad) {
  auto data = sound();
  for (double& ratio : data.runs[2].contraction_ratio) ratio += 0.02;
  const Checked checked = check(data, 2);
  EXPECT_EQ(checked.left_out, Runs{2});
  EXPECT_TRUE(says(checked, "run r03: has its zero moved by 4"));
}

TEST(Checks, ARunWithAnotherCurrentIsNotTakenForAnotherLoad) {
  auto data = sound();
  for (double& current_mA : data.runs[0].current_mA) current_mA *= 1.07;
  const Checked checked = check(data, 2);
  ASSERT_EQ(checked.left_out, Runs{0});
  EXPECT_TRUE(says(checked, "run r01: has a current that is 1.06")) << checked.warnings.front();
}

TEST(Checks, LoadsInPoundsAreAnError) {
  auto data = sound();
  for (domain::Run& run : data.runs) run.load_kg /= 0.45359237;
  EXPECT_NE(error(data).find("these look like pounds, not kg"), std::string::npos);
}

TEST(Checks, ThreeRunsAreTooFewToCheckLabelsAndItSaysSo) {
  auto data = sound();
  data.runs.resize(3);
  const Checked checked = check(data, 2);
  EXPECT_TRUE(says(checked, "3 usable runs: their loads are in order, but too few to weigh"));
  EXPECT_FALSE(checked.cannot_tell);
}

TEST(Checks, ACopyOfARunIsLeftOut) {
  auto data = sound();
  data.runs.push_back(data.runs[1]);
  data.runs.back().id = "r07";
  const Checked checked = check(data, 2);
  EXPECT_EQ(checked.left_out, Runs{6});
  EXPECT_TRUE(says(checked, "run r07: equal to run r02 in every reading: a copy"));
}

TEST(Checks, AGaugeThatRunsBackwardsIsIgnoredAndItsSpikesAreMasked) {
  auto data = with_gauge();
  for (double& pressure : *data.runs[0].muscle_pressure_Pa) pressure = 5e5 - pressure;
  (*data.runs[3].muscle_pressure_Pa)[200] += 1e5;
  const Checked checked = check(data, 2);
  EXPECT_EQ(checked.dead_gauges, Runs{0});
  EXPECT_TRUE(says(checked, "run r01: muscle_pressure_bar does not follow the current"));
  EXPECT_EQ(masked(checked, 3), std::vector<std::size_t>{200});
  EXPECT_TRUE(says(checked, "run r04: 1 outlier in muscle_pressure_bar, at 2.400 s"));
}

TEST(Checks, AnOffsetOfAllLoadsIsNoWrongLabel) {
  auto data = sound();
  for (domain::Run& run : data.runs) run.load_kg += 1.5;
  expect_no_doubts(check(data, 2));
}

}  // namespace
}  // namespace mckibben::diagnose
