// A force that was read beside the contraction: what it is, and what it weighs.
#include "load_cell.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <sim/data/amount.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/run/replay.hpp>

#include "planted.hpp"
#include "residuals.hpp"

namespace mckibben::diagnose {
namespace {

const Runs every_run{0, 1, 2, 3, 4, 5};

/// Root mean square of what is left of the second reading of these runs, where it was read.
double rms_beside(const Experiment& experiment, const Eigen::VectorXd& residuals, const Runs& runs) {
  double squares = 0.0;
  Eigen::Index count = 0;
  for (const Experiment::Part& part : experiment.parts(runs)) {
    const domain::Reading& read = experiment.data().runs[part.run].readings.at(1);
    const auto left =
        residuals.segment(part.begin + part.rows, part.rows) * experiment.floor().beside(read.channel);
    squares += left.squaredNorm();
    count += (left.array() != 0.0).count();
  }
  return std::sqrt(squares / static_cast<double>(count));
}

TEST(LoadCell, EachReadingWeighsByItsOwnFloor) {
  const domain::Dataset data = data::with_rows(with_a_cell({}));
  EXPECT_EQ(data.judged(), domain::Judged::contraction);
  const Experiment experiment(data, nothing_masked(data), 2, every_run);
  EXPECT_NEAR(experiment.floor().of_signal.at("force"), 2.0, 0.3);
  EXPECT_EQ(experiment.rows(0), 2 * rows_with_a_cell);
  const auto residuals = residuals_of(experiment, data.rig, every_run);
  EXPECT_NEAR(rms_beside(experiment, residuals, every_run), 2.0, 0.2);
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
  run.read("contraction");
  run.read("valve_pressure");
  const Loaded hanging{data.rig, run.load_kg};
  auto readings = predict(run, {&hanging, 1}).front();
  run.readings.clear();
  for (double& read_Pa : readings.readings[1]) read_Pa += noise_Pa * normal(random);
  measured.take("contraction") = std::move(readings.readings[0]);
  measured.take("valve_pressure") = std::move(readings.readings[1]);
  data = data::with_rows(std::move(data));
  const Experiment experiment(data, {std::vector<bool>(640, false)}, 1, {0});
  EXPECT_NEAR(experiment.floor().of_signal.at("valve_pressure"), noise_Pa, 0.25 * noise_Pa);
  EXPECT_FALSE(experiment.floor().of_signal.contains("muscle_pressure"));
  EXPECT_EQ(experiment.rows(0), 1280u);
  const auto residuals = residuals_of(experiment, data.rig, {0});
  EXPECT_NEAR(rms_beside(experiment, residuals, {0}), noise_Pa, 0.25 * noise_Pa);
}

/// How much more the cord carries on the way up than on the way down, on average, over the weight.
double more_on_the_way_up(double guide_friction) {
  plant::Rig rubbing;
  rubbing.effects.get<plant::GuideFriction>().coefficient = guide_friction;
  const domain::Dataset data = data::with_rows(with_a_cell(rubbing, {0.0, 0.0}));
  const domain::Run& run = data.runs[0];
  double up_N = 0.0, down_N = 0.0, up = 0.0, down = 0.0;
  for (std::size_t k = 1; k + 1 < run.rows(); ++k) {
    const double rise = run.judged().values[k + 1] - run.judged().values[k - 1];
    if (std::abs(rise) < 1e-3) continue;
    (rise > 0.0 ? up_N : down_N) += run.values("force")[k];
    (rise > 0.0 ? up : down) += 1.0;
  }
  return (up_N / up - down_N / down) / (plant::gravity_m_per_s2 * run.load_kg);
}

TEST(LoadCell, FeelsThatTheGuideHoldsTheLoad) {
  // The guide takes 0.05 m g either way, and the muscle pulls that much more or less.
  EXPECT_NEAR(more_on_the_way_up(0.05) - more_on_the_way_up(0.0), 0.1, 0.02);
}

TEST(LoadCell, AReadingThatIsMissingCostsNoOther) {
  domain::Dataset data = with_a_cell({});
  for (domain::Run& run : data.runs)
    for (std::size_t k = 0; k < rows_with_a_cell; ++k)
      if (k % 10 != 0) run.measured->take("force")[k] = std::nan("");
  data = data::with_rows(std::move(data));
  const Experiment experiment(data, nothing_masked(data), 2, every_run);
  const auto residuals = residuals_of(experiment, data.rig, every_run);
  EXPECT_EQ((residuals.segment(rows_with_a_cell, rows_with_a_cell).array() != 0.0).count(), 16);
  EXPECT_NEAR(rms_beside(experiment, residuals, every_run), 2.0, 0.4);
}

TEST(LoadCell, BesideCountsOfAnEncoderHasAFloorToo) {
  domain::Dataset data = with_a_cell({});
  const double count = data::reading_per_count(data.rig);
  for (domain::Run& run : data.runs) {
    run.measured->counted = true;
    for (double& ratio : run.measured->take("contraction")) ratio = count * std::floor(ratio / count);
  }
  data = data::with_rows(std::move(data));
  const Experiment experiment(data, nothing_masked(data), 2, every_run);
  EXPECT_GT(experiment.floor().count, 0.0);
  EXPECT_NEAR(experiment.floor().of_signal.at("force"), 2.0, 0.3);
}

}  // namespace
}  // namespace mckibben::diagnose
