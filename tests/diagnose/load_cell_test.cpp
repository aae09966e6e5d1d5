// A force that was read beside the contraction: what it is, what it weighs, and forces that are none.
#include "load_cell.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <sim/data/finding.hpp>
#include <sim/diagnose/check.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/remarks.hpp>
#include <sim/run/replay.hpp>

namespace mckibben::diagnose {
namespace {

using domain::Beside;

const Runs every_run{0, 1, 2, 3, 4, 5};

/// The words that the data are refused with; empty if they are not.
std::string refusal(domain::Dataset data) {
  try {
    check(data::with_rows(std::move(data)), 2);
  } catch (const data::UnfitData& unfit) {
    return unfit.what();
  }
  return "";
}

domain::Dataset forces_times(double factor) {
  domain::Dataset data = with_a_cell({});
  for (domain::Run& run : data.runs)
    for (double& force_N : run.measured->take("force")) force_N *= factor;
  return data;
}

TEST(LoadCell, EachReadingWeighsByItsOwnFloor) {
  const domain::Dataset data = data::with_rows(with_a_cell({}));
  EXPECT_EQ(data.judged(), domain::Judged::contraction);
  const Checked checked = check(data, 2);
  EXPECT_TRUE(checked.warnings.empty()) << checked.warnings.front();
  const Experiment experiment(data, checked.masked, 2, every_run);
  EXPECT_NEAR(experiment.floor().force_N, 2.0, 0.3);
  EXPECT_EQ(experiment.rows(0), 2 * rows_with_a_cell);
  const auto residuals = experiment.residuals(data.rig, every_run);
  EXPECT_NEAR(*experiment.rmse(Beside::force, residuals, every_run), 2.0, 0.2);
  EXPECT_FALSE(experiment.rmse(Beside::muscle_pressure, residuals, every_run));
  EXPECT_NEAR(experiment.rmse(residuals, every_run), experiment.floor().judged, 1e-5);
  const double all = residuals.squaredNorm() / static_cast<double>(6 * rows_with_a_cell);
  EXPECT_GT(all, 1.4);  // one of each reading, or a little less
  EXPECT_LT(all, 2.1);
}

TEST(ValveGauge, WeighsByItsOwnFloor) {
  constexpr double noise_Pa = 900.0;
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  domain::Dataset data;
  data.own_clock = true;
  domain::Run& run = data.runs.emplace_back();
  run.id = "r1";
  run.load_kg = 12.0;
  domain::Measurement& measured = run.measured.emplace();
  for (int k = 0; k < 640; ++k) {
    measured.time_s.push_back(0.012 * k);
    measured.give("command").push_back(12.0 + 4.0 * std::sin(0.02 * k));
  }
  run.valve_pressure_Pa.emplace();  // says that a gauge is there
  const Loaded hanging{data.rig, run.load_kg};
  auto readings = predict(run, {&hanging, 1}).front();
  run.valve_pressure_Pa.reset();
  for (double& read_Pa : readings.valve_pressure_Pa) read_Pa += noise_Pa * normal(random);
  measured.take("contraction") = std::move(readings.judged);
  measured.take("valve_pressure") = std::move(readings.valve_pressure_Pa);
  data = data::with_rows(std::move(data));
  const Experiment experiment(data, {std::vector<bool>(640, false)}, 1, {0});
  EXPECT_NEAR(experiment.floor().valve_Pa, noise_Pa, 0.25 * noise_Pa);
  EXPECT_EQ(experiment.floor().pressure_Pa, 0.0);
  EXPECT_EQ(experiment.rows(0), 1280u);
  const auto residuals = experiment.residuals(data.rig, {0});
  EXPECT_NEAR(*experiment.rmse(Beside::valve_pressure, residuals, {0}), noise_Pa, 0.25 * noise_Pa);
}

/// How much more the cord carries on the way up than on the way down, on average, over the weight.
double more_on_the_way_up(double guide_friction) {
  plant::Rig rubbing;
  rubbing.effects.get<plant::GuideFriction>().coefficient = guide_friction;
  const domain::Dataset data = data::with_rows(with_a_cell(rubbing, {0.0, 0.0}));
  const domain::Run& run = data.runs[0];
  double up_N = 0.0, down_N = 0.0, up = 0.0, down = 0.0;
  for (std::size_t k = 1; k + 1 < run.force_N.size(); ++k) {
    const double rise = run.contraction_ratio[k + 1] - run.contraction_ratio[k - 1];
    if (std::abs(rise) < 1e-3) continue;
    (rise > 0.0 ? up_N : down_N) += run.force_N[k];
    (rise > 0.0 ? up : down) += 1.0;
  }
  return (up_N / up - down_N / down) / (plant::gravity_m_per_s2 * run.load_kg);
}

TEST(LoadCell, FeelsThatTheGuideHoldsTheLoad) {
  // The guide takes 0.05 m g either way, and the muscle pulls that much more or less.
  EXPECT_NEAR(more_on_the_way_up(0.05) - more_on_the_way_up(0.0), 0.1, 0.02);
}

TEST(LoadCell, ThatIsIgnoredIsNamed) {
  domain::Dataset data = data::with_rows(with_a_cell({}));
  EXPECT_TRUE(
      ignored_in_words(data).starts_with("force_N is ignored: no model meets both it and the motion"));
  data.runs[2].muscle_pressure_Pa.emplace();
  const std::string words = ignored_in_words(data);
  EXPECT_TRUE(words.starts_with("muscle_pressure_bar and force_N are ignored: no model meets both them"))
      << words;
  EXPECT_NE(words.find("has the gauge or the load cell an offset"), std::string::npos) << words;
}

TEST(LoadCell, AReadingThatIsMissingCostsNoOther) {
  domain::Dataset data = with_a_cell({});
  for (domain::Run& run : data.runs)
    for (std::size_t k = 0; k < rows_with_a_cell; ++k)
      if (k % 10 != 0) run.measured->take("force")[k] = std::nan("");
  data = data::with_rows(std::move(data));
  const Checked checked = check(data, 2);
  EXPECT_TRUE(checked.left_out.empty());
  EXPECT_EQ(std::ranges::count(checked.masked[0], true), 0);
  const Experiment experiment(data, checked.masked, 2, every_run);
  const auto residuals = experiment.residuals(data.rig, every_run);
  EXPECT_EQ((residuals.segment(rows_with_a_cell, rows_with_a_cell).array() != 0.0).count(), 16);
  EXPECT_NEAR(*experiment.rmse(Beside::force, residuals, every_run), 2.0, 0.4);
}

TEST(LoadCell, BesideCountsOfAnEncoderHasAFloorToo) {
  domain::Dataset data = with_a_cell({});
  const double count = data::reading_per_count(data.rig);
  for (domain::Run& run : data.runs) {
    run.measured->counted = true;
    for (double& ratio : run.measured->take("contraction")) ratio = count * std::floor(ratio / count);
  }
  data = data::with_rows(std::move(data));
  const Experiment experiment(data, check(data, 2).masked, 2, every_run);
  EXPECT_GT(experiment.floor().count, 0.0);
  EXPECT_NEAR(experiment.floor().force_N, 2.0, 0.3);
}

TEST(LoadCell, ForcesInAnotherUnitOrOfAnotherSignAreRefused) {
  EXPECT_EQ(refusal(forces_times(1.0)), "");
  EXPECT_NE(refusal(forces_times(1e-3)).find("kN"), std::string::npos);
  EXPECT_NE(refusal(forces_times(1.0 / plant::gravity_m_per_s2)).find("kg"), std::string::npos);
  EXPECT_NE(refusal(forces_times(-1.0)).find("factor: -1"), std::string::npos);
}

}  // namespace
}  // namespace mckibben::diagnose
