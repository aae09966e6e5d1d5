// Forces at given lengths: what a rig would show, what is held out, and forces that are none.
#include "bench.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include <plant/geometry.hpp>
#include <sim/data/finding.hpp>
#include <sim/diagnose/check.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/in_brief.hpp>

namespace mckibben::diagnose {
namespace {

TEST(Bench, ForcesAreThoseOfTheCord) {
  const plant::Rig rig;
  const domain::Dataset data = on_a_bench(rig, 0.0);
  const Loaded held{rig, 0.0};
  const auto readings = predict(data.runs[2], {&held, 1}).front();
  for (std::size_t k = 0; k < 9; ++k)  // no length moves: threads do not rub
    EXPECT_NEAR(readings.judged[k], plant::Braid(rig.muscle).force_N(0.11, readings.pressure_Pa[k]), 1e-6);
  const Checked checked = check(data, 1);
  const Experiment experiment(data, checked.masked, 1, {0, 1, 2, 3, 4});
  EXPECT_LT(experiment.rmse(experiment.residuals(rig, {0, 1, 2, 3, 4}), {0, 1, 2, 3, 4}), 1e-6);
}

TEST(Bench, TheZeroOfTheLengthShiftsWhatIsGiven) {
  plant::Rig rig;
  rig.joint.length_offset_m = 3e-3;
  const domain::Dataset data = on_a_bench({}, 0.0);
  const Loaded held{rig, 0.0};
  const auto readings = predict(data.runs[2], {&held, 1}).front();
  EXPECT_NEAR(readings.judged[4], plant::Braid(rig.muscle).force_N(0.12, readings.pressure_Pa[4]), 1e-6);
}

TEST(Bench, LengthsInsideAreHeldOut) {
  const domain::Dataset data = on_a_bench({}, 0.5);
  const Runs held_out = split(data, {0, 1, 2, 3, 4}).held_out;
  ASSERT_EQ(held_out.size(), 2u);
  EXPECT_EQ(std::count(held_out.begin(), held_out.end(), 2), 1);  // in the middle
  EXPECT_EQ(split(data, {0, 1, 3}).held_out, Runs{1});            // not the ends
}

TEST(HeldOut, AFewOfManyRunsAreOfAllLoads) {
  domain::Dataset data;
  Runs all;
  for (std::size_t i = 0; i < 100; ++i) {
    data.runs.emplace_back().load_kg = static_cast<double>(10 + i % 5);
    all.push_back(i);
  }
  EXPECT_EQ(a_few(data, all, 100), all);
  const Runs few = a_few(data, all, 24);
  ASSERT_EQ(few.size(), 24u);
  EXPECT_TRUE(std::is_sorted(few.begin(), few.end()));
  for (std::size_t load = 0; load < 5; ++load)
    EXPECT_GE(std::count_if(few.begin(), few.end(), [&](std::size_t run) { return run % 5 == load; }), 4)
        << load;
}

TEST(HeldOut, OfLongRunsASearchAsksFew) {
  const auto asked_of = [](std::size_t runs, double duration_s) {
    domain::Dataset data;
    const auto rows = static_cast<std::size_t>(std::lround(duration_s / data.row_s()));
    Split whole;
    for (std::size_t i = 0; i < runs; ++i) {
      domain::Run& run = data.runs.emplace_back();
      run.load_kg = static_cast<double>(10 + i % 5);
      run.contraction_ratio.assign(rows, 0.1);
      (i % 3 == 0 ? whole.held_out : whole.training).push_back(i);
    }
    const Split few = asked(data, whole);
    return std::pair{few.training.size(), few.held_out.size()};
  };
  EXPECT_EQ(asked_of(99, 24.0), std::pair(std::size_t{12}, std::size_t{6}));
  EXPECT_EQ(asked_of(99, 2.0), std::pair(std::size_t{66}, std::size_t{33}));  // short ones: all
  EXPECT_EQ(asked_of(30, 600.0), std::pair(std::size_t{9}, std::size_t{4}));  // never fewer
  EXPECT_EQ(asked_of(12, 600.0), std::pair(std::size_t{8}, std::size_t{4}));
}

TEST(HeldOut, RowsInBriefHaveTheProductsOfAll) {
  Eigen::MatrixXd rows(40, 3);
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    const double t = 0.1 * static_cast<double>(k);
    rows.row(k) << std::sin(t), 2.0 * std::sin(t), t * t;  // two are one
  }
  const Eigen::MatrixXd brief = in_brief(rows);
  EXPECT_EQ(brief.rows(), 3);
  EXPECT_TRUE((brief.transpose() * brief).isApprox(rows.transpose() * rows, 1e-13));
  EXPECT_EQ(in_brief(rows.topRows(2)), rows.topRows(2));
}

TEST(Bench, ForcesInAnotherUnitAreRefused) {
  domain::Dataset data = on_a_bench({}, 0.0);
  for (domain::Run& run : data.runs)
    for (double& force_N : run.force_N) force_N *= 1e-3;
  EXPECT_THROW(check(data, 1), data::UnfitData);
  for (domain::Run& run : data.runs)
    for (double& force_N : run.force_N) force_N *= -1e3;
  EXPECT_THROW(check(data, 1), data::UnfitData);
}

}  // namespace
}  // namespace mckibben::diagnose
