// Rows of runs with a clock of their own: what fast readings say together, which inputs are kept, and that
// slow ones stay as they are.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <sim/data/finding.hpp>
#include <sim/data/judged.hpp>
#include <sim/run/follow.hpp>

namespace mckibben::run {
namespace {

using data::with_rows;

constexpr double noise_ratio = 1e-4, noise_Pa = 400.0;

double truth(double time_s) {
  return 0.1 + 0.05 * std::sin(2.0 * std::numbers::pi * time_s);
}
double pressure_Pa(double time_s) {
  return 2e5 + 1e5 * std::sin(2.0 * std::numbers::pi * time_s);
}

/// Two seconds at about so many stamps a second.
domain::Dataset recorded(double per_s, bool given) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  domain::Dataset data;
  data.own_clock = true;
  domain::Run& run = data.runs.emplace_back();
  run.load_kg = 12.0;
  run.rest_length_m = data.rig.muscle.rest_length_m;
  domain::Measurement& measured = run.measured.emplace();
  for (double k = 0.0; k < 2.0 * per_s; k += 1.0) {
    const double at_s = 7.0 + (k + jitter(random)) / per_s;
    measured.time_s.push_back(at_s);
    measured.take("contraction").push_back(truth(at_s) + noise_ratio * normal(random));
    if (given)
      measured.give("muscle_pressure").push_back(pressure_Pa(at_s) + noise_Pa * normal(random));
    else
      measured.give("command").push_back(at_s < 8.0007 ? 6.0 + at_s : 18.0);
  }
  return data;
}

TEST(Judged, RowsSayWhatReadingsSayTogether) {
  domain::Dataset data = recorded(1000.0, false);
  auto& ratio = data.runs[0].measured->take("contraction");
  std::fill(ratio.begin() + 500, ratio.begin() + 540, std::nan(""));
  data.recorded.skip_s = data.runs[0].measured->recorded.skip_s = 0.3;
  data = with_rows(std::move(data));
  const domain::Run& run = data.runs[0];
  const domain::Rows& rows = *data.rows_of_stamps;
  EXPECT_EQ(rows.row_s, 0.012);
  EXPECT_EQ(rows.stamps, 2000u);
  ASSERT_EQ(run.rows(), run.time_s.size());
  ASSERT_EQ(run.current_mA.size(), run.time_s.size());
  EXPECT_NEAR(static_cast<double>(rows.rows), 1.7 / 0.012, 2.0);
  EXPECT_GE(run.time_s.front(), 0.3);
  EXPECT_NEAR(rows.noise, noise_ratio * std::sqrt(9.0 / 4.0 / 12.0), 0.2 * rows.noise);
  EXPECT_GE(std::count(run.judged().missing.begin(), run.judged().missing.end(), true), 2);
  EXPECT_LE(std::count(run.judged().missing.begin(), run.judged().missing.end(), true), 4);
  for (std::size_t k = 0; k < run.time_s.size(); ++k) {
    ASSERT_TRUE(std::isfinite(run.judged().values[k]));
    if (run.judged().missing[k]) continue;
    EXPECT_NEAR(run.judged().values[k], truth(run.measured->time_s.front() + run.time_s[k]),
                5.0 * rows.noise);
  }
}

TEST(Judged, AJumpOfTheCommandKeepsItsStamp) {
  domain::Dataset data = recorded(1000.0, false);
  const domain::Measurement raw = *data.runs[0].measured;
  const auto jump = std::ranges::find(raw.given("command"), 18.0);
  const double jump_s = raw.time_s[static_cast<std::size_t>(jump - raw.given("command").begin())];
  data = with_rows(std::move(data));
  const domain::Measurement& driving = *data.runs[0].measured;
  EXPECT_LT(driving.time_s.size(), 700u);
  const auto kept = std::find(driving.time_s.begin(), driving.time_s.end(), jump_s);
  ASSERT_NE(kept, driving.time_s.end());
  const auto at = static_cast<std::size_t>(kept - driving.time_s.begin());
  EXPECT_EQ(driving.given("command")[at], 18.0);
  EXPECT_LT(driving.given("command")[at - 1], 14.1);

  // What the load does is what it does from stamp to stamp.
  const auto end_of = [&](const domain::Measurement& measured) {
    return follow(data.rig, 12.0, course_of(measured, data.rig)).samples.back();
  };
  domain::Measurement whole = raw;
  whole.rows = {static_cast<std::size_t>(
      std::lower_bound(raw.time_s.begin(), raw.time_s.end(), driving.time_s[driving.rows.back()]) -
      raw.time_s.begin())};
  const Sample rough = end_of(driving), exact = end_of(whole);
  EXPECT_NEAR(rough.state.joint.contraction_ratio, exact.state.joint.contraction_ratio, 2e-5);
  EXPECT_GT(exact.state.joint.contraction_ratio, 0.1);
}

/// Of what a pressure is off: as it drives the run, against the truth, and as much noise again against that.
struct Off {
  double of_truth = 0.0, shaken = 0.0;
  double there_and_back = 0.0;  ///< all ways it goes, beyond the truth's, which stand for hysteresis
  explicit Off(const domain::Run& run) {
    const domain::Measurement& driving = *run.measured;
    const auto &given = driving.given("muscle_pressure"), &again = run.shaken->given("muscle_pressure");
    for (std::size_t k = 0; k < given.size(); ++k) {
      const double true_Pa = pressure_Pa(driving.time_s[k]);
      of_truth += std::pow(given[k] - true_Pa, 2) / static_cast<double>(given.size());
      shaken += std::pow(given[k] - again[k], 2) / static_cast<double>(given.size());
      if (k > 0)
        there_and_back +=
            std::abs(given[k] - given[k - 1]) - std::abs(true_Pa - pressure_Pa(driving.time_s[k - 1]));
    }
    of_truth = std::sqrt(of_truth);
    shaken = std::sqrt(shaken);
  }
};

TEST(Judged, AGivenPressureIsSmoothed) {
  for (const double per_s : {1000.0, 100.0}) {
    const domain::Dataset data = with_rows(recorded(per_s, true));
    EXPECT_TRUE(data.pressure_is_given());
    EXPECT_NEAR(data.rows_of_stamps->given_noise_Pa, noise_Pa, 0.15 * noise_Pa);
    const Off off(data.runs[0]);
    EXPECT_LT(off.of_truth, 0.6 * noise_Pa) << per_s;
    EXPECT_NEAR(off.shaken, off.of_truth, 0.4 * off.of_truth) << per_s;  // as much again
    EXPECT_LT(off.there_and_back, 10.0 * noise_Pa) << per_s;             // of 4e5 Pa
  }
}

// A held muscle that pulls from 2 bar on, read by a load cell with noise: where it does not pull, the
// readings say nothing, unless the cell's zero is off, which they show.
TEST(Judged, ASlackCordReadsTheNoiseOfItsCell) {
  constexpr double noise_N = 2.0;
  const auto recorded = [](double zero_N) {
    std::mt19937_64 random(8);
    std::normal_distribution<double> noise(zero_N, noise_N);
    domain::Dataset data;
    data.own_clock = true;
    domain::Measurement& measured = data.runs.emplace_back().measured.emplace();
    for (double at_s = 0.0; at_s < 8.0; at_s += 0.01) {
      const double now_Pa = 3e5 - 2e5 * std::cos(0.5 * std::numbers::pi * at_s);
      measured.time_s.push_back(at_s);
      measured.give("contraction").push_back(0.1);
      measured.give("muscle_pressure").push_back(now_Pa);
      measured.take("force").push_back(std::max(0.0, 1e-3 * (now_Pa - 2e5)) + noise(random));
    }
    return with_rows(std::move(data));
  };
  const domain::Dataset data = recorded(0.0);
  EXPECT_NEAR(static_cast<double>(data.rows_of_stamps->slack), 800.0 / 3.0, 12.0);
  for (const double read_N : data.runs[0].judged().values) EXPECT_GT(read_N, 0.0);
  EXPECT_EQ(recorded(30.0).rows_of_stamps->slack, 0u);
}

// A command that was measured, by an ADC: it drives smoothly. One that was written down is what was sent.
TEST(Judged, ANoisyCommandIsSmoothed) {
  for (const double per_s : {1000.0, 100.0})
    for (const double noise_mA : {0.0, 0.01}) {
      domain::Dataset data = recorded(per_s, false);
      domain::Measurement& measured = *data.runs[0].measured;
      std::mt19937_64 random(7);
      std::normal_distribution<double> normal;
      for (double& command_mA : measured.give("command")) command_mA += noise_mA * normal(random);
      const std::vector<double> recorded_mA = measured.given("command");
      const domain::Run run = with_rows(std::move(data)).runs[0];
      const domain::Measurement& driving = *run.measured;
      EXPECT_EQ(run.shaken.has_value(), noise_mA > 0.0);
      if (noise_mA == 0.0 && per_s == 100.0) {
        EXPECT_EQ(driving.given("command"), recorded_mA);
      }
      double squares = 0.0, count = 0.0;
      for (std::size_t k = 0; k < driving.time_s.size(); ++k) {
        const double at_s = driving.time_s[k];
        if (std::abs(at_s - 8.0) < 0.05) continue;  // there it jumps
        squares += std::pow(driving.given("command")[k] - (at_s < 8.0 ? 6.0 + at_s : 18.0), 2);
        count += 1.0;
      }
      EXPECT_LT(std::sqrt(squares / count), noise_mA > 0.0 ? 0.5 * noise_mA : 2e-3) << per_s;
    }
}

// A valve's pressure may jump: smoothing would be a ramp that no valve made.
TEST(Judged, AJumpOfAGivenPressureIsLeft) {
  domain::Dataset data = recorded(100.0, true);
  domain::Measurement& measured = *data.runs[0].measured;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, noise_Pa);
  for (std::size_t k = 0; k < measured.time_s.size(); ++k)
    measured.give("muscle_pressure")[k] = (k < 90 ? 1e5 : 3e5) + normal(random);
  const domain::Measurement driving = *with_rows(std::move(data)).runs[0].measured;
  for (std::size_t k = 0; k < driving.time_s.size(); ++k)
    EXPECT_NEAR(driving.given("muscle_pressure")[k], k < 90 ? 1e5 : 3e5, 4.0 * noise_Pa) << k;
}

