// What cannot be in measured data is said before anything is simulated, with the line to write.
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/data/plausible.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/diagnostics.hpp>

#include "says.hpp"
#include "scratch.hpp"

namespace mckibben::data {
namespace {

class PlausibleData : public ::testing::Test {
 protected:
  using Row = std::function<std::string(int)>;
  static std::string good(int k) {
    return fmt::format("{},{:.3f},{:.2f}", 10 * k, 0.3 + 0.01 * k, 0.157 * k);
  }

  /// Of two runs the first of which has these rows.
  std::vector<Finding> find(const Row& row, const std::string& time = "ms",
                            const std::string& pressure = "bar", const std::string& second = "b.csv") const {
    std::string text = "t,p,x\n", other = text;
    for (int k = 0; k < 200; ++k) text += row(k) + "\n";
    for (int k = 0; k < 200; ++k)
      other += fmt::format("{},{:.3f},{:.2f}\n", 10 * k, 0.2 + 0.011 * k, 0.163 * k);
    place_.write("a.csv", text);
    place_.write("b.csv", other);
    place_.write(
        "dataset.yaml",
        fmt::format(
            "schema: mckibben-dataset/1\nrig: festo_dmsp_10\ncolumns:\n  time: {{column: t, unit: ms}}\n"
            "  muscle_pressure: {{column: p, unit: bar, as: input}}\n  contraction: {{column: x, unit: mm}}\n"
            "runs:\n  - {{id: a, file: a.csv, load: 5 kg, columns: {{time: {{column: t, unit: {}}}, "
            "muscle_pressure: {{column: p, unit: {}, as: input}}}}}}\n"
            "  - {{id: b, file: {}, load: 9 kg}}\n",
            time, pressure, second));
    return implausible(input::read_dataset(place_));
  }
  static std::string said(const std::vector<Finding>& findings) {
    std::string text;
    for (const Finding& one : findings)
      text += (one.severity == Severity::refused ? "refused: " : "doubtful: ") + one.message + "\n";
    return text;
  }

