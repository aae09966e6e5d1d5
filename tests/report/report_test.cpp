// The report's page: what is packed comes back, extremes survive, the page needs nothing but itself and stays
// small. How it looks and moves is tested in tests/browser.
#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/report/html.hpp>
#include <sim/report/length.hpp>
#include <sim/report/pack.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>
#include <sim/report/still.hpp>
#include <sim/report/tables.hpp>

#include "count.hpp"
#include "says.hpp"

namespace mckibben::report {
namespace {

/// What the page's script makes of a packed quantity.
std::vector<double> unpacked(const Packed& packed, std::size_t count) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto& [low, step, bits] = packed;
  if (bits.empty()) return std::vector<double>(count, low);
  std::vector<unsigned> bytes;
  unsigned held = 0, bits_held = 0;
  for (const char c : bits) {
    if (c == '=') break;
    held = held << 6 | static_cast<unsigned>(letters.find(c));
    bits_held += 6;
    if (bits_held >= 8) {
      bits_held -= 8;
      bytes.push_back(held >> bits_held & 255u);
    }
  }
  std::vector<double> values;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const unsigned code = bytes[i] | bytes[i + 1] << 8;
    values.push_back(code == 65535 ? std::numeric_limits<double>::quiet_NaN() : low + code * step);
  }
  EXPECT_EQ(values.size(), count);
  return values;
}

TEST(Pack, WritesBase64AsTheStandardDoes) {
  EXPECT_EQ(base64({}), "");
  EXPECT_EQ(base64({'f'}), "Zg==");
  EXPECT_EQ(base64({'f', 'o'}), "Zm8=");
  EXPECT_EQ(base64({'f', 'o', 'o', 'b', 'a', 'r'}), "Zm9vYmFy");
}

TEST(Pack, KeepsEveryTickOfAShortRunToA65534thOfItsRange) {
  const AtTick at = [](std::size_t k) { return 0.2 * std::sin(0.1 * static_cast<double>(k)); };
  EXPECT_EQ(ticks_per_column(500, 10), 1u);
  const auto values = unpacked(pack(at, 500, 500, 1), 500);
  for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(values[k], at(k), 0.4 / 65534.0) << k;
}

TEST(Pack, LeavesHolesWhereThereIsNoValue) {
  const AtTick at = [](std::size_t k) {
    return k == 2 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(k);
  };
  const auto values = unpacked(pack(at, 6, 4, 1), 6);
  EXPECT_NEAR(values[1], 1.0, 3.0 / 65534.0);
  for (const std::size_t hole : {2u, 4u, 5u}) EXPECT_TRUE(std::isnan(values[hole])) << hole;
  EXPECT_EQ(unpacked(pack([](std::size_t) { return 7.25; }, 3, 3, 1), 3), std::vector<double>(3, 7.25));
}

TEST(Pack, KeepsASpikeOfOneTickInALongRunAndItsOrder) {
  constexpr std::size_t ticks = 100000, spike = 54321;
  const AtTick at = [](std::size_t k) { return k == spike ? -3.0 : 1.0 + 1e-9 * static_cast<double>(k); };
  const std::size_t wide = ticks_per_column(ticks, 1);
  ASSERT_GT(wide, 1u);
  const auto values = unpacked(pack(at, ticks, ticks, wide), points(ticks, wide));
  EXPECT_LE(values.size(), 2000u);
  const std::size_t column = spike / wide;
  EXPECT_NEAR(std::min(values[2 * column], values[2 * column + 1]), -3.0, 1e-3);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i / 2 == column) continue;
    EXPECT_NEAR(values[i], 1.0, 1e-3) << i;
  }
}

TEST(Pack, AColumnWithSomeValuesHasTheirExtremes) {
  constexpr double hole = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> column{hole, 4.0, hole, 1.0, 2.0, hole, hole, hole, hole, hole};
  const auto values = unpacked(pack([&](std::size_t k) { return column[k]; }, 10, 10, 5), 4);
  EXPECT_NEAR(values[0], 4.0, 1e-4);
  EXPECT_EQ(values[1], 1.0);
  EXPECT_TRUE(std::isnan(values[2]) && std::isnan(values[3]));
}

