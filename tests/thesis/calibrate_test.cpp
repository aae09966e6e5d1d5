// A small campaign on the simulated rig, calibrated from end to end; figures; data that cannot be calibrated.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <plant/geometry.hpp>
#include <sim/data/finding.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/output/calibration_report.hpp>
#include <sim/thesis/calibrate.hpp>
#include <sim/thesis/figures.hpp>
#include <sim/thesis/quality.hpp>

#include "scratch.hpp"
#include "small_campaign.hpp"

namespace mckibben::thesis {
namespace {

const domain::Dataset& campaign() {
  static const domain::Dataset dataset = small_campaign();
  return dataset;
}

const CalibrationResult& calibrated() {
  static const CalibrationResult result = calibrate(campaign(), {});
  return result;
}

TEST(Calibrate, DescribesTheRigOverAllLoadsAndSpeeds) {
  for (const Direction direction : directions) {
    const PressureFit& fit = calibrated().pressure_of(direction);
    EXPECT_LT(fit.deviation.joint, 0.15 * fit.mean_Pa) << name_of(direction);
    EXPECT_LE(fit.deviation.own, fit.deviation.fixed * (1.0 + 1e-9));
    EXPECT_LE(fit.deviation.fixed, fit.deviation.in_speed * (1.0 + 1e-9));
    EXPECT_GT(calibrated().friction_of(direction).mean, 0.0);
  }
  EXPECT_EQ(calibrated().grid.loads_kg.size(), 5u);
  EXPECT_EQ(calibrated().grid.speeds_mA_per_s.size(), 4u);
}

TEST(Calibrate, WithTheTruePressureFindsTheTrueFriction) {
  Options options;
  options.processing.pressure = PressureSource::gauge;
  const FrictionFit fit = calibrate(campaign(), options).friction_of(Direction::contraction);
  const plant::Friction truth;  // per cent
  EXPECT_NEAR(fit.f0.value, 0.01 * truth.f0, 0.1 * 0.01 * truth.f0);
  EXPECT_NEAR(fit.f2.value, 0.01 * truth.f2, 0.1 * std::abs(0.01 * truth.f2));
  // From the current alone, the lag of valve and hose looks like
  // friction that grows with the current's speed.
  const FrictionFit& from_current = calibrated().friction_of(Direction::contraction);
  EXPECT_GT(from_current.mean, 1.2 * fit.mean);
  EXPECT_GT(from_current.f1.value, 10.0 * std::abs(fit.f1.value));
}

TEST(Calibrate, TheFileReadsBackToTheSameModels) {
  const Scratch folder;
  const auto path = folder.write("calibration.yaml", input::calibration_yaml(calibrated().calibration));
  std::vector<domain::InputFile> inputs;
  const controllers::Calibration read = input::read_calibration(path, inputs);
  EXPECT_EQ(input::to_json(read), input::to_json(calibrated().calibration));
  EXPECT_EQ(inputs.size(), 1u);
  EXPECT_EQ(read.contraction.a1_0.size(), 4u);
  EXPECT_EQ(read.relaxation.b4_0.size(), 2u);
  EXPECT_EQ(read.range.lowest_load_kg, 11.138);
}

TEST(Calibrate, TheThesissSequenceIsThereToBeChosen) {
  Options options;
  options.fitting = PressureFitting::sequence;
  const CalibrationResult result = calibrate(campaign(), options);
  EXPECT_EQ(result.calibration.contraction.a0,
            contraction_model(result.pressure_of(Direction::contraction).sequence).a0);
  EXPECT_NE(result.calibration.contraction.a0, calibrated().calibration.contraction.a0);
}

TEST(Calibrate, WhatIsNotDeterminedIsNamedAndNotPrinted) {
  CalibrationResult result = calibrated();
  Estimate& f1 = result.friction[0].f1;
  f1 = {0.0123456, 0.02, 5.0, {}};
  judge(f1);
  const std::string report = output::report_of(campaign(), result, {}, false);
  EXPECT_NE(report.find("f1  not determined: not significant"), std::string::npos);
  EXPECT_EQ(report.find("0.0123456"), std::string::npos);
  const auto document = input::Json::parse(output::json_of(campaign(), result, {}));
  const auto& entry = document.at("friction").at("contraction").at("f1_s2_per_mA2");
  EXPECT_TRUE(entry.at("value").is_null());
  EXPECT_EQ(entry.at("not_determined"), "not significant");
}

TEST(Figures, AreAllThereWithEqualColumns) {
  const auto all = figures(calibrated(), false);
  ASSERT_EQ(all.size(), 48u);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Figure& figure = all[i];
    EXPECT_EQ(figure.number, fmt::format("4.{}", i + 2));
    ASSERT_GE(figure.columns.size(), 3u - (figure.curves.size() == 1 ? 1u : 0u)) << figure.number;
    for (const Column& column : figure.columns) {
      EXPECT_EQ(column.values.size(), figure.columns[0].values.size()) << figure.number;
      EXPECT_LE(column.values.size(), most_dots);
      EXPECT_GE(column.values.size(), 4u);
      for (const double value : column.values)
        EXPECT_TRUE(std::isfinite(value)) << figure.number << column.name;
    }
    for (const Curved& curve : figure.curves) {
      EXPECT_LT(curve.x, figure.columns.size());
      EXPECT_LT(curve.y, figure.columns.size());
    }
    const std::string svg = output::chart_svg(figure), csv = output::csv_of(figure);
    EXPECT_NE(svg.find("Figure " + figure.number), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(csv.rfind(figure.columns[0].name + ",", 0), 0u);
  }
  EXPECT_EQ(all[0].file_name(), "figure_4_02");
  EXPECT_EQ(all[47].file_name(), "figure_4_49");
}

TEST(Figures, ShowTheThesissSpeedsOrTheNearest) {
  const auto all = figures(calibrated(), false);
  EXPECT_NE(all[4].title.find("16.7 mA/s"), std::string::npos);
  EXPECT_NE(all[0].title.find("6.7 mA/s"), std::string::npos);  // slowest of the small campaign
}

TEST(Figures, InKgfAreTheSamePressures) {
  const auto pascal = figures(calibrated(), false), kgf = figures(calibrated(), true);
  const Figure &a0 = pascal[33], &a0_kgf = kgf[33], &a3_kgf = kgf[38];
  ASSERT_EQ(a0.number, "4.35");
  EXPECT_EQ(a0.columns[1].name, "a0_Pa");
  EXPECT_EQ(a0_kgf.columns[1].name, "a0_kgf_per_m2");
  EXPECT_NEAR(a0.columns[1].values[0] / a0_kgf.columns[1].values[0], 9.80665, 1e-9);
  EXPECT_EQ(a3_kgf.columns[1].values, pascal[38].columns[1].values);  // an exponent has no unit
}

/// What is said about data that cannot be calibrated.
std::string refusal(const domain::Dataset& dataset, const Options& options = {}) {
  try {
    calibrate(dataset, options);
  } catch (const data::UnfitData& unfit) {
    return unfit.what();
  }
  return "accepted";
}

plant::Rig with_a_tube() {
  plant::Rig rig;
  auto& tube = rig.effects.get<plant::BladderElasticity>();
  tube.variant = plant::BladderLaw::saturating;
  tube.force_N = 80.0;
  tube.ratio = 0.02;
  return rig;
}

TEST(Calibrate, CountsTheTubesPullAndHandsItOn) {
  const domain::Dataset data = small_campaign({11.138, 16.138, 23.406}, {2.4, 4.8}, with_a_tube());
  Options options;
  options.orders = {.speed = 1, .load = 2};
  options.processing.pressure = PressureSource::gauge;
  const CalibrationResult found = calibrate(data, options);
  const plant::Friction truth;  // per cent
  EXPECT_NEAR(found.friction_of(Direction::contraction).f0.value, 0.01 * truth.f0, 0.1 * 0.01 * truth.f0);
  ASSERT_TRUE(found.calibration.tube_pull);
  EXPECT_NEAR(found.calibration.tube_pull->pull_N(0.1, 0.3), 80.0 * (1.0 - std::exp(-5.0)), 1e-9);
  EXPECT_NE(input::calibration_yaml(found.calibration).find("tube_pull"), std::string::npos);
  EXPECT_FALSE(calibrated().calibration.tube_pull);
}

TEST(Calibrate, NamesTheEffectsThatItsForceBalanceCannotCount) {
  domain::Dataset data = campaign();
  data.rig.effects.get<plant::EndCapCorrection>().slope = 0.05;
  EXPECT_NE(
      refusal(data).find("the rig has end_cap_correction, and the thesis's models know no muscle with it"),
      std::string::npos)
      << refusal(data);
}

testing::AssertionResult says(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << part << "\" is not in: " << text;
}

TEST(BadData, TooFewLoadsForTheOrdersSayHowMany) {
  domain::Dataset dataset = campaign();
  std::erase_if(dataset.runs, [](const auto& run) { return run.load_kg > 17.0; });
  const std::string text = refusal(dataset);
  EXPECT_TRUE(says(text, "small/dataset.yaml"));
  EXPECT_TRUE(says(text,
                   "calibrate needs 4 loads and, with each, 3 speeds of the current. There are 3 loads "
                   "(11.138, 13.87, 16.138 kg). Measure more loads, or set --load-order 2"));
  Options options;
  options.orders.load = 2;
  EXPECT_EQ(refusal(dataset, options), "accepted");
}

TEST(BadData, TooFewSpeedsForTheOrdersSayHowMany) {
  domain::Dataset dataset = campaign();
  std::erase_if(dataset.runs,
                [](const auto& run) { return run.load_kg > 20.0 && run.current_mA.size() < 1200; });
  const std::string text = refusal(dataset);
  EXPECT_TRUE(says(text,
                   "There are 5 loads (11.138, 13.87, 16.138, 18.87, 23.406 kg); too few speeds with "
                   "23.406 kg (6.6667, 8.3333 mA/s). Measure sines or triangles of more periods, or set "
                   "--speed-order 1"))
      << text;
  std::erase_if(dataset.runs, [](const auto& run) { return run.load_kg < 15.0; });
  EXPECT_TRUE(says(refusal(dataset),
                   "Measure more loads and sines or triangles of more periods, or set --load-order 2 "
                   "--speed-order 1"))
      << "all that is needed, at once";
}

TEST(BadData, NoMotionIsSaid) {
  domain::Dataset dataset = small_campaign({11.138}, {3.6});
  for (double& ratio : dataset.runs[0].judged().values) ratio = 0.0;
  EXPECT_TRUE(says(refusal(dataset), "the muscle hardly moves"));
}

// Were the heavier loads counted as too few, the advice would be to measure more of what does not move.
TEST(BadData, WhereNothingMovesThatLeads) {
  domain::Dataset dataset = campaign();
  for (auto& run : dataset.runs) {
    if (run.load_kg < 15.0) continue;
    for (double& ratio : run.judged().values) ratio = 0.0;
    for (double& current : run.current_mA) current *= 0.4;
  }
  const std::string text = refusal(dataset);
  EXPECT_TRUE(says(text, "dataset.yaml: error: nothing moves enough in 12 runs, the first is m16138_2400"));
  EXPECT_TRUE(says(text, "by 0 counts in all, with currents from 0 to 8 mA"));
  EXPECT_TRUE(says(text, "What helps: a larger current, up to the valve's 20 mA"));
  EXPECT_TRUE(
      says(text, "Without these runs, calibrate needs 4 loads and, with each, 3 speeds of the current"));
  EXPECT_FALSE(says(text, "Measure more loads"));
  EXPECT_TRUE(says(text, "Or set --load-order 1"));
}

TEST(BadData, WithTheWholeCurrentALighterLoadHelps) {
  domain::Dataset dataset = small_campaign({11.138}, {3.6});
  for (double& ratio : dataset.runs[0].judged().values) ratio = 0.0;
  const std::string text = refusal(dataset);
  EXPECT_TRUE(says(text, "no run can be used for calibration: nothing moves enough in 1 run"));
  EXPECT_TRUE(says(text, "lighter loads"));
}

TEST(BadData, NearlyEqualLoadsAreOne) {
  domain::Dataset dataset = campaign();
  for (auto& run : dataset.runs)
    if (run.load_kg == 13.870) run.load_kg = 11.138 * (1.0 + 1e-6);
  EXPECT_EQ(make_grid(dataset, {}).loads_kg.size(), 4u);
  EXPECT_EQ(make_grid(dataset, {}).merged_loads, 1u);
  std::erase_if(dataset.runs, [](const auto& run) { return run.load_kg > 20.0; });
  const std::string text = refusal(dataset);
  EXPECT_TRUE(says(text, "There are 3 loads ("));
  EXPECT_TRUE(says(text, "loads within 0.1 % of each other are one"));
}

// A swing may carry the muscle a little beyond e_max, where the braid pulls no more.
TEST(BadData, RowsALittleAboveTheLimitAreDroppedAndCounted) {
  domain::Dataset dataset = campaign();
  const auto before = calibrate(dataset, {}).grid.dropped;
  EXPECT_EQ(before.beyond_limit, 0u);
  const double limit = plant::Braid(dataset.rig.muscle).largest_contraction_ratio();
  const double per_count = run::contraction_per_count(dataset.rig);
  auto& ratios = dataset.runs[0].judged().values;
  const auto highest = std::max_element(ratios.begin() + 150, ratios.end()) - ratios.begin();
  for (auto k = highest - 12; k < highest; ++k)
    ratios[static_cast<std::size_t>(k)] = per_count * std::ceil(1.01 * limit / per_count);
  const auto result = calibrate(dataset, {});
  EXPECT_GT(result.grid.dropped.beyond_limit, 5u);
  EXPECT_TRUE(says(output::report_of(dataset, result, {}, false),
                   fmt::format("{} with a contraction ratio above e_max", result.grid.dropped.beyond_limit)));
  EXPECT_LT(result.calibration.range.highest_ratio, limit);
}

TEST(Report, SaysWhatASpreadMeans) {
  const auto meaning = [](Quality::Model model, double spread) {
    return Quality{model, Direction::contraction, spread}.meaning();
  };
  EXPECT_EQ(meaning(Quality::Model::friction, 0.099), "good, the thesis reports below 10 % (T 5)");
  EXPECT_EQ(meaning(Quality::Model::pressure, 0.149), "good, the thesis reports below 15 % (T 5)");
  EXPECT_TRUE(says(meaning(Quality::Model::friction, 0.325), "rough, the thesis reports below 10 % (T 5)"));
  EXPECT_TRUE(says(meaning(Quality::Model::pressure, 1.0), "rough, "));
  EXPECT_TRUE(says(meaning(Quality::Model::pressure, 1.01), "samples scatter by more than the mean"));
  EXPECT_TRUE(says(meaning(Quality::Model::friction, NAN), "samples scatter by more than the mean"));
  const auto lines = output::meanings_of(calibrated(), {});
  ASSERT_EQ(lines.size(), 4u);
  const std::string report = output::report_of(campaign(), calibrated(), {}, false);
  for (const auto& line : lines) EXPECT_TRUE(says(report, "  " + line + "\n")) << line;
}

TEST(Report, SpreadsAboveTheMeanAreNotPrintedAsNumbersButWarnedOf) {
  EXPECT_EQ(output::spread_text(0.056, 1, " %"), "5.6 %");
  EXPECT_EQ(output::spread_text(1.0, 2), "100.00");
  EXPECT_EQ(output::spread_text(27.16, 1, " %"), "not usable (above 100 %)");
  EXPECT_EQ(output::spread_text(NAN, 1), "not usable (above 100 %)");
  EXPECT_TRUE(output::warnings_of(calibrated(), {}).empty());
  CalibrationResult result = calibrated();
  result.friction[1].standard_deviation = 12.5 * result.friction[1].mean;
  const auto warnings = output::warnings_of(result, {});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(says(warnings[0], "friction in relaxation is not usable"));
  const std::string report = output::report_of(campaign(), result, {}, false);
  EXPECT_TRUE(says(report, "not usable (above 100 %)"));
  EXPECT_TRUE(says(report, "\nwarnings\n  friction in relaxation"));
  EXPECT_FALSE(says(report, "1250"));
  const auto document = input::Json::parse(output::json_of(campaign(), result, {}));
  EXPECT_NEAR(document.at("friction").at("relaxation").at("spread").get<double>(), 12.5, 1e-9);
  EXPECT_EQ(document.at("warnings").size(), 1u);
}

TEST(BadData, AConstantCurrentIsSaid) {
  domain::Dataset dataset = small_campaign({11.138}, {3.6});
  for (double& current : dataset.runs[0].current_mA) current = 12.0;
  EXPECT_TRUE(says(refusal(dataset), "its current hardly changes"));
}

TEST(BadData, ACurrentWithoutASingleSpeedIsSaid) {
  domain::Dataset dataset = small_campaign({11.138}, {3.6});
  domain::Run& run = dataset.runs[0];
  const domain::Run faster = ride(11.138, 2.4);
  run.current_mA.insert(run.current_mA.end(), faster.current_mA.begin(), faster.current_mA.end());
  run.judged().values.insert(run.judged().values.end(), faster.judged().values.begin(),
                             faster.judged().values.end());
  EXPECT_TRUE(says(refusal(dataset), "has no single speed"));
}

TEST(BadData, RunsThatCannotBeUsedAreLeftOutAndNamed) {
  domain::Dataset dataset = campaign();
  for (double& ratio : dataset.runs[3].judged().values) ratio = 0.0;
  const CalibrationResult result = calibrate(dataset, {});
  ASSERT_EQ(result.grid.left_out.size(), 1u);
  EXPECT_EQ(result.grid.left_out[0].id, dataset.runs[3].id);
  EXPECT_TRUE(says(output::report_of(dataset, result, {}, false), result.grid.left_out[0].why));
}

TEST(BadData, AWrongRigIsNoticed) {
  domain::Dataset dataset = campaign();
  dataset.rig.sensors.position().pulses_per_turn = 500;
  EXPECT_TRUE(says(refusal(dataset), "no multiples of this rig's encoder count"));
  dataset = campaign();
  dataset.rig.muscle.end_correction = 1.6;
  EXPECT_TRUE(says(refusal(dataset), "beyond this rig's limit"));
  dataset = campaign();
  dataset.rig.muscle.rest_radius_m = 6e-3;
  EXPECT_TRUE(says(refusal(dataset), "wrong rig or loads?"));
}

TEST(BadData, TheGaugeMustBeThereIfItIsAskedFor) {
  domain::Dataset dataset = campaign();
  dataset.runs[1].readings.pop_back();
  Options options;
  options.processing.pressure = PressureSource::gauge;
  EXPECT_TRUE(says(refusal(dataset, options), "no column muscle_pressure_bar"));
}

}  // namespace
}  // namespace mckibben::thesis
