// The page of a diagnosis: its story in order, its pictures, its runs; with something in every part of it and
// with next to nothing. How it looks and moves is tested in tests/browser.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/report/diagnosis_pictures.hpp>
#include <sim/report/report.hpp>

#include "count.hpp"
#include "diagnosed.hpp"
#include "says.hpp"

namespace mckibben::report {
namespace {

using output::diagnosed;

/// With currents, so that runs can be drawn.
domain::Dataset measured() {
  domain::Dataset data = output::measured();
  const auto found = diagnosed();
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    data.runs[i].read("contraction", found.runs[i].measured);
    data.runs[i].current_mA.assign(found.runs[i].measured.size(), 12.0);
  }
  return data;
}

/// What is read: the page without its scripts and licence.
std::string visible(const std::string& html) {
  return html.substr(html.find("<body>"), html.find("Licence of uPlot") - html.find("<body>"));
}

TEST(DiagnosisPage, TellsTheStoryInOrder) {
  const std::string html = report_html(measured(), diagnosed(), {}, {});
  EXPECT_EQ(count(html, "<script"), count(html, "</script>"));
  EXPECT_TRUE(lacks(html, " src="));
  EXPECT_EQ(count(html, "href="), count(html, "href='#"));
  EXPECT_TRUE(lacks(html, "<held out>"));  // of the sentence, which tries to be a tag
  EXPECT_TRUE(lacks(visible(html), "nan"));
  std::size_t at = 0;
  for (const char* part : {"<h1>Diagnosis of measured",
                           "runs &lt;held out&gt;",
                           "Verdict: missing_effect",
                           "0.619 l/(min bar)",
                           "0.582 to 0.654 l/(min bar)",
                           "Error of height on the runs held out (r05 and r06)",
                           "72 \u00d7",
                           "noise floor",
                           "Warning:",
                           "Where they disagree",
                           "never visited",
                           "What explains it",
                           "What was added",
                           "muscle.rest_<wbr>radius",
                           "had absorbed",
                           "How far the gap shrank",
                           "id='rig'",
                           "r05, 13.87 kg, held out",
                           "r01, 11.138 kg<",
                           "r04, 23.406 kg, left out",
                           "What else it could be",
                           "valve_dead_band could as well be valve_hysteresis",
                           "What to measure next",
                           "stairs from 4",
                           "a load of 16.138 kg",
                           "Seed 7."}) {
    const std::size_t found = html.find(part, at);
    ASSERT_NE(found, std::string::npos) << part;
    at = found;
  }
}

TEST(DiagnosisPage, NamesFaultsOfTheBenchBeforeEffectsAndSaysWhatMendsThem) {
  diagnose::Diagnosis found = diagnosed();
  EXPECT_TRUE(lacks(report_html(measured(), found, {}, {}), "Mended in the data set by"));
  found.bench = {{.name = "loads_differ",
                  .runs = {"r05"},
                  .size = {"", "kg", -2.75, -2.95, -2.55},
                  .write = "load: 11.1 kg",
                  .words = "the load of run r05 is 2.75 kg less than written"}};
  const std::string html = report_html(measured(), found, {}, {});
  EXPECT_TRUE(holds(html, "Mended in the data set by", "load: 11.1 kg", "-2.95 to -2.55 kg"));
  const std::size_t table = html.find("Verdict: missing_effect");
  EXPECT_LT(html.find("2.75 kg less than written", table), html.find("0.619 l/(min bar)", table));
}

/// A diagnosis that finds the load of r05 wrong, and nothing of the rig.
diagnose::Diagnosis mislabelled() {
  diagnose::Diagnosis found = diagnosed();
  found.verdict = diagnose::Verdict::nothing_missing;
  found.effects.clear();
  found.residual_law.clear();
  found.recalibrated.clear();
  found.corrected = {};
  found.runs[4].estimated_load_kg = 11.12;
  found.bench = {{.name = "loads_differ",
                  .runs = {"r05"},
                  .size = {"", "kg", -2.75, -2.95, -2.55},
                  .write = "load: 11.12 kg",
                  .words = "the load of run r05 is 2.75 kg less than written",
                  .loads_kg = {11.12}}};
  return found;
}

TEST(DiagnosisPage, ShowsTheModelWithTheLoadThatWasFound) {
  const std::string html = report_html(measured(), mislabelled(), {}, {});
  EXPECT_TRUE(holds(html, "\"name\":\"corrected\"", "<th scope='row'>corrected</th>",
                    "r05, 11.12 kg (13.87 kg as written), held out", "1 loads_differ",
                    "Right: where the bench is at fault."));
  EXPECT_TRUE(lacks(html, "a slow loop without it"));
}

TEST(DiagnosisPage, ListsParametersThatMovedByADeviationOrMore) {
  diagnose::Diagnosis found = diagnosed();
  const std::string html = report_html(measured(), found, {}, {});
  EXPECT_TRUE(holds(html, "Recalibrated by a deviation or more", "muscle.rest_<wbr>radius"));
  EXPECT_TRUE(lacks(html, "<th scope='row'>muscle.braid_<wbr>angle"));
  found.recalibrated.erase(found.recalibrated.begin());
  EXPECT_TRUE(holds(report_html(measured(), found, {}, {}),
                    "Recalibrated: no parameter moved by more than 1.0 deviations of its ±."));
}

TEST(DiagnosisPage, AsksForAGaugeOnlyWhereANameIsOpen) {
  diagnose::Diagnosis found = diagnosed();
  found.residual_law.clear();
  const std::string gauge = "A pressure gauge on the muscle decides it";
  EXPECT_TRUE(holds(report_html(measured(), found, {}, {}), gauge));
  found.effects.back().confusable_with.clear();
  EXPECT_TRUE(lacks(report_html(measured(), found, {}, {}), gauge));
}

TEST(DiagnosisPage, MarksANameThatAnotherCouldBe) {
  const std::string html = report_html(measured(), diagnosed(), {}, {});
  const std::size_t table = html.find("Verdict: missing_effect");
  EXPECT_NE(html.find("valve_<wbr>dead_<wbr>band *", table), std::string::npos);
  EXPECT_TRUE(holds(html, "<p>* or valve_hysteresis: these data do not distinguish them.</p>",
                    "<h3>valve_dead_band or valve_hysteresis</h3>"));
}

TEST(DiagnosisPage, HasOneNoiseFloor) {
  diagnose::Diagnosis found = diagnosed();
  found.gap.jitter = 7.7e-5;  // 0.023 mm
  const std::string html = report_html(measured(), found, {}, {});
  EXPECT_TRUE(holds(html, "below the noise floor, here "));
  EXPECT_TRUE(lacks(html, "0.023 mm"));
}

TEST(DiagnosisPage, LeavesOutWhatThereIsNot) {
  diagnose::Diagnosis nothing;
  nothing.verdict = diagnose::Verdict::nothing_missing;
  const std::string html = report_html(measured(), nothing, {}, {});
  EXPECT_TRUE(holds(html, "Nothing is missing."));
  EXPECT_TRUE(lacks(html, "<h2>", "<svg", "<script", "nan"));
  nothing.runs = {{.id = "empty", .held_out = true}};
  EXPECT_TRUE(lacks(report_html(measured(), nothing, {}, {}), "nan"));
}

TEST(DiagnosisPage, HasNoCorrectedRigWhereNothingWasChanged) {
  diagnose::Diagnosis found = diagnosed();
  found.verdict = diagnose::Verdict::nothing_missing;
  found.effects.clear();
  found.residual_law.clear();
  found.recalibrated.clear();
  const std::string html = report_html(measured(), found, {}, {});
  EXPECT_TRUE(holds(html, "\"name\":\"recalibrated\""));
  EXPECT_TRUE(lacks(html, "\"name\":\"corrected\"", "\u2192"));  // nominal -> corrected
}

TEST(DiagnosisPictures, BarsOfAllRoundsHaveOneScaleAndNothingIsDrawnBelowChanceThatWasNotFitted) {
  diagnose::Diagnosis found = diagnosed();
  found.ranking = {{"muscle_leak", "", 1, 10000.0, 1.0, false, 0.0, 0.0, "score too small"},
                   {"valve_lag", "", 2, 100.0, 1.0, false, 0.0, 0.0, "score too small"},
                   {"supply_line", "", 2, 5.9, 1.0, false, 0.0, 0.0, "score too small"}};
  const auto rounds = ranking_pictures(found, {});
  ASSERT_EQ(rounds.size(), 2u);
  EXPECT_TRUE(holds(rounds[0].svg, "width='200.0' height='13.0' class='empty'"));
  EXPECT_TRUE(holds(rounds[1].svg, "width='100.0' height='13.0' class='empty'"));
  EXPECT_TRUE(lacks(rounds[1].svg, "supply_line"));
  EXPECT_TRUE(holds(rounds[1].caption, "supply_line"));
}

// How far the misfit fell is drawn full; what straight lines had promised lies dashed behind it.
TEST(DiagnosisPictures, WhatWasTakenLiesBeyondChance) {
  diagnose::Diagnosis found = diagnosed();
  found.ranking = {{"muscle_leak", "", 1, 9.0, 1.0, true, 0.0009, 0.0010, "taken: the best fit", 10000.0}};
  const std::string svg = ranking_pictures(found, {}).front().svg;
  EXPECT_TRUE(holds(svg, "width='200.0' height='13.0' class='bar c0'", ">10000<"));
  found.ranking.front().score = 1e8;
  const std::string promised = ranking_pictures(found, {}).front().svg;
  EXPECT_TRUE(holds(promised, "width='200.0' height='13.0' class='empty'",
                    "width='100.0' height='13.0' class='bar c0'", ">10000 of 100000000<"));
  EXPECT_TRUE(holds(promised, "<text x='456.0' y='13.0' text-anchor='end' class='soft halo'>10000 of"));
}

TEST(DiagnosisPage, AsksForNothingMoreOnlyWhereNothingIsLeft) {
  diagnose::Diagnosis found = diagnosed();
  found.next_experiment.reset();
  found.effects.back().confusable_with.clear();
  const std::string enough = "No further measurement is needed";
  EXPECT_TRUE(holds(report_html(measured(), found, {}, {}), enough));
  for (auto& effect : found.effects) effect.support.fall = 50.0;
  found.ranking.push_back({.name = "bladder_creep", .score = 49.0, .untried = true});
  EXPECT_TRUE(holds(report_html(measured(), found, {}, {}), enough));
  found.ranking.back().score = 51.0;
  EXPECT_TRUE(lacks(report_html(measured(), found, {}, {}), enough));
  EXPECT_TRUE(holds(report_html(measured(), found, {}, {}), "they might explain as much: bladder_creep."));
  found.ranking.pop_back();
  found.explanations = {
      {.kind = diagnose::Explanation::Kind::effects, .effects = {"a", "b"}, .as_good = true}};
  EXPECT_TRUE(lacks(report_html(measured(), found, {}, {}), enough));
  EXPECT_TRUE(
      holds(report_html(measured(), found, {}, {}), "Not decided: a with b may explain the data as well."));
  found.explanations.clear();
  found.gap.corrected_rmse = 25.0 * found.gap.noise_floor;
  const std::string html = report_html(measured(), found, {}, {});
  EXPECT_TRUE(lacks(html, enough));
  EXPECT_TRUE(holds(html, "25.0 times the noise floor remains"));
}

TEST(DiagnosisPictures, FrameOnlyWhatIsSignificantAndStayPaleBelowTheNoiseFloor) {
  diagnose::Diagnosis found = diagnosed();
  const auto factors = where_pictures(found, {});
  ASSERT_EQ(factors.size(), 2u);  // direction, pressure
  EXPECT_EQ(count(factors[0].svg, "class='frame'"), 1u);
  EXPECT_EQ(count(factors[1].svg, "class='frame'"), 2u);
  EXPECT_EQ(count(factors[1].svg, "class='empty'"), 1u);
  EXPECT_TRUE(
      holds(factors[0].svg, "<tspan class='mm'>+0.360 mm</tspan><tspan class='ratio'>+0.00120</tspan> *"));
  found.where = {{"direction", "contracting", 2000, 0.5 * found.gap.noise_floor, 1e-4, 1.0, 0.5, false}};
  EXPECT_TRUE(holds(where_pictures(found, {})[0].svg, "fill-opacity='0.28'"));  // half of 0.55
}

TEST(DiagnosisPage, OfManyRunsNamesTheWorstOfEachLoadAndFoldsTheNamesOfThoseHeldOut) {
  diagnose::Diagnosis found = diagnosed();
  const auto run = found.runs.front();
  found.runs.clear();
  for (int i = 0; i < 20; ++i) {
    found.runs.push_back(run);
    found.runs.back().id = fmt::format("n{}", i);
    found.runs.back().held_out = i % 2 == 0;
    found.runs.back().left_out = false;
    found.runs.back().corrected_rmse = 1e-4 * (i + 1);
  }
  const std::string html = visible(report_html(measured(), found, {}, {}));
  EXPECT_TRUE(holds(html, "Error of height on the 10 runs held out, root",
                    "<details><summary>Which runs are held out</summary>"));
  const auto loads = html.find("class='by-load'");
  ASSERT_NE(loads, std::string::npos);
  EXPECT_NE(html.find("data-group='10'>n19</a>", loads), std::string::npos);  // after the ten held out
  EXPECT_LT(loads, html.find("All 20 runs"));
  EXPECT_LT(html.find(">n18, held out<"), html.find(">n0, held out<"));
}

TEST(DiagnosisPage, OfAHundredRunsStaysBelowTenMegabytes) {
  diagnose::Diagnosis found = diagnosed();
  domain::Dataset data = measured();
  const auto run = found.runs.front();
  const auto recorded = data.runs.front();
  found.runs.clear();
  data.runs.clear();
  run::ReplayedRun replayed;
  replayed.recording.samples.resize(run.measured.size());
  for (std::size_t k = 0; k < run.measured.size(); ++k) {
    auto& sample = replayed.recording.samples[k];
    const double shaken = static_cast<double>(k * k % 101) / 101.0;
    sample.state.side = {1e5 * shaken, 2e5 * shaken, 0.0};
    sample.braid_force_N = sample.friction_force_N = sample.effects_pull_N = shaken;
  }
  std::vector<run::ReplayedRun> replays;
  for (int i = 0; i < 100; ++i) {
    found.runs.push_back(run);
    data.runs.push_back(recorded);
    found.runs.back().id = data.runs.back().id = replayed.id = fmt::format("r{}", i);
    replays.push_back(replayed);
  }
  const std::string html = report_html(data, found, replays, replays);
  EXPECT_LT(html.size(), 10'000'000u);
  EXPECT_TRUE(holds(html, "effects_pull"));
}

}  // namespace
}  // namespace mckibben::report