/// Runs that shake as much as they can: the worst case for size.
Contents shaking(std::size_t groups, std::size_t ticks) {
  Contents contents{
      .title = "shaking </script><b>&'",
      .about = "",
      .sentence = "",
      .table = "",
      .details = "",
      .plots = plots_of({}, {.title = "Target and contraction", .given = "Target", .error = "Error"}),
      .loops = loops_of({}, {})};
  for (std::size_t g = 0; g < groups; ++g) {
    Group group{.name = "</script>", .ticks = ticks};
    const auto noise = [g](double seed) {
      return [seed, g](std::size_t k) {
        return std::sin(seed * static_cast<double>((k + 3) * (k + 7 + g) % 100003));
      };
    };
    group.given = {{"given_contraction_ratio", noise(1.1)}, {"weight", [](std::size_t) { return 100.0; }}};
    Run run{.name = "simulated", .ticks = ticks};
    double seed = 0.3;
    for (const char* key : {"contraction_ratio", "error", "current", "reference_pressure", "valve_pressure",
                            "muscle_pressure", "braid_force", "friction_force", "friction_coefficient"})
      run.quantities.push_back({key, noise(seed += 0.17)});
    group.runs.push_back(std::move(run));
    contents.groups.push_back(std::move(group));
  }
  return contents;
}

TEST(Page, AsksForNothingOutsideItselfAndCannotBeBrokenByNames) {
  const std::string html = html_of(shaking(2, 100));
  EXPECT_TRUE(lacks(html, " src=", "<link", "@import"));
  EXPECT_EQ(count(html, "<script"), count(html, "</script>"));
  EXPECT_EQ(count(html, "<script"), 4u);
  EXPECT_TRUE(holds(html, "shaking &lt;/script&gt;&lt;b&gt;&amp;&#39;", "The MIT License", "Leon Sorokin"));
}

TEST(Page, OfAHundredRunsStaysBelowTenMegabytesHoweverTheyShake) {
  EXPECT_LT(html_of(shaking(100, 1600)).size(), 10'000'000u);  // the longest that are not decimated
}

TEST(Page, OfOneWarningHasABoxAndOfManyOneBox) {
  Contents contents;
  contents.warnings = {"a < b"};
  EXPECT_EQ(count(html_of(contents), "class='warning'"), 1u);
  for (int i = 0; i < 5; ++i) contents.warnings.push_back("other");
  const std::string html = html_of(contents);
  EXPECT_EQ(count(html, "class='warning'"), 1u);
  EXPECT_EQ(count(html, "a &lt; b"), 1u);
  EXPECT_EQ(count(html, "<li>other"), 5u);
  EXPECT_TRUE(holds(html, "5 more warnings"));
}

TEST(Length, IsThereInBothUnitsWithTheSameDigits) {
  EXPECT_EQ(length_html(0.01, {}), "<span class='mm'>3.000</span><span class='ratio'>0.01000</span>");
  EXPECT_EQ(full_length_html(-0.01, {}, 1),
            "<span class='mm'>-3.0 mm</span><span class='ratio'>-0.010 (contraction ratio)</span>");
  EXPECT_TRUE(holds(length_html(0.01, {}, 3, true), "+3.000"));
}

/// What a reader sees who chose this unit, "mm" or "ratio".
std::string seen(std::string html, const std::string& unit) {
  const std::string other = unit == "mm" ? "ratio" : "mm";
  html = std::regex_replace(html, std::regex("<span class='" + other + "'>.*?</span>"), "");
  return std::regex_replace(html, std::regex("<span class='" + unit + "'>(.*?)</span>"), "$1");
}

