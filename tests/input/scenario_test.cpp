// Scenarios: what is read, what is left at its default, and that reading,
// writing and reading again changes no bit.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>
#include <sim/input/yaml_reader.hpp>
#include <sim/input/yaml_writer.hpp>

#include "good_scenario.hpp"

namespace mckibben::input {
namespace {

TEST(Scenario, ReadsEveryKindOfField) {
  const Scenario scenario = read_text(good_scenario);
  EXPECT_EQ(scenario.name, "five_loads");
  EXPECT_DOUBLE_EQ(scenario.rig.muscle.rest_length_m, 0.3);
  EXPECT_DOUBLE_EQ(scenario.rig.muscle.braid_angle_rad, 21.0 * std::numbers::pi / 180.0);
  EXPECT_EQ(scenario.rig.friction.law, plant::FrictionLaw::area);
  EXPECT_NE(scenario.rig.sensors.of(plant::Sensed::muscle_pressure), nullptr);
  EXPECT_DOUBLE_EQ(scenario.rig.gas.temperature_K, 291.65);
  EXPECT_DOUBLE_EQ(scenario.loads_kg.at(1), 13.87);
  const auto& target = std::get<controllers::MinimumJerk>(scenario.target);
  EXPECT_TRUE(target.moves.at(0).to.in_metres);
  EXPECT_DOUBLE_EQ(target.moves.at(0).to.value, 0.03);
  EXPECT_FALSE(target.moves.at(1).to.in_metres);
  const auto& pid = std::get<controllers::PidSettings>(scenario.controllers.at(0));
  EXPECT_DOUBLE_EQ(pid.proportional_mA.value(), 100.1);
  EXPECT_FALSE(pid.derivative_time_s);
  EXPECT_EQ(std::get<controllers::StepCurrent>(scenario.controllers.at(3)).moves.at(1).to_mA, 4.0);
  EXPECT_DOUBLE_EQ(scenario.noise.gauge_Pa, 400.0);
  EXPECT_EQ(scenario.seed, 18446744073709551615U);
  EXPECT_EQ(scenario.rig.integrator.method, solver::Method::cvode);
  EXPECT_DOUBLE_EQ(scenario.criteria.at(1).spread_below.value(), 0.05);
}

TEST(Scenario, LeavesTheRestAtItsDefault) {
  const Rig thesis;
  const Scenario scenario = read_text(good_scenario);
  EXPECT_EQ(scenario.rig.muscle.rest_radius_m, thesis.muscle.rest_radius_m);
  EXPECT_EQ(scenario.rig.valve.conductance_m3_per_s_Pa, thesis.valve.conductance_m3_per_s_Pa);
  EXPECT_EQ(scenario.rig.tick_s, thesis.tick_s);
  EXPECT_EQ(controllers::name_of(scenario.controllers.at(1)), "static_inverse");
}

TEST(Scenario, ResolvedReadsBackBitForBit) {
  const std::string once = scenario_json(read_text(good_scenario)).dump(2);
  const std::string twice = scenario_json(read_text(once)).dump(2);
  EXPECT_EQ(once, twice);  // shortest digits that read back: equal texts are equal bits
}

TEST(Scenario, YamlReadsBackBitForBit) {
  const Scenario scenario = read_text(good_scenario);
  EXPECT_EQ(scenario_json(read_text(to_yaml(scenario_json(scenario)))).dump(),
            scenario_json(scenario).dump());
}

TEST(Yaml, QuotesWhatYamlWouldMisread) {
  const Json object{{"a", "0.3 m"},
                    {"b", "true"},
                    {"c", "12"},
                    {"d", "x: y"},
                    {"e", ""},
                    {"f", {"-1 s2/mA2", "4 %"}},
                    {"g", {{"h", 1e-7}}},
                    {"i", {Json{{"j", 1}, {"k", false}}}}};
  EXPECT_EQ(to_yaml(object),
            "a: 0.3 m\nb: \"true\"\nc: \"12\"\nd: \"x: y\"\ne: \"\"\nf: [-1 s2/mA2, 4 %]\n"
            "g:\n  h: 1e-07\ni:\n  - j: 1\n    k: false\n");
}

TEST(Scenario, NameComesFromTheFile) {
  std::string text = good_scenario;
  text.erase(text.find("name: five_loads"), std::string_view("name: five_loads").size());
  std::vector<Problem> warnings;
  EXPECT_EQ(read_scenario(Source("some/where/my loads.yaml", text, ""), warnings).name, "my_loads");
}

TEST(Scenario, ALoadThatIsNextToNothingIsAskedAbout) {
  std::string text = good_scenario;
  text.replace(text.find("11.138 kg"), 9, "11.138 g");
  std::vector<Problem> warnings;
  read_text(text, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message.find("loads: 11.138 g is next to nothing for this muscle"),
            std::string::npos);
}

TEST(Scenario, GivenCommandsNeedNoTarget) {
  const auto with = [](const std::string& controllers) {
    return "schema: mckibben-scenario/1\nloads: [11 kg]\nduration: 2 s\ncontrollers: [" + controllers + "]\n";
  };
  const std::string sine = "{kind: sine_current, low: 4 mA, high: 10 mA, period: 2 s}";
  const Scenario scenario = read_text(with(sine));
  EXPECT_EQ(controllers::range(scenario.target, 1.0, 0.3), std::pair(0.0, 0.0));
  try {
    read_text(with(sine + ", {kind: pid, name: mine}"));
    ADD_FAILURE() << "a PID follows a target";
  } catch (const BadInput& bad) {
    EXPECT_NE(std::string(bad.what()).find("target is missing: the movement that mine follows"),
              std::string::npos)
        << bad.what();
  }
}

TEST(Scenario, WarnsOfRisk) {
  std::string text = good_scenario;
  const std::string height = "to: 0.05";
  text.replace(text.find(height), height.size(), "to: 0.25");
  std::vector<Problem> warnings;
  read_text(text, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].severity, Severity::warning);
  EXPECT_EQ(warnings[0].place.line, 17u);
  EXPECT_NE(warnings[0].message.find("risk to the muscle (T 2.3)"), std::string::npos);
}

TEST(Scenario, WarnsOfTargetsBelowZeroInBothUnits) {
  for (const char* const below : {"to: -0.01", "to: -3 mm"}) {
    std::string text = good_scenario;
    const std::string height = "to: 0.05";
    text.replace(text.find(height), height.size(), below);
    std::vector<Problem> warnings;
    read_text(text, &warnings);
    ASSERT_EQ(warnings.size(), 1u) << below;
    EXPECT_NE(warnings[0].message.find("contraction ratio of -0.01; below 0"), std::string::npos);
  }
}

TEST(Scenario, WarnsOfMovesThatAreNeverMade) {
  std::string text = good_scenario;
  const std::string duration = "duration: ";
  const std::size_t at = text.find(duration) + duration.size();
  text.replace(at, text.find('\n', at) - at, "600 ms");
  std::vector<Problem> warnings;
  read_text(text, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message.find(" is not before the end: duration = 0.6 s"), std::string::npos)
      << warnings[0].message;
}

TEST(Scenario, WarnsOfAStiffnessBesideAHeldCoContraction) {
  const auto messages = [](const std::string& controller) {
    std::vector<Problem> warnings;
    read_text(R"(schema: mckibben-pair/1
duration: 1 s
targets:
  - angle: {kind: sine, mean: 0 deg, amplitude: 10 deg, period: 1 s}
    stiffness: {kind: ramps, start: 12 N.m/rad, moves: []}
controllers: [)" + controller +
                  "]\n",
              &warnings);
    return warnings;
  };
  EXPECT_TRUE(messages("{kind: pid}").empty());
  const auto held = messages("{kind: pid, co_contraction: 1.5 bar}");
  ASSERT_EQ(held.size(), 1u);
  EXPECT_EQ(held[0].place.line, 6u);
  EXPECT_EQ(held[0].message,
            "co_contraction = 1.5 bar: it is held, so pid does not follow the stiffness of targets; "
            "leave co_contraction out to follow it");
}

TEST(Scenario, WarnsOfAJointBeyondItsValves) {
  const auto found = [](const std::string& to, const std::string& stiffness) {
    std::vector<Problem> warnings;
    read_text(
        "schema: mckibben-pair/1\nduration: 2 s\ntargets:\n  - angle: {kind: steps, moves: [{at: 0.5 s, "
        "to: 5 deg},\n      {at: 1 s, to: " +
            to + "}]}\n    stiffness: {kind: steps, start: " + stiffness +
            ", moves: []}\ncontrollers: [{kind: pid}]\n",
        &warnings);
    return warnings;
  };
  for (const char* within : {"57 deg", "-57 deg"}) EXPECT_TRUE(found(within, "300 N.m/rad").size() <= 1u);
  EXPECT_TRUE(found("20 deg", "12 N.m/rad").empty());
  const auto far = found("70 deg", "12 N.m/rad");
  ASSERT_EQ(far.size(), 1u) << "the stiffness comes after";
  EXPECT_EQ(far[0].place.line, 5u);
  EXPECT_NE(far[0].message.find("an angle of 70 deg is out of reach: commands give -57."), std::string::npos)
      << far[0].message;
  const auto stiff = found("5 deg", "60 N.m/rad");
  ASSERT_EQ(stiff.size(), 1u);
  EXPECT_EQ(stiff[0].place.line, 6u);
  EXPECT_NE(stiff[0].message.find("a stiffness of 60 N.m/rad is out of reach at 5 deg: commands give "),
            std::string::npos)
      << stiff[0].message;
}

/// At the move that goes too far.
TEST(Scenario, HeightsThatNoMuscleReachesAreShownWhereTheyAreWritten) {
  std::vector<Problem> warnings;
  read_text(
      "schema: mckibben-scenario/1\nloads: [11 kg]\nduration: 9 s\ntarget:\n  kind: steps\n  start: 0.08\n"
      "  moves:\n    - {at: 1 s, to: 0.12}\n    - {at: 4 s, to: 0.25}\n    - {at: 7 s, to: 0.1}\n"
      "controllers: [{kind: pid}]\n",
      &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].place.line, 9u);
}

