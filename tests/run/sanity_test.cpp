// Data that are not what they are called are said to be so, with the line to write; sound data of rigs that
// are another than described are left alone.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <sim/data/odd_readings.hpp>
#include <sim/data/plausible.hpp>
#include <sim/run/campaign.hpp>
#include <sim/run/look.hpp>

#include "measured_on.hpp"
#include "says.hpp"
#include "switched_on.hpp"

namespace mckibben::run {
namespace {

plant::Rig switched(plant::Rig rig) {
  rig.valve.kind = plant::ValveKind::on_off;
  rig.valve.switching = plant::Switching::averaged;
  rig.valve.resolve();
  return rig;
}

domain::Dataset scaled(double factor, std::vector<std::size_t> runs = {0, 1, 2, 3, 4, 5}) {
  auto data = sound();
  for (const std::size_t run : runs)
    for (double& ratio : data.runs[run].judged().values) ratio *= factor;
  return data;
}

/// As if the contraction had been read from a column in mm.
void read_from(domain::Dataset& data, domain::ColumnPlace millimetres) {
  data.columns["contraction"] = std::move(millimetres);
  for (domain::Run& run : data.runs) run.ratio_per_unit = 1e-3 / data.rig.muscle.rest_length_m;
}

TEST(Sanity, ADutyWithTheOtherSignIsToldByTheFlow) {
  domain::Dataset data = measured_on(switched({}), {11.138, 16.138}, switched({}));
  EXPECT_EQ(said(data), std::vector<std::string>{});
  for (domain::Run& run : data.runs)
    for (double& mA : run.current_mA) mA = 24.0 - mA;
  EXPECT_TRUE(holds(said(data).front(), "all runs: current: where it fills by the rig, the muscle gives way",
                    "write columns: {current: {column: current_mA, unit: mA, zero: 24, factor: -1}}"));
  for (const auto& [name, rig] : plant::rigs_with_one_effect())
    for (const std::string& one : said(measured_on(switched(rig), {16.138}, switched({}))))
      EXPECT_EQ(one.find("gives way"), std::string::npos) << name;
}

TEST(Sanity, WhereTheGaugeFollowsTheDutyTheContractionHasTheOtherSign) {
  plant::Rig rig = switched({});
  rig.sensors.put(plant::gauge());
  domain::Dataset data = measured_on(rig, {11.138, 16.138}, rig);
  EXPECT_EQ(said(data), std::vector<std::string>{});
  for (domain::Run& run : data.runs)
    for (double& ratio : run.judged().values) ratio *= -1.0;
  const auto all = said(data);
  EXPECT_TRUE(std::ranges::any_of(all, [](const std::string& one) {
    return one.find("contraction: where valves fill, pressure rises and the muscle gives way") !=
           std::string::npos;
  })) << (all.empty() ? "nothing" : all.front());
  for (const std::string& one : all) EXPECT_EQ(one.find("current: where it fills"), std::string::npos);
}

TEST(Sanity, SoundDataOfOtherRigsAreLeftAlone) {
  std::vector<plant::NamedRig> rigs = plant::rigs_with_one_effect();
  for (const double strength : {2.0 / 3.0, 4.0 / 3.0}) {
    rigs.push_back({fmt::format("{:.2f} times as strong", strength), {}});
    rigs.back().rig.muscle.rest_radius_m *= std::sqrt(strength);
  }
  rigs.push_back({"less air", {}});
  rigs.back().rig.valve.span_pressure_Pa *= 0.7;
  rigs.push_back({"gauge", {}});
  rigs.back().rig.sensors.put(plant::gauge());
  for (const auto& [name, rig] : rigs) EXPECT_EQ(said(measured_on(rig)), std::vector<std::string>{}) << name;
}

TEST(Sanity, OneLoadThatAWeakMuscleHardlyLiftsIsNoOtherUnit) {
  for (const double strength : {0.5, 0.6, 2.0 / 3.0, 0.8, 1.5}) {
    plant::Rig rig;
    rig.muscle.rest_radius_m *= std::sqrt(strength);
    for (const std::string& text : said(measured_on(rig, {36.0})))
      EXPECT_NE(text.find("% of what was read"), std::string::npos) << strength << ": " << text;
  }
}

TEST(Sanity, ARatioThatIsCalledMillimetresIsSaidWithTheLineToWrite) {
  auto data = scaled(1.0 / 300.0);
  read_from(data, {"contraction_ratio", "mm"});
  const std::string text = says(data);
  EXPECT_TRUE(text.starts_with("measured/dataset.yaml: error: all runs: contraction is up to ")) << text;
  EXPECT_TRUE(
      text.ends_with("this looks like a ratio, not millimetres (mm); write columns: {contraction: "
                     "{column: contraction_ratio, unit: 1}}"))
      << text;
}

TEST(Sanity, OtherUnitsAreNamed) {
  const auto expect = [](double factor, const char* words) {
    EXPECT_TRUE(holds(says(scaled(factor)), words)) << factor;
  };
  expect(300.0,
         "millimetres (mm), not a ratio; write columns: {contraction: {column: contraction_ratio, unit: mm, "
         "factor: 1}}");
  expect(100.0,
         "per cent, not a ratio; write columns: {contraction: {column: contraction_ratio, unit: \"%\", "
         "factor: 1}}");
  expect(0.3, "metres, not a ratio");
  expect(1.0 / 300.0, "a ratio that was divided by the rest length in millimetres");
  auto inches = scaled(1.0 / 25.4);
  read_from(inches, {"rope", "mm"});
  EXPECT_TRUE(holds(says(inches), "{contraction: {column: rope, unit: in, factor: 1}}"));
}

TEST(Sanity, AGaugeInAnotherUnitIsToldAlsoWhereTheRigsPressureIsOff) {
  auto data = sound();
  data.columns["muscle_pressure"] = {"p", "psi"};
  for (domain::Run& run : data.runs)
    for (double& pressure_Pa : run.find("muscle_pressure")->values) pressure_Pa *= 0.052;
  const auto list = said(data);
  ASSERT_FALSE(list.empty());
  EXPECT_TRUE(holds(list.front(),
                    "is it in bar? Then columns: {muscle_pressure: {column: p, unit: bar, factor: 1}}"));
}

TEST(Sanity, AnAtmosphereIsToldByWhatTheGaugeReadsAtRest) {
  const auto told = [](double gain, double zero_Pa) {
    auto data = sound();
    for (domain::Run& run : data.runs)
      for (double& pressure_Pa : run.find("muscle_pressure")->values)
        pressure_Pa = gain * pressure_Pa + zero_Pa;
    return says(data);
  };
  EXPECT_TRUE(holds(told(1.0, -101325.0), "error", "one atmosphere too low; ", "zero: -1.01325}}"));
  EXPECT_TRUE(
      holds(told(1.4, 0.8e5), "warning", "too high where the rig is at rest, ", "bar, in the middle"));
}

TEST(Sanity, AZeroOfAGaugeThatWasForgottenIsAskedFor) {
  auto data = sound();
  const auto read_more = [&](double by_Pa, const std::vector<std::size_t>& runs) {
    for (const std::size_t run : runs)
      for (double& pressure_Pa : data.runs[run].find("muscle_pressure")->values) pressure_Pa += by_Pa;
  };
  data.columns["muscle_pressure"] = {.column = "p", .unit = "bar", .factor = 2.5};
  read_more(0.1e5, {0, 1, 2, 3, 4, 5});
  EXPECT_EQ(said(data), std::vector<std::string>{}) << "gauges do so";
  read_more(1.15e5, {0, 1, 2, 3, 4, 5});
  EXPECT_TRUE(holds(says(data), "warning: all runs: muscle_pressure reads 1.2",
                    " bar more than the rig has where runs begin",
                    "About columns: {muscle_pressure: {column: p, unit: bar, zero: 0.", ", factor: 2.5}}"));
  read_more(-0.8e5, {0, 1, 2, 3, 4, 5});
  EXPECT_TRUE(holds(says(data), "muscle_pressure reads 0.4"));
  read_more(-0.4e5, {0, 1, 2});
  for (const std::string& one : said(data)) EXPECT_EQ(one.find(" reads 0."), std::string::npos) << one;
}

TEST(Sanity, ALabelThatTheLoadCellContradictsInOneRunIsAskedFor) {
  auto data = sound();
  data.columns["force"] = {.column = "F", .unit = "N"};
  for (domain::Run& run : data.runs)
    run.read("force", std::vector(run.rows(), run.load_kg * plant::gravity_m_per_s2));
  const double hung_kg = data.runs[2].load_kg;
  data.runs[2].load_kg += 2.0;
  const std::string told = fmt::format("{}", fmt::join(said(data), "\n"));
  EXPECT_TRUE(
      holds(told, " N less than hangs there, in no other run so: ", fmt::format("is load: {:.2g}", hung_kg)))
      << told;
  for (domain::Run& run : data.runs) run.find("force")->values.assign(run.rows(), 150.0);
  EXPECT_EQ(fmt::format("{}", fmt::join(said(data), "\n")).find("in no other run"), std::string::npos);
}

// A load does not accelerate on average: what its cell reads more or less is the cell's, or the label's.
TEST(Sanity, AZeroOrFactorOfALoadCellThatWasForgottenIsAskedFor) {
  const auto told = [](double gain, double zero_N, std::size_t runs = 6) {
    auto data = sound();
    data.runs.resize(runs);
    data.columns["force"] = {.column = "F", .unit = "N", .factor = 2.5};
    for (domain::Run& run : data.runs)
      run.read("force", std::vector(run.rows(), gain * run.load_kg * plant::gravity_m_per_s2 + zero_N));
    return fmt::format("{}", fmt::join(said(data), "\n"));
  };
  EXPECT_EQ(told(1.0, 1.0), "");
  EXPECT_TRUE(holds(told(1.0, 12.0), "warning: all runs: force reads 11.", " N more than hangs there, ",
                    "About columns: {force: {column: F, unit: N, zero: 4.", ", factor: 2.5}}"));
  EXPECT_TRUE(holds(told(1.0, -30.0), "force reads 30", " N less than hangs there"));
  EXPECT_EQ(told(1.04, 0.0), "") << "a guide's friction does so";
  EXPECT_TRUE(holds(told(1.08, 0.0), "warning: all runs: force reads 1.08 times what hangs there, ",
                    "under every load: ", "Then columns: {force: {column: F, unit: N, factor: 2.3",
                    "or all loads are 8", " % more than written"));
  EXPECT_TRUE(holds(told(0.5, 0.0), "factor: 5", " % less than written"));
  EXPECT_TRUE(holds(told(0.46, 0.0),
                    "times what hangs there, under every load: all loads look like lb, not "
                    "kg: write lb; or is a factor of the load cell left out?"));
  EXPECT_TRUE(holds(told(1.3, -20.0), "times what hangs there and ", " N less, under every load: "));
  EXPECT_TRUE(holds(told(2.0, 0.0, 1), "times what hangs there: ", "or the load is ",
                    "one load does not separate them"));
}

TEST(Sanity, ARunThatBeginsOnItsWayIsToldWithItsSpeed) {
  auto data = sound();
  domain::Run& run = data.runs[2];
  std::ptrdiff_t rows = 0;  // where it is quickest
  const auto rise = [at = run.judged().values.begin()](std::ptrdiff_t k) { return at[k + 9] - at[k]; };
  for (std::ptrdiff_t k = 0; k < 200; ++k) rows = rise(k) > rise(rows) ? k : rows;
  for (auto* column : {&run.judged().values, &run.current_mA, &run.find("muscle_pressure")->values})
    column->erase(column->begin(), column->begin() + rows);
  EXPECT_TRUE(holds(says(data), "run r03: begins on its way, r03 at ",
                    " mm/s: ", "write start: moving at the top of dataset.yaml"));
}

TEST(Sanity, ACommandThatWasRoundedIsTold) {
  EXPECT_TRUE(data::implausible(sound()).empty());
  auto data = sound();
  for (domain::Run& run : data.runs)
    for (double& current_mA : run.current_mA) current_mA = 0.25 * std::round(current_mA / 0.25);
  const auto found = data::implausible(data);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(holds(found.front().message, "is rounded to 0.25 mA, and the rig's DAC has steps of 0.0049 mA",
                    "dac: {bits: 6}"));
}

TEST(Sanity, AWrongRestLengthIsAmongTheSuspectsOfALengthThatWasRead) {
  for (const double factor : {2.0, 5.0, 10.0}) {
    auto data = scaled(1.0 / factor);
    data.rig.muscle.rest_length_m *= factor;
    read_from(data, {"laser", "mm"});
    const auto list = said(data);
    EXPECT_TRUE(std::ranges::any_of(list, [](const std::string& text) {
      return text.find("rest_length") != std::string::npos;
    })) << factor;
  }
}

TEST(Sanity, OneRunInAnotherUnitIsNamed) {
  EXPECT_TRUE(says(scaled(100.0, {2})).starts_with("measured/dataset.yaml: error: run r03: "));
}

TEST(Sanity, TheOtherSignIsSaidOnceWithItsFactor) {
  const std::string text = says(scaled(-1.0, {1, 4}));
  EXPECT_TRUE(holds(text, "error: runs r02, r05: ", "{column: contraction_ratio, unit: 1, factor: -1}"));
  auto data = scaled(-1.0);
  read_from(data, {"rope", "mm", 412.5, 2.0});
  EXPECT_TRUE(holds(says(data), "{column: rope, unit: mm, zero: 412.5, factor: -2}"));
}

TEST(Sanity, AnotherUnitWithTheOtherSignIsSaidAsBoth) {
  EXPECT_TRUE(holds(says(scaled(-300.0)),
                    "its sign is the other one, and this looks like millimetres (mm), not a ratio; write "
                    "columns: {contraction: {column: contraction_ratio, unit: mm, factor: -1}}"));
}

TEST(Sanity, AZeroIsSeenWhereTheLoadIsTooHeavyToBeLifted) {
  plant::Rig weaker;
  weaker.muscle.rest_radius_m *= std::sqrt(0.8);
  auto data = measured_on(weaker, {36.0, 45.0});
  read_from(data, {"laser", "mm", 263.7, -1.0});
  EXPECT_EQ(said(data), std::vector<std::string>{});
  for (domain::Run& run : data.runs)
    for (double& ratio : run.judged().values) ratio += 0.06;
  EXPECT_TRUE(holds(says(data), "all runs: contraction begins 0.0596 more than", "zero: 245.8, factor: -1}"));
}

TEST(Sanity, ContractionsBeyondBraidAndModelAreAskedAbout) {
  EXPECT_TRUE(holds(says(scaled(1.4)), ": contraction reaches 0.", ", and this rig 0.", "rest_length"));
}

TEST(Sanity, SingleReadingsAreLookedAtWithoutAFit) {
  auto data = sound();
  data.runs[1].judged().values[200] += 0.05;
  EXPECT_EQ(says(data),
            "measured/dataset.yaml: warning: run r02: 1 outlier in contraction_ratio, at 2.400 s");
  data.runs.resize(2);
  const auto findings = look(data).findings;
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[1].severity, data::Severity::undecidable) << findings[1].message;
}

TEST(Sanity, ExchangedColumnsAreSaid) {
  auto data = sound();
  for (domain::Run& run : data.runs) {
    auto bar = run.find("muscle_pressure")->values;
    for (std::size_t k = 0; k < bar.size(); ++k) {
      bar[k] /= 1e5;
      (run.find("muscle_pressure")->values)[k] = run.current_mA[k] * 1e5;
    }
    run.current_mA = bar;
  }
  EXPECT_TRUE(holds(says(data),
                    "look exchanged; write columns: {current: {column: muscle_pressure_bar, unit: mA}, "
                    "muscle_pressure: {column: current_mA, unit: bar}}"));
}

// Of a small muscle, whose whole stroke is few counts of the thesis's encoder.
TEST(Sanity, AReadingThatFreezesOnItsWayToTheEndIsFound) {
  std::vector<double> model, read;
  for (int k = 0; k < 500; ++k) model.push_back(0.05 - 0.05 * std::cos(0.05 * k));
  read = model;
  std::fill(read.begin() + 220, read.end(), read[220]);
  const auto found = data::stills(read, model, 6.5e-4, 0.01);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].why, data::Still::Why::stuck);
  EXPECT_EQ(found[0].end, 500u);
  EXPECT_TRUE(data::stills(model, model, 6.5e-4, 0.01).empty());
}

}  // namespace
}  // namespace mckibben::run