TEST(Judged, ACommandsOwnStampsAreNoRows) {
  domain::Dataset data = recorded(1.0 / 0.012, false);
  domain::Measurement& measured = *data.runs[0].measured;
  domain::Measurement merged = measured;  // each command goes out 2 ms after the reading before it
  merged.own_clocks = true;
  merged.time_s.clear();
  for (auto& column : merged.columns) column.values.clear();
  const std::size_t readings = measured.time_s.size() - 1;
  for (std::size_t k = 0; k < readings; ++k)
    for (const double late_s : {0.0, 0.002}) {
      merged.time_s.push_back(measured.time_s[k] + late_s);
      merged.take("contraction").push_back(late_s == 0.0 ? measured.read("contraction")[k] : std::nan(""));
      merged.give("command").push_back(measured.given("command")[late_s == 0.0 && k > 0 ? k - 1 : k]);
    }
  measured = merged;
  data = with_rows(std::move(data));
  EXPECT_NEAR(data.row_s(), 0.012, 1e-3);
  EXPECT_EQ(data.rows_of_stamps->stamps, 2 * readings);
  EXPECT_EQ(data.runs[0].rows(), readings);
  EXPECT_EQ(std::ranges::count(data.runs[0].judged().missing, true), 0);
  EXPECT_EQ(data.runs[0].measured->time_s, merged.time_s) << "commands act from their stamps on";
}

