// What a recorder and its sensors did to readings: hum of the mains, the end of a range; and what they did
// not.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <sim/data/even_rows.hpp>
#include <sim/data/judged.hpp>
#include <sim/data/stamps.hpp>

namespace mckibben::data {
namespace {

constexpr double scatter_Pa = 400.0;

/// Three seconds at so many stamps a second, at uneven instants.
std::vector<double> stamps(double per_s) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> jitter(-0.1, 0.1);
  std::vector<double> time_s;
  for (double k = 0.0; k < 3.0 * per_s; k += 1.0) time_s.push_back(7.0 + (k + jitter(random)) / per_s);
  return time_s;
}

/// A gauge's readings: a slow swing, a jump, noise, and a tone.
std::vector<double> pressures(const std::vector<double>& time_s, double hz, double amplitude_Pa) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, scatter_Pa);
  std::vector<double> values;
  for (const double at_s : time_s) {
    const double turn = 2.0 * std::numbers::pi * at_s;
    values.push_back(2e5 + 1e5 * std::sin(turn) + (at_s > 8.5 ? 5e4 : 0.0) + noise(random) +
                     amplitude_Pa * std::sin(hz * turn + 0.7));
  }
  return values;
}

TEST(Stamps, HumOfTheMainsStandsOut) {
  const std::vector<double> time_s = stamps(1000.0);
  for (const double hz : {50.0, 60.0}) {
    const Tone tone = hum_of(time_s, pressures(time_s, hz, 2e3));
    EXPECT_EQ(tone.hz, hz);
    EXPECT_NEAR(tone.amplitude, 2e3, 100.0);
  }
  EXPECT_NEAR(hum_of(time_s, pressures(time_s, 50.1, 2e3)).amplitude, 2e3, 100.0);  // mains drift
  EXPECT_EQ(hum_of(time_s, pressures(time_s, 0.0, 0.0)).amplitude, 0.0);
  EXPECT_EQ(hum_of(time_s, pressures(time_s, 35.0, 2e3)).amplitude, 0.0);  // no mains
  const std::vector<double> slow_s = stamps(100.0);
  EXPECT_EQ(hum_of(slow_s, pressures(slow_s, 50.0, 2e3)).amplitude, 0.0);  // cannot be told
}

/// A load that starts and stops each half second, as a laser sees it.
std::vector<double> starting_and_stopping(const std::vector<double>& time_s, double hum) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> noise(0.0, 1e-4);
  std::vector<double> values;
  for (const double at_s : time_s) {
    const double turns = std::floor(2.0 * at_s), way = std::min(1.0, (at_s - 0.5 * turns) / 0.05);
    const double risen = way * way * (3.0 - 2.0 * way);
    values.push_back(0.1 + 0.03 * (std::fmod(turns, 2.0) == 0.0 ? risen : 1.0 - risen) + noise(random) +
                     hum * std::sin(100.0 * std::numbers::pi * at_s));
  }
  return values;
}

TEST(Stamps, StartsAndStopsAreNotTakenForHum) {
  constexpr double hum = 5e-4;
  domain::Dataset data;
  data.own_clock = true;
  domain::Measurement& measured = data.runs.emplace_back().measured.emplace();
  measured.time_s = stamps(1000.0);
  measured.take("contraction") = starting_and_stopping(measured.time_s, hum);
  ASSERT_EQ(mend_at_stamps(data).size(), 1u);
  const std::vector<double> clean = starting_and_stopping(measured.time_s, 0.0);
  double squares = 0.0;
  for (std::size_t k = 0; k < clean.size(); ++k)
    squares += std::pow(measured.read("contraction")[k] - clean[k], 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(clean.size())), 0.04 * hum / std::sqrt(2.0));
}

/// At 1 mm steps of 0.001 with noise, cut off at 0.12.
std::vector<double> contractions(double resolution, double scatter_ratio) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> noise(0.0, scatter_ratio);
  std::vector<double> values;
  for (int k = 0; k < 3000; ++k) {
    const double ratio = 0.1 + 0.05 * std::sin(4e-3 * k) + noise(random);
    values.push_back(resolution * std::round(std::min(ratio, 0.12) / resolution));
  }
  return values;
}

TEST(Stamps, TheEndOfARangeRepeatsToTheLastDigit) {
  auto values = contractions(1e-6, 1e-4);
  const auto at_the_end = std::count(values.begin(), values.end(), 0.12);
  const CutOff cut_off = leave_out_cut_off(values);
  EXPECT_EQ(cut_off.readings, static_cast<std::size_t>(at_the_end));
  EXPECT_EQ(cut_off.at, 0.12);
  EXPECT_GT(std::count_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }), at_the_end);
  EXPECT_EQ(leave_out_cut_off(values).readings, 0u);  // once is enough
}

