// Numbers and quantities: every unit the project's files use, and every way of getting one wrong.
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>

namespace mckibben::input {
namespace {

std::string problem_of(std::string_view text, std::string_view unit) {
  try {
    read_quantity(text, unit);
  } catch (const BadQuantity& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Number, StrictGrammar) {
  for (const char* good : {"0", "-0", "+3", "10", "0.5", "1e3", "1E-07", "1.25e+2", "5e-324"})
    EXPECT_TRUE(parse_number(good)) << good;
  for (const char* bad : {"", "-", "010", "00", ".5", "5.", "1e", "0x10", "1_000", "1,5", "inf", "nan",
                          "1e999", "1 2", " 1", "1 ", "--1", "1e+", "0e1e1"})
    EXPECT_FALSE(parse_number(bad)) << bad;
}

TEST(Number, WritesWhatReadsBackExactly) {
  for (const double value : {0.1, 1.0 / 3.0, 4.9e-324, 1.7976931348623157e308, -0.0, 123456789.0}) {
    const auto read = parse_number(write_number(value));
    ASSERT_TRUE(read) << write_number(value);
    EXPECT_EQ(*read, value);
    EXPECT_EQ(std::signbit(*read), std::signbit(value));
  }
}

TEST(Number, AMassInANameIsShortAndApartFromOthers) {
  const double five_lb = 5.0 * domain::pound_kg;  // 2.2679618500000003
  EXPECT_EQ(domain::kg_in_name(five_lb, {five_lb, 11.138}), "2.268");
  EXPECT_EQ(domain::kg_in_name(11.138, {five_lb, 11.138}), "11.138");
  EXPECT_EQ(domain::kg_in_name(11.13801, {11.13801, 11.138}), "11.13801");
  EXPECT_EQ(domain::kg_in_name(11.138, {11.138 + 1e-14, 11.138}), "11.138");
}

TEST(Number, IsRoundedToDigitsThatCount) {
  EXPECT_EQ(domain::significant(168.4, 2), 170.0);
  EXPECT_EQ(domain::significant(-0.004567, 2), -0.0046);
  EXPECT_EQ(domain::significant(9.96, 2), 10.0);
  EXPECT_EQ(domain::significant(0.0, 2), 0.0);
  EXPECT_EQ(domain::significant(-1599.7, 3), -1600.0);
}

struct Case {
  const char* text;
  const char* unit;
  double value;
};

TEST(Quantity, UnitsOfOurFiles) {
  const double degree = std::numbers::pi / 180.0;
  for (const Case& each : std::vector<Case>{{"30 mm", "m", 0.03},
                                            {"12 ms", "s", 0.012},
                                            {"5 bar", "Pa", 5e5},
                                            {"5bar", "Pa", 5e5},
                                            {"250 mbar", "Pa", 25e3},
                                            {"1 kgf/m2", "Pa", 9.80665},
                                            {"20 deg", "rad", 20 * degree},
                                            {"20 degree", "rad", 20 * degree},
                                            {"20 °", "rad", 20 * degree},
                                            {"20 Grad", "rad", 20 * degree},
                                            {"20 Winkelgrad", "rad", 20 * degree},
                                            {"2 N.m/Grad", "N.m/rad", 2 / degree},
                                            {"2 Grad/s", "rad/s", 2 * degree},
                                            {"2 Mrad", "rad", 2e6},
                                            {"0.35 rad", "rad", 0.35},
                                            {"20 degC", "K", 293.15},
                                            {"20 °C", "K", 293.15},
                                            {"12.5 mA", "mA", 12.5},
                                            {"0.0125 A", "mA", 12.5},
                                            {"5.6 mA/s", "mA/s", 5.6},
                                            {"400 N.s/m", "N.s/m", 400},
                                            {"400 N s/m", "N.s/m", 400},
                                            {"4e-9 m3/(s.Pa)", "m3/(s.Pa)", 4e-9},
                                            {"0.24 L/(min.bar)", "m3/(s.Pa)", 4e-11},
                                            {"2e-3 s2/mA2", "s2/mA2", 2e-3},
                                            {"287.05 J/(kg.K)", "J/(kg.K)", 287.05},
                                            {"1 kg.cm2", "kg.m2", 1e-4},
                                            {"3 N/mm", "N/m", 3e3},
                                            {"19 1/(m/s)", "s/m", 19},
                                            {"0.5 1/s", "Hz", 0.5},
                                            {"11138 g", "kg", 11.138},
                                            {"50 cm3", "m3", 5e-5},
                                            {"1.3", "1", 1.3},
                                            {"5 %", "1", 0.05},
                                            {" 7 m ", "m", 7}}) {
    if (std::string_view(each.text) == "19 1/(m/s)") {
      EXPECT_NEAR(read_quantity(each.text, each.unit), each.value, 1e-12);
      continue;
    }
    EXPECT_NEAR(read_quantity(each.text, each.unit), each.value, 1e-14 * std::abs(each.value)) << each.text;
  }
}

TEST(Quantity, SayWhatIsWrong) {
  EXPECT_EQ(problem_of("0.3", "m"), "0.3 has no unit; it is measured in m: for example 0.3 m");
  EXPECT_EQ(problem_of("5", "Pa"), "5 has no unit; it is measured in Pa: for example 5 bar");
  EXPECT_EQ(problem_of("20", "rad"), "20 has no unit; it is measured in rad: for example 20 deg");
  EXPECT_EQ(problem_of("0.1", "rad"),
            "0.1 has no unit; it is measured in rad: for example 0.1 rad, which is 5.73 deg");
  EXPECT_EQ(problem_of("3 kg", "Pa"), "3 kg: kg is the wrong kind of unit; wanted is Pa");
  EXPECT_EQ(problem_of("3 barr", "Pa"), "3 barr: barr is not a unit; wanted is Pa: for example 3 bar");
  const auto of_radius = [](const char* text) {
    try {
      read_quantity(text, "m", {.value = 0.0075, .lowest = 1e-3, .highest = 0.1});
    } catch (const BadQuantity& bad) {
      return std::string(bad.what());
    }
    return std::string();
  };
  const auto of_nothing_usual = [](std::string_view text, const char* unit, double highest) -> std::string {
    try {
      read_quantity(text, unit, {0.0, 0.0, highest});
    } catch (const BadQuantity& wrong) {
      return wrong.what();
    }
    return "";
  };
  EXPECT_EQ(of_nothing_usual("0.02", "m", 0.1), "0.02 has no unit; it is measured in m: for example 0.02 mm");
  EXPECT_EQ(of_nothing_usual("60", "Pa", 2e5), "60 has no unit; it is measured in Pa: for example 60 mbar");
  EXPECT_EQ(of_nothing_usual("0.02", "s", 10.0), "0.02 has no unit; it is measured in s: for example 0.02 s");
  EXPECT_EQ(of_radius("8"), "8 has no unit; it is measured in m: for example 7.5 mm");
  EXPECT_EQ(of_radius("0.008"), "0.008 has no unit; it is measured in m: for example 0.008 m");
  const Usual supply{.value = 6e5, .lowest = 1e3, .highest = 2e6};
  EXPECT_EQ(meant_quantity("8 Pa", "Pa", supply), "8 bar");
  EXPECT_EQ(meant_quantity("800000", "Pa", supply), "800000 Pa");
  EXPECT_EQ(meant_quantity("800 mbar", "Pa", supply), "") << "neither 800 bar nor 800 Pa";
  const Usual no_load{.value = 0.0, .lowest = 0.0, .highest = 500.0};
  EXPECT_EQ(meant_quantity("10200 kg", "kg", no_load), "10200 g");
  EXPECT_EQ(of_radius("0.09"), "0.09 has no unit; it is measured in m: for example 7.5 mm");
  EXPECT_EQ(of_radius("0.008 N"), "0.008 N: N is the wrong kind of unit; wanted is m: for example 7.5 mm");
  EXPECT_EQ(problem_of("1.3 s", "1"), "1.3 s must be a bare number, without a unit: for example 1.3");
  EXPECT_EQ(problem_of("1.3 mm", "1"),
            "1.3 mm must be a bare number, without a unit; as a contraction ratio it is the length "
            "divided by rest_length: 0.0052 if that is 250 mm");
  EXPECT_NE(problem_of("-100 %", "mA").find("zero_command: -100 V, span_command: 100 V"), std::string::npos);
  EXPECT_EQ(problem_of("010 mm", "m"), "010 mm is not a number: it must not begin with 0");
  EXPECT_EQ(problem_of("0,3 m", "m"), "0,3 m is not a number: the decimal sign is a point");
  EXPECT_EQ(problem_of(".3 m", "m"), ".3 m is not a number: write 0.3 m");
  EXPECT_EQ(problem_of("nan m", "m"), "nan m is not a number");
  EXPECT_EQ(problem_of("1e999 m", "m"), "1e999 is too large or too small for a number");
}

TEST(Quantity, RefusesWhatUdunitsWouldTake) {
  for (const char* text : {"5 3 kg", "5 kg 3", "5 kg @ 3", "5 kg since 4", "5 2kg", "0x10 kg", "inf kg",
                           "1e5", "5 kg;", "5 kg+3", "5 kg -3", "5 lg(re 1 kg)", "5 kg\n"})
    EXPECT_NE(problem_of(text, "kg"), "accepted") << text;
}

TEST(Quantity, AnglesAreNoRatiosAndHertzNoSeconds) {
  EXPECT_NE(problem_of("0.35 rad", "1"), "accepted");
  EXPECT_NE(problem_of("0.35", "rad"), "accepted");
  EXPECT_NE(problem_of("35 %", "rad"), "accepted");
  EXPECT_NE(problem_of("5 1/s", "rad"), "accepted");
  EXPECT_NE(problem_of("5 rad.m", "m"), "accepted");
  EXPECT_NE(problem_of("5 Hz", "s"), "accepted");
  EXPECT_NE(problem_of("5 m", "1/m"), "accepted");
}

TEST(Quantity, WrittenReadsBackBitForBit) {
  for (const char* unit : {"m", "rad", "Pa", "mA", "m3/(s.Pa)", "s2/mA2", "J/(kg.K)", "1"})
    for (const double value : {0.1, 1.0 / 3.0, 1.5e-8, 293.15, 0.0})
      EXPECT_EQ(read_quantity(write_quantity(value, unit), unit), value) << value << ' ' << unit;
}

TEST(Quantity, LimitsInTheUnitOfTheReader) {
  EXPECT_EQ(show_limit(2e6, "Pa", "50 bar"), "20 bar");
  EXPECT_EQ(show_limit(0.01, "m", "9 m"), "0.01 m");
  EXPECT_EQ(show_limit(std::numbers::pi / 18, "rad"), "10 deg");
  EXPECT_EQ(show_limit(0.5, "1", "7"), "0.5");
}

TEST(Quantity, SeveralThreadsAtOnce) {
  std::vector<std::thread> threads;
  threads.reserve(4);
  std::atomic<int> wrong = 0;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&wrong] {
      for (int k = 0; k < 200; ++k)
        if (std::abs(read_quantity("5 bar", "Pa") - 5e5) > 1e-6) ++wrong;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace mckibben::input
