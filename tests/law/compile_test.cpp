// Laws in words: what they come to, what their units are, and what is said of those that are wrong, and
// where.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "own_law.hpp"
#include "says.hpp"

namespace mckibben::law {
namespace {

const Dimension newton_per_metre = newton.times(metre, -1.0);

Wording wording(const std::string& law, std::vector<Wording::Memory> memories = {}) {
  return {plant::LawTarget::force,
          law,
          {{"k", newton_per_metre}, {"tau", second}, {"n", ratio}},
          std::move(memories)};
}

struct Said {
  std::string message;
  std::size_t offset;
};
std::vector<Said> said_of(const Wording& law) {
  std::vector<Fault> faults;
  EXPECT_FALSE(compile(law, few_units, faults).has_value()) << law.law;
  std::vector<Said> list;
  for (const Fault& fault : faults) list.push_back({fault.message, fault.offset});
  return list;
}
void expect_said(const std::string& law, const std::string& part, std::size_t offset) {
  const auto said = said_of(wording(law));
  ASSERT_EQ(said.size(), 1u) << law;
  EXPECT_TRUE(holds(said.front().message, part)) << law << ": " << said.front().message;
  EXPECT_EQ(said.front().offset, offset) << law << ": " << said.front().message;
}

/// Of k = 200 N/m, tau = 2 s, n = 1.5 at e = 0.1, x = 0.03 m, v = -0.2 m/s, P = 3e5 Pa and so on.
double value(const std::string& law) {
  std::vector<Fault> faults;
  Wording words = wording("k * x");
  words.law = law;
  words.adds = plant::LawTarget::friction_factor;
  const auto programs = compile(words, few_units, faults);
  if (!programs) {
    ADD_FAILURE() << law << ": " << faults.front().message;
    return 0.0;
  }
  const std::array<double, plant::most_law_parameters> parameters{200.0, 2.0, 1.5};
  return plant::value_of(programs->law,
                         plant::LawNumbers<double, double>{
                             {0.1, 0.03, -0.2, 3e5, 2e5, 150.0, 98.0, 2.5e5, 7.0}, parameters, {}});
}

TEST(Law, BindsAsPeopleCalculate) {
  EXPECT_DOUBLE_EQ(value("1 + 2 * 3"), 7.0);
  EXPECT_DOUBLE_EQ(value("-2^2"), -4.0);
  EXPECT_DOUBLE_EQ(value("2^3^2"), 512.0);
  EXPECT_DOUBLE_EQ(value("2^-1"), 0.5);
  EXPECT_DOUBLE_EQ(value("8 / 4 / 2"), 1.0);
  EXPECT_DOUBLE_EQ(value("7 - 4 - 2"), 1.0);
  EXPECT_DOUBLE_EQ(value(" ( 1+2 )*3 "), 9.0);
  EXPECT_DOUBLE_EQ(value("- -e"), 0.1);
  EXPECT_DOUBLE_EQ(value("1.5e-3 + .5"), 0.5015);
}

TEST(Law, KnowsTheInputsAndFunctions) {
  EXPECT_DOUBLE_EQ(value("k * x / load"), 200.0 * 0.03 / 98.0);
  EXPECT_DOUBLE_EQ(value("F_braid / load"), 150.0 / 98.0);
  EXPECT_DOUBLE_EQ(value("P / P_valve - command / P"), 3.0 / 2.0 - 2.5 / 3.0);
  EXPECT_DOUBLE_EQ(value("tanh(v / 1 [mm/s])"), std::tanh(-200.0));
  EXPECT_DOUBLE_EQ(value("exp(-t / tau) + log(n) * sqrt(e)"),
                   std::exp(-3.5) + std::log(1.5) * std::sqrt(0.1));
  EXPECT_DOUBLE_EQ(value("sin(2*pi*x/0.1 [m]) + cos(e)"),
                   std::sin(2 * std::numbers::pi * 0.3) + std::cos(0.1));
  EXPECT_DOUBLE_EQ(value("max(e, 0.2) - min(e, 0.2) + abs(v) / abs(-v)"), 0.2 - 0.1 + 1.0);
  EXPECT_DOUBLE_EQ(value("e^n"), std::pow(0.1, 1.5));
  EXPECT_DOUBLE_EQ(value("sqrt(x^2) / x"), 1.0);
}

TEST(Law, ChoosesByComparison) {
  EXPECT_DOUBLE_EQ(value("if(v < 0, 1, 2)"), 1.0);
  EXPECT_DOUBLE_EQ(value("if(v > 0, 1, 2)"), 2.0);
  EXPECT_DOUBLE_EQ(value("if(e + 0 >= 0.1, 1, 2)"), 1.0);
  EXPECT_DOUBLE_EQ(value("if(e <= 0.05, 1, if(x > 0.01 [m], 3, 4))"), 3.0);
}

TEST(Law, ConstantsAreCalculatedOnce) {
  std::vector<Fault> faults;
  const auto programs = compile(wording("k * x * (2 + 3)^2 / sqrt(4) * max(1, 2)"), few_units, faults);
  ASSERT_TRUE(programs);
  // k x * 25 / 2 * 2
  EXPECT_EQ(programs->law.size(), 9u);
}

TEST(Law, UnitsMustFit) {
  expect_said("-k * (x - t)", "x is in m and t in s: they cannot be subtracted", 8);
  expect_said("-k * e", "-k * e is in N/m; adds: force wants N", 0);
  expect_said("k * x * tanh(v)", "v is in m/s; tanh wants a number without a unit", 13);
  expect_said("k * x + 3", "k * x is in N and 3 in 1", 6);
  expect_said("k * x^n", "x is in m: to a power that may change it must have no unit", 4);
  expect_said("k * x * 2^tau", "the exponent tau is in s", 10);
  expect_said("k * x * 2^e", "neither a number nor a parameter", 10);
  expect_said("if(v > x, k * x, -k * x)", "cannot be compared", 5);
  expect_said("k * x * 1 [parsec]", "parsec is not a unit", 8);
  std::vector<Fault> faults;  // a zero measures anything
  EXPECT_TRUE(compile(wording("k * max(x, 0) * if(v > 0, 1, 0)"), few_units, faults));
}

TEST(Law, MemoriesMeasureWhatTheyMeet) {
  std::vector<Fault> faults;
  const auto units = [&](const std::string& law, std::vector<Wording::Memory> memories) {
    const auto programs = compile(wording(law, std::move(memories)), few_units, faults);
    std::string list;
    for (std::size_t i = 0; programs && i < programs->memories.size(); ++i)
      list += programs->memories[i].dimension.unit() + " ";
    return list + (faults.empty() ? "" : faults.front().message);
  };
  EXPECT_EQ(units("-k * (x - q)", {{"q", "(x - q) / tau"}}), "m ");
  EXPECT_EQ(units("k * x * tanh(q)", {{"q", "v / 1 [m]"}}), "1 ");
  EXPECT_EQ(units("k * (a + b)", {{"a", "(b - a) / tau"}, {"b", "(x - b) / tau"}}), "m m ");
  EXPECT_EQ(units("k * q / tau", {{"q", "x"}}), "m.s ");
  EXPECT_TRUE(holds(units("-k * (x - q)", {{"q", "(x - q) * 2"}}), "q is in m, so that its rate is m/s"));
  faults.clear();
  EXPECT_TRUE(holds(units("k * x * q", {{"q", "q / tau"}}), "the unit of q is unknown"));
}

TEST(Law, WhatIsNoExpressionIsShownWhereItEnds) {
  expect_said("", "empty", 0);
  expect_said("  ", "empty", 0);
  expect_said("k * (x", "never closed", 4);
  expect_said("k * x)", "never opened", 5);
  expect_said("k * x 3", "should end here", 6);
  expect_said("k * ", "is wanted here", 4);
  expect_said("k * x + * 3", "is wanted here", 8);
  expect_said("k * min(x, ) ", "is wanted here", 11);
  expect_said("k * x * 1 [m", "never closed", 12);
  expect_said("k * min(x)", "min takes 2 arguments, not 1", 4);
  expect_said("k * x * 1e999", "out of range", 8);
  expect_said("k * x / (2 - 2)", "division by (2 - 2), which is zero", 6);
  expect_said("k * x * log(-1)", "not a finite number", 8);
  expect_said("x > 0", "a comparison is no value", 0);
  expect_said("if(x, k * x, 0)", "must be a comparison", 3);
  expect_said("sin", "sin is a function", 0);
  expect_said("foo(x)", "unknown function foo", 0);
  EXPECT_EQ(said_of(wording("kk * xx")).size(), 2u);  // all of them
}

TEST(Law, IsNoLongerThanOneThatIsCompiled) {
  const auto sum = [](std::size_t terms) {
    std::string text = "k * (x";
    for (std::size_t i = 1; i < terms; ++i) text += " + x";
    return text + ")";
  };
  std::vector<Fault> faults;
  EXPECT_TRUE(compile(wording(sum(31)), few_units, faults));  // 31 x, 30 +, k, *: 63
  expect_said(sum(32), "65 operations; a law has at most 64", 0);
  expect_said("k * " + std::string(25, '(') + "x" + std::string(25, ')'), "nested deeper", 28);
  expect_said("k * x" + std::string(1000, ' '), "longer than 1000", 1000);
  std::string deep = "x";
  for (int i = 0; i < 16; ++i) deep = "max(x, " + deep + ")";
  EXPECT_TRUE(holds(said_of(wording("k * " + deep)).front().message, "wait for their operators"));
}

TEST(Law, NoTextBreaksTheParser) {
  const std::vector<std::string> words{"k",   "x",   "q",    "(",   ")", "+", "-",     "^",
                                       "*",   "/",   "min(", "if(", ",", "<", ">=",    "1",
                                       "1e5", "[m]", "[",    "]",   " ", ".", "tanh(", "\xc3\xa9"};
  std::mt19937 random(3);
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (auto left = random() % 20; left > 0; --left) text += words[random() % words.size()];
    std::vector<Fault> faults;
    const bool good = compile(wording(text, {{"q", text}}), few_units, faults).has_value();
    EXPECT_NE(good, !faults.empty()) << text;
    for (const Fault& fault : faults) {
      EXPECT_LE(fault.offset, text.size()) << text;
      EXPECT_LT(fault.message.size(), 400u) << text;
    }
  }
}

}  // namespace
}  // namespace mckibben::law