  Scratch place_;
};

TEST_F(PlausibleData, CommandsBeyondOrBetweenTheValvesAreAskedAbout) {
  const auto asked = [&](double most_V,
                         const std::string& valve = "zero_pressure: 0 bar, span_pressure: 6 bar",
                         double least_V = 0.0) {
    std::string rows = "t,u,x\n";
    for (int k = 0; k < 200; ++k)
      rows += fmt::format("{},{:.3f},{:.2f}\n", 10 * k, std::lerp(least_V, most_V, k / 199.0), 0.157 * k);
    place_.write("a.csv", rows);
    place_.write(
        "dataset.yaml",
        "schema: mckibben-dataset/1\nrig: {base: festo_dmsp_10, valve: {zero_command: 0 V, span_command: "
        "10 V, " +
            valve +
            "}}\ncolumns:\n  time: {column: t, unit: ms}\n"
            "  command: {column: u, unit: V}\n  contraction: {column: x, unit: mm}\n"
            "runs:\n  - {id: a, file: a.csv, load: 5 kg}\n");
    return said(implausible(input::read_dataset(place_)));
  };
  EXPECT_EQ(asked(10.05), "");
  EXPECT_EQ(asked(12.0),
            "doubtful: command goes up to 12 V, and the rig's valve answers to 0 to 10 V: above that the "
            "simulated pressure does not change; are zero_command and span_command the valve's, and unit, "
            "zero and factor the column's?\n");
  EXPECT_EQ(asked(10.0, "zero_pressure: 0 bar, span_pressure: 6 bar", -0.05), "");
  EXPECT_TRUE(holds(asked(10.0, "zero_pressure: 0 bar, span_pressure: 6 bar", -6.0),
                    "doubtful: command goes down to -6 V",
                    "below that the simulated pressure does not change", "unit, zero and factor"));
  EXPECT_TRUE(
      holds(asked(10.0, "kind: on_off, switching: averaged", -6.0), "below that it vents all the time"));
  EXPECT_EQ(asked(10.05, "kind: on_off, switching: averaged"), "");
  EXPECT_TRUE(holds(asked(10.05, "kind: on_off"), "doubtful: command takes many values between 0 and 10 V",
                    "switching: pwm, with pwm_frequency, or switching: averaged"));
  EXPECT_TRUE(holds(asked(12.0, "kind: on_off, switching: pwm, pwm_frequency: 50 Hz"),
                    "above that it is open all the time, a duty of 100 %; are zero_command"));
}

TEST_F(PlausibleData, AMuscleHeldLongerThanAtRestPullsByItsTautThreads) {
  const auto asked = [&](const std::string& zero) {
    std::string rows = "t,p,x,F\n";
    for (int k = 0; k < 200; ++k)
      rows += fmt::format("{},{:.3f},0,{:.1f}\n", 10 * k, 0.5 + 0.01 * k, 125.0 + 2.5 * k);
    place_.write("a.csv", rows);
    place_.write("dataset.yaml",
                 "schema: mckibben-dataset/1\nrig: {base: thesis, mechanics: {kind: held_length}}\ncolumns:\n"
                 "  time: {column: t, unit: ms}\n  muscle_pressure: {column: p, unit: bar, as: input}\n"
                 "  contraction: {column: x, unit: mm, as: input, zero: " +
                     zero + "}\n  force: {column: F, unit: N}\nruns:\n  - {id: a, file: a.csv}\n");
    return said(implausible(input::read_dataset(place_)));
  };
  EXPECT_EQ(asked("0"), "");
  EXPECT_EQ(asked("0.01"), "");
  EXPECT_TRUE(holds(asked("0.2"),
                    "doubtful: the muscle is held 0.2 mm longer than at rest, where the taut "
                    "threads of the rig add 60 N to the braid's pull",
                    "{contraction: {column: x, unit: mm, as: input}}", "stop_stiffness"));
}

TEST_F(PlausibleData, WhatIsSoundIsSilent) {
  EXPECT_EQ(said(find(good)), "");
}

TEST_F(PlausibleData, RunsThatLastNextToNothingOrHours) {
  EXPECT_TRUE(
      holds(said(find(good, "us")), "refused: lasts 1.99 ms, its 200 rows are 10 us apart", "unit: ms"));
  EXPECT_TRUE(
      holds(said(find([](int k) { return fmt::format("{},{},{}", 1000 * k, 0.3 + 0.01 * k, k); }, "s")),
            "doubtful: lasts 55.3 h, its rows are 1e+03 s apart", "unit: ms"));
}

TEST_F(PlausibleData, RunsWhoseRowsAreAThousandTimesAsFarApartAsOthers) {
  EXPECT_TRUE(
      holds(said(find(good, "s")),
            "refused: lasts 0.553 h, its rows are 10 s apart, those of run b 10 ms: is its time in ms, "
            "not in s? Then write columns: {time: {column: t, unit: ms, factor: 1}}"));
  EXPECT_TRUE(lacks(said(find(good, "s")), "no row is left"));
}

TEST_F(PlausibleData, ASkipBeyondAShortRunIsAskedToo) {
  find(good, "us");
  std::ifstream file(place_ / "dataset.yaml");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  place_.write("dataset.yaml", text + "skip: 0.3 s\nstart: settled\n");
  try {
    input::read_dataset(place_);
    ADD_FAILURE();
  } catch (const input::BadInput& bad) {
    EXPECT_TRUE(
        holds(bad.what(), "skip = 0.3 s leaves nothing of this run, which lasts 1.99 ms", "unit: ms"));
  }
}

TEST_F(PlausibleData, AGapInTheStamps) {
  EXPECT_TRUE(holds(said(find([](int k) {
                      return fmt::format("{},{},{}", 10 * k + (k > 50 ? 500 : 0), 0.3 + 0.01 * k, k);
                    })),
                    "doubtful: no rows from 0.5 s to 1.01 s", "to: 0.5 s or from: 1.01 s"));
}

TEST_F(PlausibleData, AReadingThatNeverMoves) {
  EXPECT_TRUE(holds(said(find([](int k) { return fmt::format("{},{},7.5", 10 * k, 0.3 + 0.01 * k); })),
                    "doubtful: contraction never moves", "is x the right column"));
}

TEST_F(PlausibleData, PressuresThatCannotBe) {
  const auto high = [](int k) { return fmt::format("{},{},{}", 10 * k, 4.0 + 0.4 * k, k); };
  const auto ten_times = [](int k) { return fmt::format("{},{},{}", 10 * k, 40.0 + 4.0 * k, k); };
  EXPECT_TRUE(holds(said(find(high)), "refused: muscle_pressure is up to 83.6 bar", "unit: psi"));
  EXPECT_TRUE(holds(said(find(high, "ms", "atm")), "write the unit, zero and factor of its gauge"));
  EXPECT_TRUE(holds(said(find(ten_times, "ms", "psi")), "as kPa it would be 8.36 bar", "unit: kPa"));
  try {
    find(ten_times, "ms", "atm");
    ADD_FAILURE() << "847 bar";
  } catch (const input::BadInput& bad) {
    EXPECT_TRUE(holds(bad.problems().front().message, "is it in another unit", "unit: kPa"));
  }
  EXPECT_TRUE(holds(said(find(good, "ms", "mbar")), "refused: muscle_pressure is never above 0.00229 bar",
                    "unit: bar"));
  EXPECT_TRUE(holds(said(find([](int k) {
                      return fmt::format("{},{},{}", 10 * k, k < 40 ? 1.012 : 1.012 + 0.02 * (k - 40), k);
                    })),
                    "doubtful: muscle_pressure rests at 1.012 bar: is it absolute?", "zero: 1.013"));
}

TEST_F(PlausibleData, AbsolutePressuresThatNeverRest) {
  const auto above = [](int k) {
    return fmt::format("{},{:.3f},{:.2f}", 10 * k, 1.013 + 0.01 * k + 0.004 * (k % 3), k * 0.1);
  };
  EXPECT_EQ(said(find(above)), "") << "the other run goes below one atmosphere";
  EXPECT_TRUE(
      holds(said(find(above, "ms", "bar", "a.csv")), "muscle_pressure rests at 1.0", "is it absolute?"));
}

TEST_F(PlausibleData, PressuresInOtherUnitsProposeOneThatIsRead) {
  const auto up_to = [](double most) {
    return [=](int k) { return fmt::format("{},{},{}", 10 * k, most * (0.1 + 0.0045 * k), 0.1 * k); };
  };
  for (const auto& [number, unit, meant] : {std::tuple{90.0, "bar", "psi"},
                                            {600.0, "psi", "kPa"},
                                            {6000.0, "kPa", "mbar"},
                                            {6.0, "MPa", "bar"},
                                            {0.06, "bar", "MPa"}}) {
    const std::string text = said(find(up_to(number), "ms", unit));
    EXPECT_TRUE(
        holds(text, "refused: muscle_pressure is", fmt::format("unit: {}, as: input", meant).c_str()));
    EXPECT_EQ(text.find("refused"), 0u);
  }
  const std::string unknown = said(find(up_to(60.0), "ms", "kgf/cm2"));
  EXPECT_TRUE(holds(unknown, "write the unit, zero and factor of its gauge", "unit: \"kgf/cm2\""));
}

TEST_F(PlausibleData, OneFileUnderTwoLoads) {
  EXPECT_TRUE(holds(said(find(good, "ms", "bar", "a.csv")),
                    "doubtful: holds the same rows as run a, under another load (5 and 9 kg)"));
}

TEST_F(PlausibleData, StepsCoarserThanTheSensor) {
  EXPECT_TRUE(
      holds(said(find([](int k) { return fmt::format("{},{},{}", 10 * k, 0.3 + 0.01 * k, k / 20 * 2); })),
            "doubtful: contraction is in steps",
            "sensors: [{signal: contraction, kind: laser, resolution: 2 mm}]"));
}

TEST_F(PlausibleData, StepsOfRowsEachTick) {
  std::string text = "time_s,current_mA,contraction_ratio\n";
  for (int k = 0; k < 200; ++k) text += fmt::format("{:.3f},{},{}\n", 0.012 * k, 0.05 * k, k / 20 * 0.005);
  place_.write("a.csv", text);
  place_.write("dataset.yaml",
               "schema: mckibben-dataset/1\nrig: thesis\nruns: [{id: a, file: a.csv, load: 5 kg}]\n");
  EXPECT_TRUE(holds(said(implausible(input::read_dataset(place_))), "doubtful: contraction is in steps",
                    "kind: laser, resolution: 1.5 mm"));
}

}  // namespace
}  // namespace mckibben::data