TEST(Length, InTextIsInTheUnitThatTheReaderWants) {
  struct Case {
    const char *text, *mm, *ratio;
  };
  for (const auto& [text, mm, ratio] : {
           Case{"it falls from 3.4 mm to 0.038 mm.", "it falls from 3.4 mm to 0.038 mm.",
                "it falls from 0.0113 to 0.000127."},
           {"5 to 25 mm/s", "5 to 25 mm/s", "0.0167 to 0.0833 /s"},
           {"at a contraction ratio of 0.101 it asks 0.0303 /s",
            "at a contraction of 30.3 mm it asks 9.09 mm/s",
            "at a contraction ratio of 0.101 it asks 0.0303 /s"},
           {"contraction ratios of -0.001 to 0.21", "contractions of -0.3 to 63 mm",
            "contraction ratios of -0.001 to 0.21"},
           {"the smallest reachable one from above, held, is 0.1; 7 others",
            "the smallest reachable one from above, held, is 30 mm; 7 others",
            "the smallest reachable one from above, held, is 0.1; 7 others"},
           {"<r01> is 3 ticks late: 2 mA, 1e-6 m3/s", "&lt;r01&gt; is 3 ticks late: 2 mA, 1e-6 m3/s",
            "&lt;r01&gt; is 3 ticks late: 2 mA, 1e-6 m3/s"},
       }) {
    EXPECT_EQ(seen(text_html(text, {}), "mm"), mm);
    EXPECT_EQ(seen(text_html(text, {}), "ratio"), ratio);
  }
  EXPECT_EQ(seen(ratios_html("below 0.05", {}), "mm"), "below 15 mm");
  EXPECT_EQ(seen(ratios_html("below 0.05", {}), "ratio"), "below 0.05");
}

TEST(Page, WarningsAndSentencesFollowTheUnit) {
  Contents contents;
  contents.warnings = {"it asks a contraction ratio of 0.07"};
  const std::string html = html_of(contents);
  EXPECT_TRUE(holds(seen(html, "mm"), "it asks a contraction of 21 mm</p>"));
  EXPECT_TRUE(holds(seen(html, "ratio"), "it asks a contraction ratio of 0.07</p>"));
}

TEST(Still, AnAxisOfLengthsHasRoundNumbersInBothUnits) {
  Group group{.name = "1 kg", .ticks = 2};
  group.runs.push_back(
      {.name = "pid",
       .ticks = 2,
       .quantities = {{"contraction_ratio", [](std::size_t k) { return 0.1 * static_cast<double>(k); }},
                      {"muscle_pressure", [](std::size_t k) { return static_cast<double>(k); }}}});
  const std::string svg = loop_svg(group, loops_of({}, {}).front(), {}, 100);
  const auto mm = svg.find("<g class='mm'>"), ratio = svg.find("<g class='ratio'>");
  ASSERT_LT(mm, ratio);
  ASSERT_NE(ratio, std::string::npos);
  EXPECT_TRUE(holds(svg.substr(mm, ratio - mm), ">10<", ">20<", ">30<", "contraction in mm"));
  for (const char* number : {">0.04<", ">0.1<", ">contraction ratio<"})
    EXPECT_NE(svg.find(number, ratio), std::string::npos) << number;
  EXPECT_EQ(count(svg, ">muscle pressure in bar<"), 1u);
}

TEST(ByLoad, NamesTheWorstRunOfEachLoadAndLeadsToIt) {
  const std::string html =
      by_load_html({{"b", 20.0, 0.03, 0}, {"a", 10.0, 0.02, 1}, {"c", 20.0, 0.01, 2}}, {});
  const auto light = html.find(">10<"), heavy = html.find(">20<");
  ASSERT_LT(light, heavy);
  ASSERT_NE(heavy, std::string::npos);
  EXPECT_NE(html.find("<td>2</td><td><span class='mm'>6.000</span>", heavy), std::string::npos);  // median
  EXPECT_NE(html.find("<span class='mm'>9.000</span>", heavy), std::string::npos);
  EXPECT_NE(html.find("<a href='#group-0' data-group='0'>b</a>", heavy), std::string::npos);
}