TEST(Stamps, WhatRestsOnACoarseStepIsNotCutOff) {
  auto coarse = contractions(1e-3, 1e-4);
  EXPECT_EQ(leave_out_cut_off(coarse).readings, 0u);
}

TEST(Stamps, WhatWasDoneIsTold) {
  domain::Dataset data;
  data.own_clock = true;
  for (const char* id : {"r1", "r2"}) {
    domain::Run& run = data.runs.emplace_back();
    run.id = id;
    domain::Measurement& measured = run.measured.emplace();
    measured.time_s = stamps(1000.0);
    measured.take("contraction") = contractions(1e-6, 1e-4);
    measured.give("muscle_pressure") = pressures(measured.time_s, 50.0, 3e3);
  }
  for (double& ratio : data.runs[1].measured->take("contraction")) ratio *= 0.9 + 1e-9 * ratio;
  std::vector<std::string> words;
  for (const Finding& one : mend_at_stamps(data))
    words.push_back(text_of(data, one).append(consequence_of(one)));
  ASSERT_EQ(words.size(), 3u);
  EXPECT_TRUE(words[0].starts_with("run r1: contraction stays at 36 mm to the last digit in ")) << words[0];
  EXPECT_EQ(words[2],
            "muscle_pressure: a tone of 50 Hz, 30 mbar in amplitude, in every run: hum of the mains; it was "
            "taken out");
  const domain::Measurement& mended = *data.runs[0].measured;
  const std::vector<double> clean = pressures(mended.time_s, 0.0, 0.0);
  double squares = 0.0;
  for (std::size_t k = 0; k < clean.size(); ++k)
    squares += std::pow(mended.given("muscle_pressure")[k] - clean[k], 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(clean.size())), 0.1 * 3e3 / std::sqrt(2.0));
}

/// Ticks of 12 ms that begin up to 6 ms late, a command sent at each 0.2 ms after its reading.
domain::Dataset of_a_busy_bench(double pause_s = 0.0) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> late_s(0.0, 6e-3);
  domain::Dataset data;
  data.own_clock = true;
  domain::Measurement measured;
  measured.own_clocks = true;
  std::vector<double> commands, readings;
  for (int k = 0; k < 200; ++k) {
    const double at_s = 0.012 * k + late_s(random) + (k > 100 ? pause_s : 0.0);
    for (const bool sent : {false, true}) {
      measured.time_s.push_back(at_s + (sent ? 2e-4 : 0.0));
      readings.push_back(sent ? std::nan("") : 0.1 + 0.01 * at_s);
      commands.push_back(k == 0 || sent ? 4.0 + 0.01 * k : commands.back());
    }
  }
  measured.give("command") = commands;
  measured.take("contraction") = readings;
  data.runs.emplace_back().measured = measured;
  return with_rows(std::move(data));
}

TEST(EvenRows, AreMadeOfTicksThatBeganLate) {
  domain::Dataset data = of_a_busy_bench();
  const Spacing spacing = spacing_of(data);
  EXPECT_FALSE(spacing.is_even());
  EXPECT_TRUE(spacing.gaps.empty());
  EXPECT_EQ(spacing.row_s, data.rig.tick_s);
  make_even(data, spacing.row_s);
  EXPECT_TRUE(spacing_of(data).is_even());
  const domain::Run& run = data.runs.front();
  ASSERT_GT(run.rows(), 195U);
  ASSERT_EQ(run.current_mA.size(), run.rows());
  const double begin_s = run.measured->time_s.front();
  for (std::size_t k = 0; k < run.time_s.size(); ++k) {
    EXPECT_NEAR(run.judged().values[k], 0.1 + 0.01 * (begin_s + run.time_s[k]), 1e-9);
    EXPECT_NEAR(run.current_mA[k], 4.0 + 0.01 * static_cast<double>(k), 0.012) << "a tick at most";
  }
}

TEST(EvenRows, AreNotMadeOverAGap) {
  const Spacing spacing = spacing_of(of_a_busy_bench(0.05));
  EXPECT_EQ(spacing.gaps, std::vector<std::size_t>{0});
  EXPECT_NEAR(spacing.gap_s, 0.062, 0.006);
  EXPECT_NEAR(spacing.gap_at_s, 101 * 0.012 + 0.05, 0.006);
}

}  // namespace
}  // namespace mckibben::data
