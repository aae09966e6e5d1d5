// Tables that hold several runs, or several clocks: which rows are a run's, and at which times.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/input/dataset_file.hpp>

#include "says.hpp"
#include "scratch.hpp"

namespace mckibben::input {
namespace {

class Arranged : public ::testing::Test {
 protected:
  /// The first run of a data set of `table`; its line of time and of contraction, and what the run says
  /// besides.
  Dataset read(const std::string& table, const std::string& time, const std::string& contraction,
               const std::string& run = "", const std::string& more = "") const {
    place_.write("r.csv", table);
    place_.write("dataset.yaml",
                 "schema: mckibben-dataset/1\nrig: thesis\nstart: settled\n" + more + "columns:\n  time: {" +
                     time + "}\n  muscle_pressure: {column: p, unit: bar, as: input}\n  contraction: {" +
                     contraction + "}\nruns:\n  - {id: r, file: r.csv, load: 5 kg" + run + "}\n");
    return read_dataset(place_);
  }
  std::string refused(const std::string& table, const std::string& time, const std::string& run = "",
                      const std::string& more = "",
                      const std::string& contraction = "column: x, unit: mm") const {
    try {
      read(table, time, contraction, run, more);
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return "accepted";
  }
  static std::vector<double> times(const Dataset& data) { return data.runs[0].measured->time_s; }
  static std::vector<double> pressures(const Dataset& data) {
    return data.runs[0].measured->given("muscle_pressure");
  }

  Scratch place_;
};

constexpr const char* in_ms = "column: t, unit: ms";
constexpr const char* x_mm = "column: x, unit: mm";
constexpr const char* fills = "t,p,x\n0,1,0\n10,2,1\n20,3,2\n30,4,3\n0,1,5\n10,2,6\n20,3,7\n30,4,8\n";

TEST_F(Arranged, AClockThatBeginsAgainIsAnotherRun) {
  EXPECT_TRUE(holds(refused(fills, in_ms), "r.csv:6:1", "holds 2 runs", "segment: 1 to segment: 2"));
  const Dataset data = read(fills, in_ms, x_mm, ", segment: 2");
  EXPECT_EQ(times(data), (std::vector<double>{0, 0.01, 0.02, 0.03}));
  EXPECT_NEAR(data.runs[0].measured->read("contraction")[0] * data.rig.muscle.rest_length_m, 0.005, 1e-12);
  EXPECT_TRUE(holds(refused(fills, in_ms, ", segment: 3"), "segment = 3: the file has 2"));
}

TEST_F(Arranged, AColumnSaysWhichRowsAreARun) {
  const std::string table = "t,p,x,cycle\n0,1,0,1\n10,2,1,1\n20,3,2,2\n30,4,3,2\n40,4,3,2\n";
  EXPECT_EQ(times(read(table, in_ms, x_mm, ", where: {cycle: 2}")), (std::vector<double>{0.02, 0.03, 0.04}));
  EXPECT_EQ(times(read(table, in_ms, x_mm, ", cut: cycle, segment: 2")),
            (std::vector<double>{0.02, 0.03, 0.04}));
  EXPECT_TRUE(holds(refused(table, in_ms, ", where: {cycle: 3}"), "no row has 3 in cycle (found: 1, 2)"));
}

TEST_F(Arranged, AMarkOfOneRowBeginsAPart) {
  const std::string table = "t,p,x,start\n0,1,0,1\n10,2,1,0\n20,3,2,0\n30,4,3,1\n40,4,3,0\n50,4,3,0\n";
  EXPECT_EQ(times(read(table, in_ms, x_mm, ", cut: start, segment: 2")),
            (std::vector<double>{0.03, 0.04, 0.05}));
}

TEST_F(Arranged, AWindowOfTime) {
  const Dataset data =
      read("t,p,x\n100,1,0\n110,2,1\n120,3,2\n130,4,3\n", in_ms, x_mm, ", from: 10 ms, to: 20 ms");
  EXPECT_EQ(times(data), (std::vector<double>{0.11, 0.12}));
}

TEST_F(Arranged, ReadingsWithAClockOfTheirOwn) {
  const Dataset data = read("tp,p,tx,x\n0,1,5,1\n20,2,25,2\n40,3,45,3\n60,4,65,4\n", "column: tp, unit: ms",
                            "column: x, unit: mm, time: tx");
  EXPECT_EQ(times(data), (std::vector<double>{0, 0.005, 0.02, 0.025, 0.04, 0.045, 0.06}));
  EXPECT_NEAR(pressures(data)[1], 1.25e5, 1e-6) << "a given pressure runs straight";
  EXPECT_TRUE(std::isnan(data.runs[0].measured->read("contraction")[0]));
}

TEST_F(Arranged, ReadingsThatAreStampedLate) {
  const std::string table = "t,p,x\n0,1,0\n20,2,1\n40,3,2\n60,4,3\n";
  const Dataset data = read(table, in_ms, "column: x, unit: mm, late: 35 ms");
  ASSERT_EQ(times(data).size(), 6u) << "at 5 and 25 ms, too; the first two were read before the input";
  EXPECT_NEAR(times(data)[1], 0.005, 1e-12);
  const auto& read_ratio = data.runs[0].measured->read("contraction");
  EXPECT_TRUE(std::isnan(read_ratio[0]));
  EXPECT_NEAR(read_ratio[1] * data.rig.muscle.rest_length_m, 0.002, 1e-12);
  EXPECT_NEAR(read_ratio[3] * data.rig.muscle.rest_length_m, 0.003, 1e-12);
  EXPECT_EQ(times(read(table, in_ms, "column: x, unit: mm, late: 20 ms")).size(), 4u) << "on a stamp";
  EXPECT_TRUE(holds(refused(table, "column: t, unit: ms, late: 5 ms"), "late"));
}

// What the rig's tick says of rows that have no time is said of their readings, too.
TEST_F(Arranged, ReadingsWithoutTimeAreStampedLate) {
  place_.write("r.csv", "current_mA,x\n4,0\n4,1\n5,2\n6,3\n");
  const std::string
      head = "schema: mckibben-dataset/1\nrig: thesis\ncolumns:\n  ",
      run = "  contraction: {column: x, unit: mm, late: 12 ms}\nruns: [{id: r, file: r.csv, load: 5 kg}]\n";
  place_.write("dataset.yaml", head + "rows_are_ticks: true\n" + run);
  const Dataset data = read_dataset(place_);
  EXPECT_EQ(times(data).size(), 4u);
  EXPECT_NEAR(data.runs[0].measured->read("contraction")[0] * data.rig.muscle.rest_length_m, 0.001, 1e-12);
  place_.write("dataset.yaml", head + "settled: {each: 5 s}\n" + run);
  EXPECT_THROW(read_dataset(place_), BadInput);
}

TEST_F(Arranged, AnotherClockBeforeAQuantityIsAsked) {
  const std::string two = "tp,p,time_x,x\n0,1,0,1\n20,2,12,2\n40,3,24,3\n60,4,36,4\n";
  EXPECT_TRUE(holds(refused(two, "column: tp, unit: ms"), "r.csv:1:6",
                    "time_x is another clock than tp, and stands before x", "time: time_x"));
  EXPECT_EQ(refused(two, "column: tp, unit: ms", "", "", "column: x, unit: mm, time: time_x"), "accepted");
  EXPECT_EQ(refused(two, "column: tp, unit: ms", "", "", "column: x, unit: mm, time: tp"), "accepted");
  EXPECT_EQ(
      refused("tp,p,time_x,x\n0,1,0,1\n20,2,0.02,2\n40,3,0.04,3\n60,4,0.06,4\n", "column: tp, unit: ms"),
      "accepted")
      << "the same in s";
}

TEST_F(Arranged, CommandsInVoltsStayBesideReadingsWithAClockOfTheirOwn) {
  place_.write("r.csv", "tp,u,tx,x\n0,1,5,1\n20,2,25,2\n40,3,45,3\n60,4,65,4\n");
  place_.write("dataset.yaml",
               "schema: mckibben-dataset/1\nrig: {base: thesis, valve: {zero_command: 0 V, span_command: 10 "
               "V, zero_pressure: 0.5 bar, span_pressure: 5 bar}}\n"
               "columns:\n  time: {column: tp, unit: ms}\n  command: {column: u, unit: V}\n"
               "  contraction: {column: x, unit: mm, time: tx}\nruns: [{id: r, file: r.csv, load: 5 kg}]\n");
  const Dataset data = read_dataset(place_);
  EXPECT_EQ(data.runs[0].measured->given("command"), (std::vector<double>{1, 1, 2, 2, 3, 3, 4}));
}

TEST_F(Arranged, ACommandInMilliamperesHasRowsAndAClockOfItsOwn) {
  const auto given = [&](const std::string& table, const std::string& command,
                         const std::string& contraction) {
    place_.write("r.csv", table);
    place_.write("dataset.yaml",
                 "schema: mckibben-dataset/1\nrig: thesis\ncolumns:\n  time: {column: t, unit: ms}\n  " +
                     command + "\n  contraction: {" + contraction +
                     "}\nruns: [{id: r, file: r.csv, load: 5 kg}]\n");
    return read_dataset(place_).runs[0].measured->given("command");
  };
  for (const char* key : {"command", "current"}) {
    EXPECT_EQ(given("t,what,value\n0,I,4\n5,x,1\n20,I,5\n25,x,2\n40,I,6\n",
                    fmt::format("{}: {{column: value, unit: mA, where: {{what: I}}}}", key),
                    "column: value, unit: mm, where: {what: x}"),
              (std::vector<double>{4, 4, 5, 5, 6}))
        << key;
    EXPECT_EQ(given("t,x,ti,i\n0,1,5,4\n20,2,25,5\n40,3,45,6\n60,4,65,7\n",
                    fmt::format("{}: {{column: i, unit: mA, time: ti}}", key), "column: x, unit: mm"),
              (std::vector<double>{4, 4, 5, 5, 6, 6, 7}))
        << key;
  }
}

TEST_F(Arranged, StampsOfALongTableMayRepeat) {
  std::string above, below, side_by_side;
  for (int k = 0; k < 20; ++k) {
    const std::string p = fmt::format("{},p,{}\n", 20 * k, 1 + 0.1 * k),
                      x = fmt::format("{},x,{}\n", 20 * k, k);
    above += p;
    below += x;
    side_by_side += p + x;
  }
  for (const std::string& text : {above + below, side_by_side}) {
    place_.write("r.csv", "t,what,value\n" + text);
    place_.write("dataset.yaml",
                 "schema: mckibben-dataset/1\nrig: thesis\ncolumns:\n  time: {column: t, unit: ms}\n"
                 "  muscle_pressure: {column: value, unit: bar, as: input, where: {what: p}}\n"
                 "  contraction: {column: value, unit: mm, where: {what: x}}\n"
                 "runs: [{id: r, file: r.csv, load: 5 kg}]\n");
    const Dataset data = read_dataset(place_);
    ASSERT_EQ(times(data).size(), 20u);
    EXPECT_NEAR(times(data)[7], 0.14, 1e-12);
    EXPECT_NEAR(pressures(data)[7], 1.7e5, 1e-6);
    EXPECT_TRUE(data.remarks.empty());
  }
}

TEST_F(Arranged, ALongTableIsTurned) {
  place_.write("r.csv", "t,what,value\n0,p,1\n5,x,1\n20,p,2\n25,x,2\n40,p,3\n");
  place_.write("dataset.yaml",
               "schema: mckibben-dataset/1\nrig: thesis\ncolumns:\n  time: {column: t, unit: ms}\n  "
               "muscle_pressure: {column: "
               "value, unit: bar, as: input, where: {what: p}}\n  contraction: {column: value, unit: mm, "
               "where: {what: "
               "x}}\nruns: [{id: r, file: r.csv, load: 5 kg}]\n");
  const Dataset data = read_dataset(place_);
  EXPECT_EQ(times(data), (std::vector<double>{0, 0.005, 0.02, 0.025, 0.04}));
  EXPECT_NEAR(pressures(data)[3], 2.25e5, 1e-6);
}

TEST_F(Arranged, GapsOfAGivenPressureAreBridgedSoFar) {
  const std::string gap = "t,p,x\n0,1,0\n100,,1\n200,3,2\n300,4,3\n";
  EXPECT_NEAR(pressures(read(gap, in_ms, x_mm))[1], 2e5, 1e-6);
  EXPECT_NEAR(pressures(read(gap, in_ms, x_mm, "", "hold: previous\n"))[1], 1e5, 1e-6);
  EXPECT_TRUE(holds(refused(gap, in_ms, "", "bridge: 0.1 s\n"), "r.csv:3:5",
                    "p: it is missing here, for 0.2 s", "bridge"));
  EXPECT_TRUE(holds(refused("t,p,x\n0,,0\n10,2,1\n20,3,1\n", in_ms), "r.csv:2:3",
                    "p: it is missing here; the run could begin later: from: 0.01 s"));
}

TEST_F(Arranged, IntervalsAddUp) {
  EXPECT_EQ(times(read("dt,p,x\n20,1,0\n20,2,1\n30,3,2\n", "column: dt, unit: ms, as: interval", x_mm)),
            (std::vector<double>{0, 0.02, 0.05}));
}

TEST_F(Arranged, StampsOfACoarseClockLieEvenly) {
  std::string table = "t,p,x\n";
  for (int k = 0; k < 20; ++k) table += std::to_string(k / 2) + ",1,0\n";
  const Dataset data = read(table, in_ms, x_mm);
  EXPECT_NEAR(times(data)[1], 0.0005, 1e-12);
  EXPECT_NEAR(times(data)[19], 0.0095, 1e-12);
  ASSERT_EQ(data.remarks.size(), 1u);
  EXPECT_TRUE(holds(data.remarks[0], "repeats 10 of 20 stamps"));
  std::string one = "t,p,x\n";
  for (int k = 0; k < 20; ++k) one += fmt::format("{},{},0\n", 10 * (k < 9 ? k : k - 1), k);
  EXPECT_NEAR(times(read(one, in_ms, x_mm))[9], 0.085, 1e-12) << "a single stamp that repeats";
  EXPECT_DOUBLE_EQ(times(read(one, in_ms, x_mm))[0], 0.0);
}

TEST_F(Arranged, RoundedStampsLieEvenly) {
  std::string table = "t,p,x\n", uneven = table;
  for (int k = 0; k < 100; ++k) {
    table += fmt::format("{:.2f},1,0\n", 0.012 * k);
    uneven += fmt::format("{:.4f},1,0\n", 0.012 * k + (k % 7 == 3 ? 0.004 : 0.0));
  }
  const Dataset data = read(table, "column: t, unit: s", x_mm);
  for (std::size_t k = 0; k < 100; ++k) EXPECT_NEAR(times(data)[k], 0.012 * static_cast<double>(k), 0.003);
  EXPECT_NEAR(times(data)[51] - times(data)[50], 0.012, 1e-4);
  ASSERT_EQ(data.remarks.size(), 1u);
  EXPECT_TRUE(holds(data.remarks[0], "t is rounded"));
  const Dataset jitter = read(uneven, "column: t, unit: s", x_mm);
  EXPECT_NEAR(times(jitter)[3], 0.040, 1e-9) << "stamps that tell more than their grid stay";
}

TEST_F(Arranged, RowsComeInTheOrderOfTheirClock) {
  const auto made = [](auto&& row) {
    std::string table = "t,p,x\n";
    for (int k = 0; k < 60; ++k) table += row(k);
    return table;
  };
  const auto plain = [](int k) { return fmt::format("{},{},{}\n", 10 * k, k, k % 9); };
  const Dataset newest_first = read(made([&](int k) { return plain(59 - k); }), in_ms, x_mm);
  EXPECT_EQ(times(newest_first), times(read(made(plain), in_ms, x_mm)));
  EXPECT_DOUBLE_EQ(pressures(newest_first)[0], 0.0);
  ASSERT_EQ(newest_first.remarks.size(), 1u);
  EXPECT_TRUE(holds(newest_first.remarks[0], "newest rows stand first"));
  for (const auto& [table, what] : std::vector<std::pair<std::string, std::string>>{
           {
               made([&](int k) { return plain(k) + (k == 20 ? plain(k) : ""); }),
               "r.csv:23:1",
           },
           {made(plain) + "30,2,3\n", "r.csv:62:1"},
           {made([&](int k) { return plain(k) + (k == 30 ? "9999,1,1\n" : ""); }), "r.csv:33:1"},
           {made([&](int k) { return plain(k) + (k == 30 ? ",1,1\n" : ""); }), "r.csv:33:1"}}) {
    const Dataset data = read(table, in_ms, x_mm);
    EXPECT_EQ(times(data), times(newest_first)) << what;
    ASSERT_EQ(data.remarks.size(), 1u);
    EXPECT_TRUE(holds(data.remarks[0], what)) << data.remarks[0];
  }
  EXPECT_TRUE(
      holds(refused(made([&](int k) { return k % 3 == 0 ? fmt::format(",{},1\n", k) : plain(k); }), in_ms),
            "r.csv:2:1", "t is missing here"))
      << "a row in three is another kind of table";
}

TEST_F(Arranged, CountersThatRunOverGoOn) {
  const auto steps = [&](const std::string& unit, auto&& stamp) {
    std::string table = "t,p,x\n";
    for (int k = 0; k < 200; ++k) table += fmt::format("{},{},{}\n", stamp(k), k % 50, k % 9);
    const Dataset data = read(table, "column: t, unit: " + unit, x_mm);
    std::vector<double> times_s = times(data);
    return times_s.size() == 200 ? times_s.back() - times_s.front() : 0.0;
  };
  EXPECT_NEAR(steps("ms", [](int k) { return (64000 + 12 * k) % 65536; }), 2.388, 1e-9);
  EXPECT_NEAR(steps("ms", [](int k) { return 12 * k % 1000; }), 2.388, 1e-9);
  EXPECT_NEAR(steps("us", [](int k) { return (4294900000LL + 12000LL * k) % 4294967296LL; }), 2.388, 1e-9);
  EXPECT_NEAR(steps("date",
                    [](int k) {
                      const int ms = 59000 + 12 * k;  // from 12:59 to 1:00
                      return fmt::format("{}:{:02}:{:02}.{:03}", ms < 60000 ? 12 : 1, ms < 60000 ? 59 : 0,
                                         ms / 1000 % 60, ms % 1000);
                    }),
              2.388, 1e-6);
  std::string runs = "t,p,x\n";  // two of a second each, from 0
  for (int k = 0; k < 200; ++k) runs += fmt::format("{},{},{}\n", 10 * (k % 100), k % 50, k % 9);
  EXPECT_TRUE(holds(refused(runs, in_ms), "holds 2 runs"));
}

TEST_F(Arranged, ANumberMayStandForNone) {
  const std::string table = "t,p,x\n0,1,0\n10,2,-9999\n20,3,2\n";
  const Dataset data = read(table, in_ms, "column: x, unit: mm, missing: -9999");
  EXPECT_TRUE(std::isnan(data.runs[0].measured->read("contraction")[1]));
  std::string many = "t,p,x\n";
  for (int k = 0; k < 50; ++k) many += fmt::format("{},1,{}\n", 10 * k, k % 5 == 2 ? -9999 : k % 9);
  EXPECT_TRUE(holds(refused(many, in_ms), "write missing:"));
  EXPECT_TRUE(holds(refused(table, in_ms, "", "", "column: x, unit: mm, missing: none"),
                    "missing = none of x is not a number"));
}

TEST_F(Arranged, AReadingThatDropsOutNowAndThenIsNone) {
  const auto table = [](int every, const char* pressure = "1") {
    std::string text = "t,p,x\n";
    for (int k = 0; k < 200; ++k)
      text += fmt::format("{},{},{}\n", 10 * k, k == 33 ? pressure : "1",
                          k % every == 33 ? "999.999" : std::to_string(k % 9));
    return text;
  };
  const Dataset data = read(table(100), in_ms, x_mm);
  const auto& values = data.runs[0].measured->read("contraction");
  EXPECT_TRUE(std::isnan(values[33]) && std::isnan(values[133]) && !std::isnan(values[34]));
  EXPECT_TRUE(holds(fmt::format("{}", fmt::join(data.remarks, "\n")),
                    "r.csv:35:", "x: contraction_ratio = ", "is out of range",
                    "as 2 of 200 rows are; taken as not read", "write missing: 999.999 in"));
  EXPECT_TRUE(holds(refused(table(40), in_ms), "out of range", "write missing:")) << "too often";
  EXPECT_TRUE(holds(refused(table(100, "1e4"), in_ms),
                    "r.csv:35:", "muscle_pressure_bar = 10000 is out of range",
                    "write missing: 10000 in the place of its column"))
      << "it drives the simulation";
}

TEST_F(Arranged, TheFirstAndTheLastStampMayHaveAPartOfTheirRows) {
  std::string table = "t,p,x\n";
  for (int k = 7; k < 54; ++k) table += std::to_string(k / 10) + ",1,0\n";
  const Dataset data = read(table, "column: t, unit: s", x_mm);
  for (const std::size_t row : {0U, 1U, 3U, 46U})
    EXPECT_NEAR(times(data)[row], 0.7 + 0.1 * static_cast<double>(row), 1e-9) << row;
}

TEST_F(Arranged, RowsThatHaveLostACellAreLeftOutAndSaid) {
  std::string table = "t,p,x\n";
  for (int k = 0; k < 20; ++k) table += k == 7 ? "70,1\n" : fmt::format("{},1.{},0\n", 10 * k, k);
  const Dataset data = read(table, in_ms, x_mm);
  EXPECT_EQ(times(data).size(), 19u);
  EXPECT_TRUE(holds(data.remarks.at(0), "1 row lacks cells, the first in line 9"));
}

TEST_F(Arranged, WordsBetweenRowsAndAnotherTable) {
  EXPECT_EQ(refused("t,p,x\n0,1,0\n10,2,1\n20,3,2\nEVENT: trigger, on\n30,4,3\n40,4,3\n", in_ms), "accepted");
  EXPECT_TRUE(holds(refused("t,p,x\n0,1,0\n10,2,1\n20,3,2\ntime,kPa,x\n30,4,3\n40,4,3\n", in_ms),
                    "r.csv:5:1: error: another table begins here"));
}

TEST_F(Arranged, StampsSince1970LoseNoDigit) {
  const Dataset data =
      read("t,p,x\n1700000000123456789,1,0\n1700000000123456889,2,1\n1700000000143456789,3,2\n",
           "column: t, unit: ns", x_mm);
  EXPECT_DOUBLE_EQ(times(data)[1], 1e-7);
  EXPECT_DOUBLE_EQ(times(data)[2], 0.02);
  EXPECT_TRUE(holds(data.remarks.at(0), "stamps begin at 1700000000123456789"));
}

TEST_F(Arranged, AHeadingThatContradictsTheMapIsAsked) {
  EXPECT_TRUE(holds(refused("t_ms,p,x\n0,1,0\n10,2,1\n20,3,2\n", "column: t_ms, unit: s"),
                    "its heading says ms, and it is read in s", "time: {column: t_ms, unit: ms}",
                    "factor: 1"));
  EXPECT_EQ(refused("t_ms,p,x\n0,1,0\n10,2,1\n20,3,2\n", "column: t_ms, unit: s, factor: 1"), "accepted");
}

// -1 says which way it falls, and no unit: a line that says both is offered.
TEST_F(Arranged, AHeadingThatContradictsTheMapOfWhatFalls) {
  const std::string table = "t,p,x [cm]\n0,1,0\n10,2,-1\n20,3,-2\n";
  const std::string asked = refused(table, in_ms, "", "", "column: \"x [cm]\", unit: mm, factor: -1");
  EXPECT_TRUE(holds(asked, "its heading says cm, and it is read in mm",
                    "unit: cm, factor: -1}}, if it is right", "unit: cm, factor: -0.1} if it is not"))
      << asked;
  EXPECT_EQ(refused(table, in_ms, "", "", "column: \"x [cm]\", unit: cm, factor: -0.1"), "accepted");
}

TEST_F(Arranged, AHeadingWithAUnitOfAnotherKindIsAskedForAFactor) {
  const auto said = [&](const std::string& heading, const std::string& more = "") {
    return refused("t,p," + heading + "\n0,1,0\n10,2,1\n20,3,2\n", in_ms, "", "",
                   "column: \"" + heading + "\", unit: mm" + more);
  };
  EXPECT_TRUE(holds(said("wire (V)"),
                    "r.csv:2:5: error: wire (V): its heading says V, and it is read in mm; write factor: how "
                    "many mm are 1 V, also if it is 1, and zero: the V at rest length"));
  EXPECT_TRUE(holds(said("wire_mA"), "its heading says mA"));
  EXPECT_TRUE(holds(said("wire [bar]"), "its heading says bar"));
  EXPECT_EQ(said("wire (V)", ", factor: 10"), "accepted");
  for (const char* no_unit : {"x_V", "x (1)", "x_min", "x (left)"}) EXPECT_EQ(said(no_unit), "accepted");
}

}  // namespace
}  // namespace mckibben::input