/// A replay of so many runs, each worse than the one before: in ticks, or by stamps on a muscle of 180 mm
/// under a regulator that takes volts.
std::string replayed(std::size_t runs, bool by_stamps = false) {
  domain::Dataset data;
  data.path = "measured/dataset.yaml";
  if (by_stamps) {
    data.rig.muscle.rest_length_m = 0.18;
    plant::command_in(data.rig, plant::CommandUnit::V, 0.0, 10.0);
  }
  std::vector<run::ReplayedRun> all;
  for (std::size_t i = 0; i < runs; ++i) {
    domain::Run measured;
    measured.id = fmt::format("r{}", i);
    measured.load_kg = 5.0;
    if (by_stamps) {
      domain::Measurement& stamps = measured.measured.emplace();
      stamps.time_s = {0.0, 1.0};
      stamps.take("contraction") = {0.1, 0.1};
      stamps.give("command") = {5.0, 5.0};
      stamps.take("muscle_pressure") = {1e5, 1e5};
    } else {
      measured.read("contraction", measured.current_mA = {0.1, 0.1});
      measured.read("muscle_pressure", {1e5, 1e5});
    }
    data.runs.push_back(measured);
    run::ReplayedRun run{.id = measured.id, .load_kg = 5.0};
    run.gaps = {{"contraction", "1", 0.001 * static_cast<double>(i + 1), 0.02, -0.001, 2},
                {"muscle_pressure", "bar", 0.5, 0.6, 0.1, 2}};
    run.recording.samples.resize(2);
    if (by_stamps)
      for (auto& sample : run.recording.samples) sample.current_mA = 5.0;
    all.push_back(run);
  }
  return report_html(data, all);
}

TEST(Replay, OfManyRunsBeginsWithTheLoadsAndShowsTheWorstFirst) {
  for (const bool by_stamps : {false, true}) {
    const std::string few = replayed(12, by_stamps), many = replayed(13, by_stamps);
    EXPECT_TRUE(lacks(few, "by-load"));
    const auto loads = many.find("class='by-load'"), all = many.find("All 13 runs, the worst first");
    ASSERT_LT(loads, all);
    ASSERT_NE(all, std::string::npos);
    EXPECT_LT(many.find(">r12</a>", all), many.find(">r11</a>", all));
    EXPECT_TRUE(holds(few, "id='group-0' data-group='0'>\n<h3>r0, 5 kg"));
    EXPECT_TRUE(holds(many, "id='group-0' data-group='0'>\n<h3>r12, 5 kg"));
  }
}

TEST(Replay, WithAGaugeDrawsTheErrorOfThePressure) {
  EXPECT_TRUE(holds(replayed(1), "\"muscle_pressure_error\":{"));
}

TEST(Replay, ByStampsIsInTheUnitThatTheReaderWants) {
  EXPECT_TRUE(holds(replayed(12, true), "height of the load differ by <span class='mm'>2.160 mm</span>",
                    "<td>5</td><td>contraction, <span class='mm'>mm</span>",
                    "<td>muscle_pressure, bar</td><td>0.5</td>"));
}

TEST(Replay, ByStampsDrawsTheErrorOfThePressureAndTheGauge) {
  const std::string html = replayed(1, true);
  EXPECT_TRUE(holds(html, "\"muscle_pressure_error\":{", "\"id\":\"muscle_pressure_error\"",
                    "<dt>gauge</dt><dd>on the muscle"));
}

TEST(Page, OfAValveThatTakesVoltsShowsVolts) {
  const std::string html = replayed(1, true);
  EXPECT_TRUE(holds(
      html,
      "\"command\":{\"name\":\"command\",\"title\":\"Command\",\"unit\":\"V\",\"zero\":0.0,\"span\":10.0}",
      "\"command\":{\"low\":5.0,"));
  EXPECT_TRUE(holds(
      replayed(1),
      "\"command\":{\"name\":\"current\",\"title\":\"Current\",\"unit\":\"mA\",\"zero\":4.0,\"span\":20.0}"));
}

