// Settled points: when their inputs act, what their readings scatter by, and cords that hang through.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include <sim/data/judged.hpp>
#include <sim/run/course.hpp>
#include <sim/run/follow.hpp>

namespace mckibben::run {
namespace {

using data::with_rows;

TEST(Points, AreReadAtTheEndOfTheirTime) {
  domain::Measurement measured;
  measured.point_s = 4.0;
  measured.time_s = {0.0, 4.0, 8.0};
  measured.give("command") = {5.0, 9.0, 7.0};
  measured.give("contraction") = {0.0, 0.1, 0.05};
  const Course course = course_of(measured, plant::Rig{});
  ASSERT_EQ(course.rows.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t stamp = course.rows[k];
    EXPECT_EQ(course.time_s[stamp], measured.time_s[k]);
    EXPECT_EQ(course.drives[stamp].current_mA, measured.given("command")[k]);
    EXPECT_EQ(*course.drives[stamp].contraction_ratio, measured.given("contraction")[k]);
  }
  // The command of the next acts at once; its length is there after half of its time.
  EXPECT_EQ(course.drives[1].current_mA, 9.0);
  EXPECT_LT(course.time_s[1], 1e-5);
  EXPECT_EQ(*course.drives[1].contraction_ratio, 0.0);
  EXPECT_EQ(course.time_s[2], 2.0);
  EXPECT_EQ(*course.drives[2].contraction_ratio, 0.1);
}

/// A branch of a loop that falls from 4 bar in steps of 1 bar.
domain::Measurement falling() {
  domain::Measurement measured;
  measured.point_s = 4.0;
  for (int k = 0; k < 5; ++k) {
    measured.time_s.push_back(4.0 * k);
    measured.give("muscle_pressure").push_back(1e5 * (4 - k));
    measured.take("contraction").push_back(0.0);
  }
  return measured;
}

TEST(Points, TheFirstPressureIsReachedFromNoneAsFastAsOthers) {
  const Course course = course_of(falling(), plant::Rig{});
  ASSERT_EQ(course.rows.size(), 5u);
  EXPECT_EQ(course.time_s[course.rows[0]], 0.0);
  EXPECT_EQ(course.time_s[0], -10.0);  // 1 bar in 2 s, and 2 s as they rest at each point
  EXPECT_EQ(*course.drives[0].muscle_pressure_Pa, 0.0);
  EXPECT_EQ(course.time_s[1], -2.0);
  EXPECT_EQ(*course.drives[1].muscle_pressure_Pa, 4e5);
  EXPECT_EQ(*course.drives[course.rows[0]].muscle_pressure_Pa, 4e5);
}

/// As people publish loops, branch by branch: a muscle that was let go at full pressure swings over the point
/// where the rising branch ends.
TEST(Points, AFallingBranchBeginsWhereTheRisingOneEnds) {
  plant::Rig rig;
  rig.joint.guide_damping_N_s_per_m = 0.0;
  domain::Measurement up = falling(), down = falling();
  std::ranges::reverse(up.columns.front().values);
  ASSERT_TRUE(up.columns.front().given);
  const Recording rising = follow(rig, 5.0, course_of(up, rig)),
                  fall = follow(rig, 5.0, course_of(down, rig));
  ASSERT_EQ(rising.samples.size(), 5u);
  const auto friction_N = [](const Sample& sample) { return sample.friction_force_N; };
  EXPECT_NEAR(fall.samples.front().state.joint.contraction_ratio,
              rising.samples.back().state.joint.contraction_ratio, 2e-5);
  EXPECT_GT(std::abs(friction_N(rising.samples.back())), 5.0);
  EXPECT_NEAR(friction_N(fall.samples.front()), friction_N(rising.samples.back()), 0.5);
}

TEST(Points, EvenStepsAreNoGrainOfTheSensor) {
  domain::Dataset data;
  data.own_clock = true;
  domain::Measurement& measured = data.runs.emplace_back().measured.emplace();
  measured.point_s = 5.0;
  for (int k = 0; k < 10; ++k) {
    measured.time_s.push_back(5.0 * k);
    measured.give("contraction").push_back(0.05);
    measured.give("muscle_pressure").push_back(5e4 * (k + 1));
    measured.take("force").push_back(142.0 * (k + 1) + 0.5 * (k % 3));
  }
  data = with_rows(std::move(data));
  EXPECT_EQ(data.rows_of_stamps->step, 0.0);
  EXPECT_GT(data.rows_of_stamps->noise, 0.1);
  EXPECT_LT(data.rows_of_stamps->noise, 1.0);
}

TEST(Points, ScatterIsWhatNeighboursDoNotExplain) {
  constexpr double noise_N = 2.0;
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, noise_N);
  domain::Dataset data;
  data.own_clock = true;
  for (int length = 0; length < 4; ++length) {
    domain::Measurement& measured = data.runs.emplace_back().measured.emplace();
    measured.point_s = 1.0;
    for (int k = 0; k < 40; ++k) {  // up and down
      const double bar = 0.25 * (k < 20 ? k : 39 - k);
      measured.time_s.push_back(k);
      measured.give("contraction").push_back(0.05 * length);
      measured.give("muscle_pressure").push_back(1e5 * bar);
      measured.take("force").push_back(bar < 1.0 ? 0.0 : 300.0 * bar + 8.0 * bar * bar + noise(random));
    }
  }
  data = with_rows(std::move(data));
  const domain::Rows& rows = *data.rows_of_stamps;
  EXPECT_NEAR(rows.noise, noise_N, 0.3 * noise_N);
  EXPECT_EQ(rows.slack, 4u * 8u);
  EXPECT_EQ(rows.rows, 160u);
  const domain::Run& run = data.runs[1];
  EXPECT_EQ(std::count(run.judged().missing.begin(), run.judged().missing.end(), true), 8);
  EXPECT_EQ(run.rows(), 40u);
  EXPECT_EQ(run.find("contraction"), nullptr);
  EXPECT_EQ(run.measured->given("contraction"), std::vector<double>(40, 0.05));
}

}  // namespace
}  // namespace mckibben::run
