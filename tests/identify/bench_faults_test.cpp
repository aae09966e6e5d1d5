// What a bench had wrong, in small data sets whose answer is known.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <sim/diagnose/experiment.hpp>
#include <sim/domain/number.hpp>
#include <sim/identify/diagnosis.hpp>

#include "diagnose/bench.hpp"
#include "diagnose/planted.hpp"
#include "identify/handed_over.hpp"
#include "says.hpp"

namespace mckibben::identify {
namespace {

TEST(HandedOver, AFaultOfTheBenchFirstWithTheLinesThatMendIt) {
  domain::Dataset data = diagnose::small(with_a_leak());
  for (domain::Run& run : data.runs) run.load_kg += 1.0;  // a hook that was weighed twice
  const Diagnosis found = handed_over(data);
  ASSERT_EQ(found.bench.size(), 1U) << found.because;
  const diagnose::BenchFault& label = found.bench[0];
  EXPECT_EQ(label.name, "load_label");
  EXPECT_EQ(label.runs.size(), 6U);
  EXPECT_EQ(label.size.unit, "kg");
  EXPECT_TRUE(surrounds(label.size, -1.0));
  EXPECT_TRUE(found.because.starts_with("All loads are ")) << found.because;
  EXPECT_TRUE(holds(found.because, "kg less than written", "Missing: muscle_leak"));
  EXPECT_TRUE(holds(label.write, "r01, r02: load: 11.1", "; r05, r06: load: 23.")) << label.write;
  ASSERT_EQ(found.effects.size(), 1U);
  EXPECT_TRUE(surrounds(found.effects[0].parameters[0], 2e-10));
  EXPECT_LT(found.gap.corrected_rmse, 1.3 * found.gap.noise_floor);
  EXPECT_GT(found.gap.nominal_rmse, 3.0 * found.gap.corrected_rmse);  // without the leak
}

TEST(HandedOver, LoadsOfALeverThatWereAllWrittenTooHeavy) {
  plant::Rig rig;
  rig.mechanics = plant::Lever{};
  rig.joint.lowest_rad = 0.0, rig.joint.highest_rad = 100.0 * plant::degree_rad;
  auto currents = diagnose::three_kinds();
  currents.pop_back();
  domain::Dataset data = diagnose::planted(rig, {2.0, 4.0, 7.0}, currents, 7, rig);
  for (domain::Run& run : data.runs) run.load_kg += 1.0;
  const Diagnosis found = handed_over(data);
  ASSERT_EQ(found.bench.size(), 1U) << found.because;
  EXPECT_EQ(found.bench[0].name, "load_label");
  EXPECT_NEAR(found.bench[0].size.value, -1.0, 0.02);
  EXPECT_TRUE(found.effects.empty());
  EXPECT_LT(found.gap.corrected_rmse, 1.3 * found.gap.noise_floor);
}

TEST(HandedOver, WhichRunHasAnotherLoadAndWhichItIs) {
  domain::Dataset data = diagnose::small({});
  data.runs[2].load_kg += 2.0;
  const Diagnosis found = handed_over(data);
  ASSERT_FALSE(found.bench.empty()) << found.because;
  const diagnose::BenchFault& load = found.bench[0];
  EXPECT_EQ(load.name, "loads_differ");
  EXPECT_EQ(load.runs, std::vector<std::string>{"r03"});
  EXPECT_NEAR(load.size.value, -2.0, 0.3);
  EXPECT_TRUE(load.write.starts_with("load: 16.1")) << load.write;
  EXPECT_TRUE(found.effects.empty());
  EXPECT_EQ(found.verdict, Verdict::nothing_missing) << found.because;  // of the rig
  EXPECT_TRUE(found.because.starts_with("The load of run r03 is ")) << found.because;
  EXPECT_TRUE(holds(found.because, "kg less than written (in the data set: load: 16.1", "Apart from that"));
}

// Loads that were simulated coarsely left what a factor of all loads then explained.
TEST(HandedOver, TwoFaultsOfTheBenchAndNoThird) {
  domain::Dataset data = diagnose::small({});
  data.runs[4].load_kg += 2.0;
  data.runs[5].load_kg += 2.0;
  for (double& ratio : data.runs[0].readings[0].values) ratio += 0.005;
  const Diagnosis found = handed_over(data);
  ASSERT_EQ(found.bench.size(), 3U) << found.because;
  for (const diagnose::BenchFault& fault : found.bench)
    EXPECT_TRUE(surrounds(fault.size, fault.name == "zeros_differ" ? 0.005 : -2.0)) << fault.words;
  EXPECT_TRUE(found.effects.empty());
}

// A wide error predicts unseen runs as well without it, and as none of them has the fault.
TEST(HandedOver, ASmallZeroOfOneRunWhereTheSupplyRipples) {
  plant::Noise rippled = diagnose::still_air;
  rippled.ripple_Pa = 400.0;
  domain::Dataset data = diagnose::small({}, 4.0, rippled);
  for (double& ratio : data.runs[2].readings[0].values) ratio += 0.0017;
  const Diagnosis found = handed_over(data);
  ASSERT_EQ(found.bench.size(), 1U) << found.because;
  EXPECT_EQ(found.bench[0].name, "zeros_differ");
  EXPECT_EQ(found.bench[0].runs, std::vector<std::string>{"r03"});
  EXPECT_EQ(found.verdict, Verdict::nothing_missing) << found.because;
}

// One recorder has the encoder and the gauge: taken for the encoder's alone, the gauge forbade a delay.
TEST(HandedOver, ARunWhoseReadingsAreAllLate) {
  plant::Rig truth;
  truth.sensors.put({.signal = plant::Sensed::muscle_pressure, .kind = plant::SensorKind::gauge});
  domain::Dataset data = diagnose::small(truth);
  for (domain::Reading& reading : data.runs[4].readings) {
    const auto from = reading.values.end() - 2;
    std::move_backward(reading.values.begin(), from, reading.values.end());
  }
  const Diagnosis found = handed_over(data);
  ASSERT_EQ(found.bench.size(), 1U) << found.because;
  EXPECT_EQ(found.bench[0].name, "delays_differ");
  EXPECT_EQ(found.bench[0].runs, std::vector<std::string>{"r05"});
  EXPECT_NEAR(found.bench[0].size.value, 0.024, 0.001);
  EXPECT_TRUE(holds(found.bench[0].write, "contraction: {", "muscle_pressure: {", "late: "));
  EXPECT_EQ(found.verdict, Verdict::nothing_missing) << found.because;
}

// What a model of which all loads may differ had left to each of them was in no file: 0.3 mm in all runs.
TEST(HandedOver, ARigThatMeetsTheDataWithTheLoadsAsTheyAreReported) {
  domain::Dataset data = diagnose::small(with_a_leak());
  data.runs[2].load_kg += 2.0;
  data.runs[3].load_kg += 2.0;
  const Diagnosis found = handed_over(data);
  ASSERT_EQ(found.bench.size(), 2U) << found.because;
  for (const diagnose::BenchFault& fault : found.bench)
    for (domain::Run& run : data.runs)
      if (run.id == fault.runs.front()) run.load_kg = fault.loads_kg.front();
  const std::vector<std::vector<bool>> masked(data.runs.size(),
                                              std::vector<bool>(data.runs.front().rows(), false));
  const diagnose::Experiment mended(data, masked, 2);
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const Eigen::VectorXd off =
        mended.residuals(mended.readings(found.corrected, {run}).front(), run);  // in floors
    EXPECT_LT(std::abs(off.mean()), 0.5) << data.runs[run].id;
    EXPECT_LT(std::sqrt(off.squaredNorm() / static_cast<double>(off.size())), 1.5) << data.runs[run].id;
  }
}

// They had come to their loads each by itself, as far as only one deviated from all others by 0.7 g.
TEST(HandedOver, LoadsThatAreAllInPoundsAreOffInEveryRun) {
  domain::Dataset data = diagnose::small({});
  const double was_kg = data.runs[0].load_kg;
  for (domain::Run& run : data.runs) run.load_kg *= domain::pound_kg;
  const Diagnosis found = handed_over(data);
  ASSERT_FALSE(found.bench.empty()) << found.because;
  const diagnose::BenchFault& loads = found.bench[0];
  EXPECT_EQ(loads.runs.size(), data.runs.size()) << found.because;
  const std::size_t at = loads.write.find("load: ");
  ASSERT_NE(at, std::string::npos) << loads.write;
  EXPECT_NEAR(std::stod(loads.write.substr(at + 6)), was_kg, 0.05 * was_kg) << loads.write;
}

TEST(HandedOver, ALoadThatIsFarOffWithAnIntervalThatHoldsIt) {
  domain::Dataset data = diagnose::small({});
  data.runs[0].load_kg += 10.0;
  const Settings settings{.threads = 2};
  const Diagnosis found =
      diagnosis_of(identify(data, settings), settings,
                   {.of_loads = {{{"r01"}, "a guess of this load"}, {{"r02"}, "a doubt of another"}}});
  ASSERT_EQ(found.bench.size(), 1U) << found.because;
  EXPECT_EQ(found.bench[0].runs, std::vector<std::string>{"r01"});
  EXPECT_TRUE(surrounds(found.bench[0].size, -10.0));
  EXPECT_LT(found.bench[0].size.high - found.bench[0].size.low, 0.1);
  EXPECT_EQ(std::ranges::count(found.warnings, "a guess of this load"), 0);
  EXPECT_EQ(std::ranges::count(found.warnings, "a doubt of another"), 1);
}

TEST(HandedOver, LabelsThatWereExchangedAsSuch) {
  domain::Dataset data = diagnose::small({});
  std::swap(data.runs[0].load_kg, data.runs[2].load_kg);
  const Diagnosis found = handed_over(data);
  ASSERT_EQ(found.bench.size(), 2U) << found.because;
  EXPECT_EQ(found.bench[0].write, "load: 11.138 kg");
  EXPECT_EQ(found.bench[1].write, "load: 16.138 kg");
  EXPECT_TRUE(found.bench[0].words.ends_with("as if its label were exchanged with that of run r03"));
}

// 12 kg are far: no effect may make up for what the fit left on its way.
TEST(HandedOver, LabelsThatWereExchangedFarApartAloneAndWithTheirLoads) {
  domain::Dataset data = diagnose::small({});
  std::swap(data.runs[0].load_kg, data.runs[5].load_kg);
  const Diagnosis found = handed_over(data);
  EXPECT_EQ(found.verdict, diagnose::Verdict::nothing_missing) << found.because;
  ASSERT_EQ(found.bench.size(), 2U) << found.because;
  EXPECT_EQ(found.bench[0].write, "load: 11.138 kg");
  EXPECT_EQ(found.runs[0].estimated_load_kg, 11.138);
  EXPECT_EQ(found.runs[5].estimated_load_kg, 23.406);
  EXPECT_FALSE(found.runs[1].estimated_load_kg);
}

// Another muscle would be as good for the factor; the one label that is off besides is wrong with any.
TEST(HandedOver, LoadsThatAreOffByAFactorAndOneBesides) {
  domain::Dataset data = diagnose::small({});
  const double true_kg = data.runs[0].load_kg;
  for (domain::Run& run : data.runs) run.load_kg *= 1.25;
  data.runs[0].load_kg += 4.0;
  const Diagnosis found = handed_over(data);
  ASSERT_EQ(found.bench.size(), 2U) << found.because;
  EXPECT_EQ(found.bench[0].runs, std::vector{data.runs[0].id});
  EXPECT_NEAR(found.bench[0].loads_kg.front(), true_kg, 0.05 * true_kg);
  EXPECT_TRUE(found.bench[1].words.starts_with("the loads of all other runs are less")) << found.because;
  EXPECT_EQ(found.bench[1].runs.size(), data.runs.size() - 1);
}

TEST(HandedOver, TheLengthOfOneRunOfAMuscleThatIsHeld) {
  constexpr double off_m = 8e-3;
  domain::Dataset data = diagnose::on_a_bench({}, 0.5);
  domain::Run& other = data.runs[2];
  for (double& ratio : other.measured->give("contraction")) ratio -= off_m / other.rest_length_m;
  const Diagnosis found = handed_over(data);
  ASSERT_EQ(found.bench.size(), 1U) << found.because;
  EXPECT_EQ(found.bench[0].name, "lengths_differ");
  EXPECT_EQ(found.bench[0].runs, std::vector{other.id});
  EXPECT_TRUE(surrounds(found.bench[0].size, off_m));
  EXPECT_TRUE(holds(found.bench[0].words, "r3", "mm shorter than written")) << found.bench[0].words;
  EXPECT_TRUE(holds(found.bench[0].write, "contraction: {", "zero: -0.02")) << found.bench[0].write;
  EXPECT_TRUE(found.effects.empty()) << found.because;
}

TEST(HandedOver, TheZeroOfTheLoadCellOfAMuscleThatIsHeld) {
  domain::Dataset data = diagnose::on_a_bench({}, 0.5);
  for (domain::Run& run : data.runs)
    for (double& force_N : run.judged().values) force_N += 6.0;
  const Diagnosis found = handed_over(data);
  ASSERT_EQ(found.bench.size(), 1U) << found.because;
  EXPECT_EQ(found.bench[0].name, "reading_zero");
  EXPECT_TRUE(surrounds(found.bench[0].size, 6.0));
  EXPECT_TRUE(holds(found.bench[0].write, "force: {", "zero: 5.9")) << found.bench[0].write;
  EXPECT_TRUE(found.effects.empty()) << found.because;
}

}  // namespace
}  // namespace mckibben::identify