TEST(Scenario, WarnsOfValuesThatNobodyKnows) {
  std::string text = good_scenario;
  const std::string angle = "braid_angle: 21 deg}";
  text.replace(text.find(angle), angle.size(), "braid_angle: 21 deg ± unknown, end_correction: 1.3 ± 1 %}");
  std::vector<Problem> warnings;
  read_text(text, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].severity, Severity::warning);
  EXPECT_TRUE(warnings[0].message.ends_with("so results are one guess of many: muscle.braid_angle"))
      << warnings[0].message;
}

TEST(Scenario, RecordedCurrentIsLoaded) {
  const std::string text = good_scenario.substr(0, good_scenario.find("noise:")) +
                           "  - {kind: recorded_current, file: tests/bad/good.csv}\n";
  std::vector<Problem> warnings;
  const Scenario scenario = read_scenario(Source("test.yaml", text, MCKIBBEN_SOURCE_DIR), warnings);
  const auto& recorded = std::get<controllers::RecordedCurrent>(scenario.controllers.back());
  EXPECT_EQ(recorded.samples_mA, (std::vector<double>{4.0, 4.0}));
}

TEST(Rig, ResolvedReadsBackBitForBit) {
  Rig rig;
  rig.muscle.rest_radius_m = 0.0075 * (1.0 + 1e-15);
  rig.sensors.position().wiring = plant::EncoderWiring::crosswise;
  const YamlFile file = parse_yaml(Source("rig.yaml", to_json(rig).dump(), ""));
  Rig read;
  Problems problems;
  read_named(file.source, file.root, read, problems);
  EXPECT_EQ(problems.errors(), 0u);
  EXPECT_EQ(rig_json(read).dump(), rig_json(rig).dump());
  EXPECT_EQ(read.muscle.rest_radius_m, rig.muscle.rest_radius_m);
}