TEST(RigWords, TellWhatTheRigHasAndWhatItHasNot) {
  Contents contents;
  plant::Rig& rig = contents.rig;
  EXPECT_TRUE(holds(rig_html(contents), "<dt>gauge</dt><dd>none", "none: nominal laws only",
                    "on the wheel, geared 2 to 1: a count is"));
  rig.sensors.position().wheel_ratio = 1.0;
  EXPECT_TRUE(holds(rig_html(contents), "on the wheel: a count is"));
  rig.valve.zero_command = 0.0;
  rig.joint.wheel_radius_m = 0.2;
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 1e-10;
  contents.gauge = true;
  const std::string html = rig_html(contents);
  EXPECT_TRUE(holds(html, "200 mm in radius", "0 to 20 mA", "on the muscle", "<dd>muscle_leak"));
  contents.handed_out = true;
  EXPECT_TRUE(lacks(rig_html(contents), "effects", "muscle_leak"));
}

TEST(RigWords, TellOfTwoMusclesAndTheirLink) {
  Contents contents;
  contents.rig.mechanics = plant::Pair{};
  const std::string html = rig_html(contents);
  EXPECT_TRUE(holds(html, "<dt>muscle 2", "2 kg whose centre of mass is 250 mm from the axis", "of angle"));
}

TEST(Still, LeavesOutALoopThatNoRunHas) {
  Group group{.name = "1 kg", .ticks = 2};
  group.runs.push_back(
      {.name = "pid", .ticks = 2, .quantities = {{"contraction_ratio", [](std::size_t) { return 0.1; }}}});
  EXPECT_EQ(loop_svg(group, loops_of({}, {}).front(), {}, 100), "");
}

AtTick friction_coefficient(const run::Recording& recording, const plant::Rig& rig) {
  const auto all = quantities_of(recording, rig);
  const auto found = std::ranges::find(all, "friction_coefficient", &Quantity::key);
  return found != all.end() ? found->at : AtTick();
}

TEST(Quantities, FrictionCoefficientIsFrictionOverNormalForceWhileThreadsSlide) {
  run::Recording recording;
  run::Sample sample{};
  sample.state = {{0.1, 0.05}, {2e5, 2e5, 0.0}, {}};
  sample.contraction_ratio = 0.1;
  sample.friction_force_N = -40.0;
  recording.samples.push_back(sample);
  sample.state.joint.contraction_speed_per_s = 0.0;
  recording.samples.push_back(sample);
  const AtTick at = friction_coefficient(recording, {});
  ASSERT_TRUE(at);
  // T 4.3 by hand: 2 pi r0 l0 sin(a0) / ((1 - e) sqrt(1 - cos2(a0) (1 - e)^2)), e = 0.1, 2 bar
  const double a0 = 20.0 * std::acos(-1.0) / 180.0, c = std::cos(a0);
  const double surface_m2 =
      2.0 * std::acos(-1.0) * 7.5e-3 * 0.3 * std::sin(a0) / (0.9 * std::sqrt(1.0 - c * c * 0.81));
  EXPECT_NEAR(at(0), 40.0 / (surface_m2 * 2e5), 1e-9);
  EXPECT_TRUE(std::isnan(at(1)));

  // Of a muscle on a cord, whose joint stands elsewhere and still: by its own stroke.
  plant::Rig on_cord;
  on_cord.muscle.cord.stiffness_N_per_m = 2e4;
  run::Sample& last = recording.samples.back();
  last.state.joint.contraction_ratio = 0.05;
  last.cord_end_m_per_s = 0.05 * 0.3;
  EXPECT_EQ(friction_coefficient(recording, on_cord)(1), at(0));
  last.cord_end_m_per_s = 0.0;
  last.state.joint.contraction_speed_per_s = 0.05;
  EXPECT_TRUE(std::isnan(friction_coefficient(recording, on_cord)(1)));
  EXPECT_EQ(loops_of(on_cord, {}).back().x, "muscle_contraction_ratio");
  EXPECT_EQ(loops_of({}, {}).back().x, "contraction_ratio");
}

}  // namespace
}  // namespace mckibben::report