TEST(Judged, AGaugeOnTheValveHasANoiseOfItsOwn) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  domain::Dataset data = recorded(1000.0, false);
  domain::Measurement& measured = *data.runs[0].measured;
  for (const double at_s : measured.time_s) {
    measured.take("muscle_pressure").push_back(pressure_Pa(at_s) + 40.0 * normal(random));
    measured.take("valve_pressure").push_back(pressure_Pa(at_s) + 400.0 * normal(random));
  }
  data = with_rows(std::move(data));
  const domain::Rows& rows = *data.rows_of_stamps;
  EXPECT_NEAR(rows.noise_beside.at("valve_pressure") / rows.noise_beside.at("muscle_pressure"), 10.0, 1.5);
  EXPECT_EQ(data.runs[0].values("valve_pressure").size(), rows.rows);
  EXPECT_EQ(data.runs[0].find("valve_pressure", 2), nullptr);
}

// What drives a run, whatever it is, is there after rows were made of its stamps.
TEST(Judged, AGivenForceAndValvePressureAreFollowed) {
  domain::Dataset data = recorded(1000.0, false);
  domain::Measurement& measured = *data.runs[0].measured;
  std::erase_if(measured.columns, &domain::MeasuredColumn::is_command);
  for (const double at_s : measured.time_s) {
    measured.give("valve_pressure").push_back(pressure_Pa(at_s));
    measured.give("joint_force").push_back(50.0 * std::sin(at_s));
  }
  data = with_rows(std::move(data));
  const domain::Measurement& driving = *data.runs[0].measured;
  ASSERT_EQ(driving.columns.size(), 2u);
  for (std::size_t k = 0; k < driving.time_s.size(); ++k) {
    EXPECT_NEAR(driving.given("valve_pressure")[k], pressure_Pa(driving.time_s[k]), 20.0);
    EXPECT_NEAR(driving.given("joint_force")[k], 50.0 * std::sin(driving.time_s[k]), 0.05);
  }
  EXPECT_FALSE(data.pressure_is_given());  // that of the muscle
}

TEST(Judged, SlowReadingsStayAsTheyAre) {
  const domain::Dataset raw = recorded(50.0, true), data = with_rows(raw);
  EXPECT_EQ(data.runs[0].judged().values, raw.runs[0].measured->read("contraction"));
  EXPECT_EQ(data.runs[0].measured->time_s, raw.runs[0].measured->time_s);
  EXPECT_NEAR(data.row_s(), 0.02, 0.002);
  EXPECT_EQ(with_rows(data).runs[0].judged().values, data.runs[0].judged().values);  // once is enough
}

TEST(Judged, ARowEachTickIsWhatItIs) {
  domain::Dataset data;
  data.runs.emplace_back().read("contraction", {0.1, 0.2});
  EXPECT_FALSE(with_rows(data).rows_of_stamps);
  EXPECT_EQ(data.row_s(), data.rig.tick_s);
}

TEST(Judged, ARunOfWhichNoRowIsLeftIsRefused) {
  domain::Dataset data = recorded(1000.0, true);
  EXPECT_TRUE(data::runs_without_rows(data).empty());
  data.runs.front().measured->recorded.skip_s = 1.997;
  EXPECT_EQ(data::runs_without_rows(data), std::vector<std::size_t>{0});
  EXPECT_THROW(with_rows(data), data::UnfitData);
}

}  // namespace
}  // namespace mckibben::run