TEST(Rig, SaysHowWellItsNumbersAreKnown) {
  const YamlFile file = parse_yaml(Source("rig.yaml", R"(
base: thesis
muscle: {rest_length: 300 mm, rest_radius: 6 mm ± 0.1 mm, braid_angle: 23 deg +- 0.5 deg}
friction: {scale: 1 ± 0.3}
valve: {zero_command: 0 V, span_command: 10 V ± 50 mV, zero_pressure: 0.5 bar, span_pressure: 5 bar, conductance: 2.5e-9 m3/(s.Pa) ± 10 %}
hose: {conductance: 1e-8 m3/(s.Pa) ± unknown}
effects: {residual_law: {terms: [{of: v, coefficient: 3 N ± 1 N}]}}
)",
                                          ""));
  Rig rig, again;
  Problems problems;
  read_named(file.source, file.root, rig, problems);
  ASSERT_EQ(problems.errors(), 0u);
  ASSERT_EQ(rig.spreads.size(), 7u);
  EXPECT_DOUBLE_EQ(rig.spreads.at("muscle.rest_radius"), 1e-4);
  EXPECT_DOUBLE_EQ(rig.spreads.at("muscle.braid_angle"), 0.5 * std::numbers::pi / 180.0);
  EXPECT_DOUBLE_EQ(rig.spreads.at("friction.scale"), 0.3);
  EXPECT_DOUBLE_EQ(rig.spreads.at("valve.span_command"), 0.05);
  EXPECT_DOUBLE_EQ(rig.spreads.at("valve.conductance"), 2.5e-10);
  EXPECT_TRUE(std::isinf(rig.spreads.at("hose.conductance")));
  EXPECT_DOUBLE_EQ(rig.spreads.at("effects.residual_law.terms.0.coefficient"), 1.0);

  const YamlFile written = parse_yaml(Source("rig.yaml", to_yaml(to_json(rig)), ""));
  read_named(written.source, written.root, again, problems);
  ASSERT_EQ(problems.errors(), 0u);
  EXPECT_EQ(again.spreads, rig.spreads);
  EXPECT_EQ(again.muscle.rest_radius_m, rig.muscle.rest_radius_m);
}

TEST(Rig, AValueSaidAnewIsKnownAsWellAsIsSaidAnew) {
  Rig rig;
  rig.spreads = {{"muscle.rest_radius", 1e-4}, {"muscle.rest_length", 1e-3}};
  const YamlFile file = parse_yaml(Source("rig.yaml", "muscle: {rest_radius: 7 mm}", ""));
  Problems problems;
  read_struct(file.source, file.root, rig, problems, {}, {{}, &rig.spreads});
  EXPECT_EQ(problems.errors(), 0u);
  EXPECT_EQ(rig.spreads, (plant::Spreads{{"muscle.rest_length", 1e-3}}));
}

TEST(Rig, ShippedByName) {
  std::vector<InputFile> inputs;
  EXPECT_EQ(rig_json(read_rig("thesis", inputs)).dump(), rig_json(Rig{}).dump());
  EXPECT_THROW(read_rig("no/such/rig.yaml", inputs), MissingInput);
}

}  // namespace
}  // namespace mckibben::input
