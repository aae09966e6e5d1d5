// What a diagnosis writes and prints: the contract's keys, a rig that reads back to the same bits, a plan
// that is a campaign.
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include <plant/state.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/hypothesis_file.hpp>
#include <sim/input/rigs.hpp>
#include <sim/output/diagnosis_results.hpp>
#include <sim/output/diagnosis_words.hpp>

#include "diagnosed.hpp"
#include "says.hpp"
#include "scratch.hpp"

namespace mckibben::output {
namespace {

using input::Json;

TEST(DiagnosisJson, HoldsWhatIsPromised) {
  const Json document = Json::parse(json_of(measured(), diagnosed()));
  EXPECT_EQ(document.begin().key(), "schema");
  EXPECT_EQ(document.at("schema"), "mckibben-diagnosis/1");
  EXPECT_EQ(document.at("verdict"), "missing_effect");
  const Json& leak = document.at("effects").at(0);
  EXPECT_EQ(leak.at("name"), "muscle_leak");
  EXPECT_EQ(leak.at("variant"), "");
  EXPECT_EQ(leak.at("confusable_with"), Json::array());
  const Json conductance{
      {"value", 1.0314159e-10}, {"unit", "m3/(s.Pa)"}, {"ci95", Json::array({0.97e-10, 1.09e-10})}};
  EXPECT_EQ(leak.at("parameters").at("conductance"), conductance);
  EXPECT_EQ(document.at("effects").at(1).at("confusable_with").at(0), "valve_hysteresis");
  const Json& law = document.at("residual_law");
  const Json term{
      {"term", "sgn v"}, {"coefficient", -0.51}, {"unit", "N"}, {"ci95", Json::array({-0.7, -0.32})}};
  EXPECT_EQ(law.at("terms").at(1), term);
  EXPECT_EQ(law.at("valid_for"), "rises up to 60 mm, speeds up to 0.2 m/s");
  const Json& cell = document.at("where").at(0);
  EXPECT_EQ(cell.at("factor"), "direction");
  EXPECT_EQ(cell.at("cell"), "contracting");
  EXPECT_EQ(cell.at("share_of_gap"), 0.62);
  EXPECT_EQ(cell.at("significant"), true);
  const Json gap{{"held_out_runs", Json::array({"r05", "r06"})},
                 {"noise_floor", 1.3e-4},
                 {"nominal_rmse", 0.0093},
                 {"recalibrated_rmse", 0.0022},
                 {"corrected_rmse", 1.6e-4},
                 {"closed", 0.9876},
                 {"encoder_jitter", 0.0},
                 {"reading", "contraction"},
                 {"unit", "1"}};
  EXPECT_EQ(document.at("gap"), gap);
  const Json fast{{"factor", "speed"},
                  {"cell", "above 100 mm/s"},
                  {"mean", 1e-4},
                  {"share_of_gap", 0.5},
                  {"share_of_time", 0.125}};
  const Json remaining{{"floors", 3.0}, {"share", 0.25}, {"pattern", Json::array({fast})}};
  EXPECT_EQ(document.at("remaining"), remaining);
  const Json open{{"parameters", Json::array({"hose.conductance", "valve.conductance"})},
                  {"known", "product"},
                  {"words", "only the product of hose.conductance and valve.conductance is known"}};
  EXPECT_EQ(document.at("left_open"), Json::array({open}));
  const Json& next = document.at("next_experiment");
  EXPECT_EQ(next.at("separates").size(), 2u);
  EXPECT_EQ(next.at("current"), "stairs from 4 to 20 mA, 2 s each");
  EXPECT_EQ(next.at("load_kg"), 16.138);
  EXPECT_EQ(next.at("expected_power"), 0.93);
  EXPECT_EQ(document.at("false_alarm_rate"), 0.03);
  EXPECT_EQ(document.at("seed"), 7);
  EXPECT_EQ(document.at("runs").at(3).at("left_out"), true);
  EXPECT_FALSE(document.at("ranking").at(2).contains("held_out_rmse"));  // was not refitted
  EXPECT_EQ(document.at("input_files").at(0).at("file"), "measured/dataset.yaml");
  EXPECT_TRUE(document.contains("program"));
}

TEST(DiagnosisJson, HoldsFaultsOfTheBenchWithTheLineThatMendsThem) {
  diagnose::Diagnosis found = diagnosed();
  EXPECT_EQ(Json::parse(json_of(measured(), found)).at("bench"), Json::array());
  found.bench = {{.name = "loads_differ",
                  .runs = {"r05"},
                  .size = {"", "kg", -2.75, -2.95, -2.55},
                  .write = "load: 11.1 kg",
                  .words = "the load of run r05 is 2.75 kg less than written"},
                 {.name = "reading_clock",
                  .runs = {"r01", "r02", "r03", "r04", "r05", "r06"},
                  .size = {"", "1", 0.01, 0.009, 0.011},
                  .write = "columns: {contraction: {column: x, unit: mm, time: FILL_IN}}, FILL_IN a column "
                           "of the stamps times 1.01",
                  .words = "the clock of the readings runs 1 % slow"}};
  const Json load = Json::parse(json_of(measured(), found)).at("bench").at(0);
  EXPECT_EQ(load.at("name"), "loads_differ");
  EXPECT_EQ(load.at("runs"), Json::array({"r05"}));
  EXPECT_EQ(load.at("value"), -2.75);
  EXPECT_EQ(load.at("unit"), "kg");
  EXPECT_EQ(load.at("ci95"), Json::array({-2.95, -2.55}));
  EXPECT_EQ(load.at("write"), "load: 11.1 kg");
  const std::string text = table_of(measured(), found);
  EXPECT_TRUE(holds(text, "faults of the bench", "-2.75 kg", "load: 11.1 kg", "0.90 to 1.10 %"));
  EXPECT_LT(text.find("faults of the bench"), text.find("added to the rig"));
}

TEST(DiagnosisJson, TellsWhatWasReadBesideOnlyWhereSomethingWas) {
  auto diagnosis = diagnosed();
  EXPECT_FALSE(Json::parse(json_of(measured(), diagnosis)).at("gap").contains("beside"));
  diagnosis.gap.beside = {{"force", "N", 0.5, 9.0, 4.0, 0.6}};
  const Json force{{"reading", "force"},       {"unit", "N"},
                   {"noise_floor", 0.5},       {"nominal_rmse", 9.0},
                   {"recalibrated_rmse", 4.0}, {"corrected_rmse", 0.6}};
  EXPECT_EQ(Json::parse(json_of(measured(), diagnosis)).at("gap").at("beside").at(0), force);
  const std::string table = table_of(measured(), diagnosis);
  EXPECT_TRUE(holds(table, "each weighted by its own noise floor"));
}

TEST(DiagnosisJson, NamesAParameterByItsPartOnlyWhereTheLastWordIsNotEnough) {
  const Json moved = Json::parse(json_of(measured(), diagnosed())).at("recalibrated");
  EXPECT_EQ(moved.at("rest_radius").at("nominal"), 0.0075);
  EXPECT_EQ(moved.at("rest_radius").at("fitted"), 0.00768123456789);
  EXPECT_EQ(moved.at("rest_radius").at("deviations"), 2.4);
  EXPECT_EQ(moved.at("valve_conductance").at("fitted"), 1.1e-8);
  EXPECT_EQ(moved.at("hose_conductance").at("fitted"), 0.9e-8);
  diagnose::Diagnosis one = diagnosed();
  one.recalibrated = {one.recalibrated[2]};  // the key does not depend on what else moved
  EXPECT_TRUE(Json::parse(json_of(measured(), one)).at("recalibrated").contains("valve_conductance"));
}

TEST(DiagnosisJson, IsNullWhereThereIsNothing) {
  diagnose::Diagnosis empty;
  empty.effects = {
      {.name = "muscle_leak",
       .variant = "",
       .parameters = {{"conductance", "m3/(s.Pa)", 1e-10, 0.0, std::numeric_limits<double>::infinity()}}}};
  const Json document = Json::parse(json_of(measured(), empty));
  EXPECT_EQ(document.at("verdict"), "cannot_tell");
  EXPECT_TRUE(document.at("residual_law").is_null());
  EXPECT_TRUE(document.at("next_experiment").is_null());
  EXPECT_EQ(document.at("recalibrated"), Json::object());
  EXPECT_TRUE(document.at("effects").at(0).at("parameters").at("conductance").at("ci95").at(1).is_null());
}

/// `text` read as a rig file.
plant::Rig read_back(const std::string& text) {
  const Scratch folder;
  std::vector<domain::InputFile> inputs;
  return input::read_rig(folder.write("rig.yaml", text).string(), inputs);
}

TEST(DiagnosisRig, ReadsBackToTheSameNumbers) {
  const diagnose::Diagnosis found = diagnosed();
  const std::string text = rig_yaml(measured(), found);
  EXPECT_EQ(input::rig_json(read_back(text)), input::rig_json(found.corrected)) << text;
  EXPECT_TRUE(holds(text, "\nbase: thesis\n"));
  EXPECT_TRUE(lacks(text, "rest_length:")) << "holds what did not change";
  EXPECT_TRUE(lacks(text, "viscous_damping")) << "holds an effect that is off";
  EXPECT_TRUE(holds(text, "95 % interval 0.582 to 0.654 l/(min bar)"));
}

TEST(DiagnosisRig, SaysAtTheKeyWhichOtherNameIsAsGood) {
  diagnose::Diagnosis found = diagnosed();
  const std::string text = rig_yaml(measured(), found);
  EXPECT_TRUE(holds(text, "Missing: muscle_leak, and valve_dead_band or valve_hysteresis",
                    "  valve_dead_band:  # or valve_hysteresis: these data do not distinguish them\n",
                    "  muscle_leak:\n"));
  EXPECT_TRUE(holds(plan_yaml(measured(), found), "valve_dead_band:  # or valve_hysteresis"));
  found.effects.back().confusable_with.clear();
  EXPECT_TRUE(lacks(rig_yaml(measured(), found), " or valve_hysteresis"));
}

TEST(DiagnosisTable, HedgesAnEffectThatOthersCouldBe) {
  diagnose::Diagnosis found = diagnosed();
  found.effects.erase(found.effects.begin());
  EXPECT_EQ(title_of(found), "Missing: valve_dead_band or valve_hysteresis, and something else");
  EXPECT_TRUE(holds(table_of(measured(), found),
                    "missing_effect: Missing: valve_dead_band or valve_hysteresis", "valve_dead_band * ",
                    "  * or valve_hysteresis: these data do not distinguish them."));
  found.effects.back().confusable_with = {"a", "b", "c", "d"};
  EXPECT_EQ(title_of(found), "Missing: valve_dead_band or a, b or 2 more, and something else");
}

TEST(DiagnosisTable, SaysWhyTheRecalibratedRigIsWorseOnlyWhereItIs) {
  diagnose::Diagnosis found = diagnosed();
  EXPECT_TRUE(lacks(table_of(measured(), found), "worse than the nominal"));
  found.gap.recalibrated_rmse = 2.0 * found.gap.nominal_rmse;
  EXPECT_TRUE(holds(table_of(measured(), found), "worse than the nominal", "not this rms"));
  const diagnose::Diagnosis worse = found;
  found.bench = {{.name = "loads_differ", .runs = {"r05"}}};
  EXPECT_TRUE(lacks(table_of(measured(), found), "worse than the nominal"));
  found = worse;
  found.verdict = diagnose::Verdict::nothing_missing;
  EXPECT_TRUE(lacks(table_of(measured(), found), "worse than the nominal"));
  found = worse;
  found.gap.noise_floor = found.gap.nominal_rmse;
  found.gap.recalibrated_rmse = 1.03 * found.gap.nominal_rmse;
  EXPECT_TRUE(lacks(table_of(measured(), found), "worse than the nominal"));
}

TEST(DiagnosisTable, SaysEquivalentModelsByWhatDiffersFromWhatWasFound) {
  using enum diagnose::Explanation::Kind;
  using diagnose::Explanation;
  diagnose::Diagnosis found = diagnosed();
  const auto said = [&](Explanation chosen, Explanation other) {
    chosen.chosen = true;
    other.misfit = 24.0;
    found.explanations = {chosen, other};
    for (Explanation& one : found.explanations) one.as_good = true;
    const std::string text = table_of(measured(), found), heading = "explain these data as well\n  ";
    EXPECT_TRUE(lacks(text, "misfit")) << "a number that nobody explains";
    const std::size_t at = text.find(heading) + heading.size();
    return text.substr(at, text.find('\n', at) - at);
  };
  const Explanation creep{.kind = effects, .effects = {"bladder_creep"}},
      loads{.kind = effects, .effects = {"bladder_creep", "loads_differ"}},
      lag{.kind = effects, .effects = {"bladder_creep", "valve_lag"}},
      described{.kind = nothing, .effects = {"bladder_creep"}},
      lawful{.kind = law, .effects = {"bladder_creep"}};
  EXPECT_EQ(said(loads, creep), "the same without loads_differ");
  EXPECT_EQ(said(creep, loads), "the same with loads_differ");
  EXPECT_EQ(said(loads, lag), "the same with valve_lag in place of loads_differ");
  EXPECT_EQ(said(creep, described), "the same on the rig as described");
  EXPECT_EQ(said(described, creep), "the same with other values of the rig's parameters");
  EXPECT_EQ(said(creep, lawful), "the same with a law of force");
  EXPECT_EQ(said(lawful, {.kind = law}), "the same without bladder_creep");
  const Explanation smooth{.kind = law, .effects = {"bladder_creep", "smooth"}};
  EXPECT_EQ(explained_by(smooth), "bladder_creep with a law of smooth terms");
  EXPECT_EQ(said({.kind = law, .effects = {"1 of smooth", "bladder_creep"}}, smooth),
            "the same with a law of smooth terms in place of a law of 1 smooth term");
  EXPECT_EQ(explained_by({.kind = law, .effects = {"2 of waves"}}), "a law of 2 waves along the stroke");
  EXPECT_EQ(said(creep, {.kind = effects, .effects = {"valve_lag"}}), "valve_lag") << "nothing in common";
  EXPECT_EQ(said(creep, {.kind = numbers}), "other values of the rig's parameters");
  EXPECT_EQ(said(creep, {.kind = numbers, .furthest_off = "friction.scale by 2.1 times its ±"}),
            "other values of the rig's parameters (friction.scale by 2.1 times its ±)");
  found.verdict = diagnose::Verdict::cannot_tell;  // nothing was found that the other could be like
  EXPECT_EQ(said(loads, creep), "bladder_creep");
  EXPECT_EQ(explained_by(described), "bladder_creep on the rig as described");
}

TEST(DiagnosisTable, NamesAGaugeWhereNoCurrentDecides) {
  diagnose::Diagnosis found = diagnosed();
  found.next_experiment.reset();
  EXPECT_TRUE(holds(table_of(measured(), found), "No current that was tried and is not yet in the data"));
  found.next_sensor = {{"a", "b"}, "r05", 0.98};
  EXPECT_TRUE(holds(table_of(measured(), found),
                    "to measure next\n  No other current would separate a and b. A "
                    "pressure gauge on the muscle would, in a run like r05, with a "
                    "probability of 98 %."));
  EXPECT_EQ(Json::parse(json_of(measured(), found)).at("next_sensor").at("run"), "r05");
  found.next_sensor->expected_power = 0.01;
  EXPECT_TRUE(holds(table_of(measured(), found), "Neither another current nor a pressure gauge"));
}

TEST(DiagnosisRig, HoldsEveryFieldOfARigThatIsNotShipped) {
  domain::Dataset data = measured();
  data.rig.muscle.rest_length_m = 0.4;
  diagnose::Diagnosis found = diagnosed();
  found.corrected.muscle.rest_length_m = 0.4;
  const std::string text = rig_yaml(data, found);
  EXPECT_TRUE(lacks(text, "base:"));
  EXPECT_TRUE(holds(text, "settling_time:"));
  EXPECT_EQ(input::rig_json(read_back(text)), input::rig_json(found.corrected)) << text;
}

// A campaign of it knows the tube's elasticity: calibrate counts it.
TEST(DiagnosisRig, HasTheBaseWhoseEffectsWereKnown) {
  std::vector<domain::InputFile> none;
  domain::Dataset data = measured();
  data.rig = input::read_rig("festo_dmsp_20", none);
  data.rig.muscle.rest_length_m = 0.4;
  diagnose::Diagnosis found = diagnosed();
  found.corrected.effects.get<plant::BladderElasticity>() = data.rig.effects.get<plant::BladderElasticity>();
  found.corrected.effects.get<plant::BladderElasticity>().force_N = 260.0;
  const std::string text = rig_yaml(data, found);
  EXPECT_TRUE(holds(text, "base: festo_dmsp_20\n", "settling_time:"));
  EXPECT_EQ(input::rig_json(read_back(text)), input::rig_json(found.corrected)) << text;
  const domain::Campaign next = input::read_campaign(input::Source("plan.yaml", plan_yaml(data, found), "."));
  EXPECT_FALSE(next.known.effects.get<plant::BladderElasticity>().absent());
  EXPECT_TRUE(next.known.effects.get<plant::MuscleLeak>().absent()) << "is there to be found";
  found.corrected.effects.get<plant::BladderElasticity>() = {};
  EXPECT_TRUE(lacks(rig_yaml(data, found), "base:")) << "it would come back";
}

TEST(DiagnosisRig, IsTheNominalOneWhereNothingWasFound) {
  diagnose::Diagnosis nothing;
  nothing.because = "the gap is within noise,\nschema: mckibben-scenario/1";  // stays a comment
  const plant::Rig rig = read_back(rig_yaml(measured(), nothing));
  EXPECT_EQ(input::rig_json(rig), input::rig_json(plant::Rig{}));
}

TEST(DiagnosisPlan, IsACampaignWithThatCurrentAndLoadOnTheCorrectedRig) {
  const diagnose::Diagnosis found = diagnosed();
  const std::string text = plan_yaml(measured(), found);
  EXPECT_EQ(text.rfind(plan_heading, 0), 0u);
  const domain::Campaign campaign = input::read_campaign(input::Source("plan.yaml", text, "."));
  EXPECT_EQ(campaign.loads_kg, std::vector<double>{16.138});
  ASSERT_EQ(campaign.currents.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<controllers::StairCurrent>(campaign.currents[0].current.value()));
  EXPECT_EQ(input::rig_json(campaign.rig), input::rig_json(found.corrected));
}

TEST(DiagnosisPlan, OfAPairHasBothCurrentsAndNoLoad) {
  domain::Dataset data = measured();
  data.rig = plant::thesis_pair();
  diagnose::Diagnosis found;
  found.corrected = data.rig;
  found.next_experiment = {.separates = {"muscle_leak", "valve_lag"},
                           .current = "muscle 1: chirp; muscle 2: the same",
                           .expected_power = 0.5,
                           .measurement = {.name = "chirp_together",
                                           .duration_s = 10.0,
                                           .current_1 = controllers::ChirpCurrent{},
                                           .current_2 = controllers::ChirpCurrent{}}};
  const domain::Campaign next = input::read_campaign(input::Source("plan.yaml", plan_yaml(data, found), "."));
  ASSERT_EQ(next.currents.size(), 1u);
  EXPECT_TRUE(next.currents[0].current_1 && next.currents[0].current_2);
  EXPECT_NE(next.rig.pair(), nullptr);
  EXPECT_TRUE(holds(table_of(data, found), "muscle 2: the same: separates muscle_leak and valve_lag"));
}

TEST(DiagnosisTable, SaysWhatCounts) {
  const std::string text = table_of(measured(), diagnosed());
  EXPECT_LT(text.find("warning: run r04"), text.find("missing_effect: "));
  EXPECT_TRUE(holds(text, "0.619 l/(min bar)", "muscle.rest_radius"));
  EXPECT_TRUE(lacks(text, "muscle.braid_angle")) << "moved by half a deviation only";
  EXPECT_TRUE(holds(text, "* or valve_hysteresis", "98.8 %",
                    "16.138 kg: separates valve_dead_band and valve_hysteresis"));
}

TEST(DiagnosisWords, GiveAsManyDigitsAsTheIntervalAllows) {
  const auto shown = readable(diagnose::FittedNumber{"r", "m", 0.00768123, 0.00766123, 0.00770123});
  EXPECT_EQ(shown.value, "7.681 mm");
  EXPECT_EQ(shown.interval, "7.661 to 7.701 mm");
  EXPECT_EQ(readable(diagnose::FittedNumber{"c", "1", -0.5, -0.7, -0.3}).value, "-0.50");
  EXPECT_EQ(readable(diagnose::FittedNumber{"c", "1", 2.0, 2.0, 2.0}).interval, "unknown");
  EXPECT_EQ(readable(5e4, "Pa"), "0.5 bar");
  EXPECT_EQ(readable(0.012, "s"), "12 ms");
  EXPECT_EQ(readable(20.0, "N.s/m"), "20 N s/m");
  EXPECT_EQ(mass(30.427799999999998), "30.4278 kg");
  EXPECT_EQ(rounded(-0.04, 1, true), "0.0");
  EXPECT_EQ(rounded(0.06, 1, true), "+0.1");
  EXPECT_EQ(height(1e-8, plant::Rig{}), "0.000 mm");
  EXPECT_EQ(height(6.19e-3, plant::Rig{}), "1.86 mm");
}

/// What a law's file adds, at these states, beside what the terms that it came from add.
void expect_same_law(const diagnose::Diagnosis& found) {
  const Scratch folder;
  std::vector<input::InputFile> inputs;
  plant::Effects own;
  own.laws.list.push_back(
      input::read_hypothesis(folder.write("law.yaml", law_yaml(measured(), found)).string(), inputs));
  ASSERT_FALSE(own.absent());
  const plant::SideMemory<double> memory{};
  for (int i = 0; i < 50; ++i) {
    const double e = 0.005 * i, v = 0.01 * (i - 25);
    const plant::Instant<double> now{e,       0.3 * e, v,   1e4 * i, 3.0 * i, 101325.0,
                                     84150.0, {},      1e5, 2e5,     4.0 * i};
    const double wanted_N = found.corrected.effects.pull(now, memory).all_N;
    EXPECT_NEAR(own.pull(now, memory).all_N, wanted_N, 1e-12 * (1.0 + std::abs(wanted_N))) << e << " " << v;
  }
}

TEST(DiagnosisRig, TheLawThatWasFoundIsAHypothesisThatSaysTheSame) {
  diagnose::Diagnosis found = diagnosed();
  found.corrected = {};
  auto& terms = found.corrected.effects.get<plant::ResidualForce>().terms;
  for (const auto& [basis, name] : names(plant::Basis{})) {  // three at a time
    terms.push_back({basis, -1.5, 0.0123456789, -0.7});
    if (terms.size() > 3) terms.erase(terms.begin());
    found.residual_law.assign(terms.size(), {});
    expect_same_law(found);
  }
  for (const auto& [basis, name] : names(plant::Basis{})) {
    terms = {{basis, 2.25, 0.0123456789, 0.3}};
    found.residual_law.resize(1);
    expect_same_law(found);
  }
}

}  // namespace
}  // namespace mckibben::output
