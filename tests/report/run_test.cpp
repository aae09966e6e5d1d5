// What the report of a run says of its controllers, and what is drawn of valves that ask for no pressure.
#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>
#include <sim/output/run_results.hpp>
#include <sim/report/in_script.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>

#include "says.hpp"

namespace mckibben::report {
namespace {

TEST(Run, SaysHowLongControllersStoodAtALimitOfTheirCurrent) {
  domain::Scenario scenario;
  scenario.loads_kg = {5.0};
  scenario.controllers = {controllers::PidSettings{}};
  run::Comparison comparison;
  comparison.runs.resize(1);
  comparison.runs[0].controller = "pid";
  EXPECT_TRUE(lacks(report_html(scenario, comparison), "class='limits'"));
  comparison.runs[0].limits = controllers::CurrentRange{4.0, 20.0};
  comparison.runs[0].metrics.at_lowest_current = 0.31;
  const std::string html = report_html(scenario, comparison);
  EXPECT_TRUE(holds(html, "at a limit of their current for up to 31 % of the time",
                    "<th scope='row'>5 kg</th><td>31</td>"));
}

TEST(Run, SaysBesideTheErrorThatTheBestControllerOscillates) {
  domain::Scenario scenario;
  scenario.loads_kg = {5.0};
  scenario.controllers = {controllers::PidSettings{}, controllers::StaticInverseSettings{}};
  run::Comparison comparison;
  comparison.runs.resize(2);
  comparison.runs[0].controller = "pid";
  comparison.runs[1].controller = "static_inverse";
  comparison.spreads = {{.controller = "pid", .rmse = run::Spread{.mean = 0.01}},
                        {.controller = "static_inverse", .rmse = run::Spread{.mean = 0.02}}};
  comparison.tuned = {{.controller = "pid", .load_kg = 5.0}};
  constexpr const char* words = "it oscillates where its target rests, by ±7.8 mm";
  EXPECT_TRUE(holds(report_html(scenario, comparison), "pid follows the target best"));
  EXPECT_TRUE(lacks(output::table_of(scenario, comparison), words));
  comparison.runs[0].cycle = run::LimitCycle{.amplitude = 0.026, .period_s = 0.4, .from_s = 0.0};
  const std::string html = report_html(scenario, comparison);
  EXPECT_TRUE(lacks(html, "follows the target best"));
  EXPECT_TRUE(holds(html, "pid errs least: root mean square error",
                    std::string(", but ") + words + ". Of the 2 controllers static_inverse is the worst"));
  EXPECT_TRUE(holds(output::table_of(scenario, comparison), std::string("; ") + words + "\n"));
}

TEST(Run, SaysOverHowManyLoadsAMeanIs) {
  domain::Scenario scenario;
  scenario.loads_kg = {5.0, 7.0, 9.0};
  scenario.controllers = {controllers::PidSettings{}, controllers::StaticInverseSettings{}};
  run::Comparison comparison;
  comparison.runs.resize(6);
  for (std::size_t i = 0; i < 6; ++i) comparison.runs[i].controller = i % 2 == 0 ? "pid" : "static_inverse";
  comparison.spreads = {{.controller = "pid", .rmse = run::Spread{.mean = 0.01}, .runs = 3, .with_result = 3},
                        {"static_inverse", run::Spread{.mean = 0.02}, 3, 3}};
  const auto html = [&] { return report_html(scenario, comparison); };
  EXPECT_TRUE(lacks(html(), " of 3 loads"));
  EXPECT_TRUE(holds(html(), "pid follows the target best: ", "the mean over 3 loads. Of the 2"));
  comparison.spreads[1].with_result = 2;
  EXPECT_TRUE(holds(html(), "pid follows the target best: ", " over 2 of 3 loads.", " (2 of 3 loads)</td>"));
  comparison.spreads[0].with_result = 1;
  comparison.runs[0].failure = "it stopped";
  EXPECT_TRUE(
      holds(html(), "pid errs least: ", "the mean over 1 of 3 loads. Of the 2", " (1 of 3 loads)</td>"));
  EXPECT_TRUE(lacks(html(), "* extrapolated"));
}

TEST(Run, SaysWhichControllersKnowTheSimulatedRig) {
  domain::Scenario scenario;
  scenario.loads_kg = {5.0};
  scenario.controllers = {controllers::ModelInverseSettings{}};
  constexpr const char* words = "model_inverse knows the simulated rig exactly";
  run::Comparison comparison;
  const auto told = [&] {
    comparison.runs.resize(scenario.controllers.size());
    return report_html(scenario, comparison);
  };
  EXPECT_TRUE(lacks(told(), words)) << "nothing to compare it with";
  scenario.controllers.emplace_back(controllers::PidSettings{});
  EXPECT_TRUE(holds(told(), words, "rig: FILE"));
  EXPECT_TRUE(holds(output::table_of(scenario, comparison), words));
  scenario.believed.emplace("model_inverse", plant::Rig{});
  EXPECT_TRUE(lacks(told(), words));
}

TEST(Run, SaysWhyADrawnRigHasNoResult) {
  domain::Scenario scenario;
  scenario.loads_kg = {5.0};
  run::Comparison comparison;
  comparison.drawn = {"muscle.rest_radius"};
  comparison.runs.resize(2);
  comparison.robustness.resize(2);
  comparison.robustness[0] = {.load_kg = 5.0, .controller = "pid", .rigs = 8};
  comparison.robustness[1] = {
      .load_kg = 7.0, .controller = "pid", .rigs = 8, .no_result = 2, .why = "rig 3: it <stops>"};
  const auto rows = input::Json::parse(output::json_of(scenario, comparison)).at("robustness").at("rows");
  EXPECT_EQ(rows[0].at("why_no_result"), "");
  EXPECT_EQ(rows[1].at("why_no_result"), "rig 3: it <stops>");
  EXPECT_TRUE(holds(output::table_of(scenario, comparison), "  no result: 7 kg, pid: rig 3: it <stops>\n"));
  const std::string html = report_html(scenario, comparison);
  EXPECT_TRUE(holds(html, "<p>No result: ", ": rig 3: it &lt;stops&gt;</p>"));
}

TEST(Quantities, ACommandThatIsNoPressureIsDrawnAsItIs) {
  plant::Rig rig;
  EXPECT_EQ(loop_over(rig, true).label, "commanded pressure in bar");
  EXPECT_EQ(loop_over(rig, false, "2").label, "commanded pressure 2 in bar");
  rig.valve.kind = plant::ValveKind::on_off;
  EXPECT_EQ(loop_over(rig, true).label, "measured muscle pressure in bar");
  EXPECT_EQ(loop_over(rig, false).label, "current in mA");
  EXPECT_EQ(loop_over(rig, false, "2").key, "current_2");
  EXPECT_EQ(measured_loops(rig, true).size(), 1u);
  for (const Plot& plot : plots_of(rig, {}))
    for (const Line& line : plot.lines) EXPECT_NE(line.key, "reference_pressure");
  EXPECT_EQ(drawn_rig_json(rig, false)["command"]["shut"], 12.0);
}

}  // namespace
}  // namespace mckibben::report
