// Controllers that need a calibration: it is read with the scenario, once, and counted among its inputs.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include <sim/input/scenario_file.hpp>

namespace mckibben::input {
namespace {

const std::string good_open_loop = R"(schema: mckibben-scenario/1
loads: [16.138 kg]
duration: 1 s
target: {kind: points, points: [{at: 0 s, to: 0.05}]}
controllers:
  - {kind: open_loop, calibration: calibration.yaml}
  - {kind: open_loop, name: up, calibration: calibration.yaml, mode: triangle, to: 30 mm, speed: 0.2 1/s}
  - {kind: open_loop, name: weighs, calibration: calibration.yaml, weighing: {speed: 8 mA/s}}
  - {kind: feedforward_pid, calibration: calibration.yaml}
)";

Scenario read() {
  std::vector<Problem> warnings;
  return read_scenario(Source("test.yaml", good_open_loop, MCKIBBEN_TEST_DATA), warnings);
}

TEST(OpenLoopScenario, LoadsTheCalibrationOfEachController) {
  Scenario scenario = read();
  for (auto& settings : scenario.controllers) {
    const auto* calibrated = controllers::part_of<controllers::CalibrationTerms>(settings);
    ASSERT_NE(calibrated, nullptr);
    EXPECT_EQ(calibrated->model.contraction.a0, (controllers::InLoad{3e3, 2e4}));
    EXPECT_EQ(calibrated->model.range.highest_load_kg, 23.5);
  }
  const auto& up = std::get<controllers::OpenLoopSettings>(scenario.controllers[1]);
  EXPECT_EQ(up.mode, controllers::OpenLoopMode::triangle);
  EXPECT_EQ(up.speed_per_s, 0.2);
  EXPECT_NEAR(up.to.ratio(0.3), 0.1, 1e-12);
  EXPECT_EQ(controllers::weighing_of(scenario.controllers[2])->speed_mA_per_s, 8.0);
  EXPECT_EQ(controllers::weighing_of(scenario.controllers[3]), nullptr);
}

TEST(OpenLoopScenario, CountsTheCalibrationAmongItsInputsOnce) {
  const Scenario scenario = read();
  const auto is_calibration = [](const InputFile& file) { return file.name.ends_with("calibration.yaml"); };
  EXPECT_EQ(std::count_if(scenario.inputs.begin(), scenario.inputs.end(), is_calibration), 1);
  EXPECT_EQ(scenario.inputs.front().name, "test.yaml");
}

TEST(OpenLoopScenario, IsToldThatItCannotFollowSteps) {
  const auto warnings_of = [](const std::string& target) {
    std::string text = good_open_loop;
    text.replace(text.find("{kind: points, points: [{at: 0 s, to: 0.05}]}"), 45, target);
    std::vector<Problem> warnings;
    read_scenario(Source("test.yaml", text, MCKIBBEN_TEST_DATA), warnings);
    return warnings;
  };
  EXPECT_TRUE(warnings_of("{kind: ramps, moves: [{at: 0.2 s, lasting: 0.5 s, to: 0.05}]}").empty());
  EXPECT_TRUE(warnings_of("{kind: steps, start: 0.05, moves: []}").empty());
  const auto warnings = warnings_of("{kind: steps, moves: [{at: 0.2 s, to: 0.05}]}");
  ASSERT_EQ(warnings.size(), 2u) << "those along the target";
  EXPECT_NE(warnings[0].message.find("kind = open_loop: it cannot follow steps"), std::string::npos);
}

TEST(ModelScenario, IsToldWhereTheModelIsTheSimulatedRigItself) {
  const auto warnings_of = [](const std::string& rig, const std::string& model) {
    std::vector<Problem> warnings;
    read_scenario(Source("test.yaml",
                         "schema: mckibben-scenario/1\nrig: " + rig +
                             "\nloads: [16.138 kg]\nduration: 1 s\n"
                             "target: {kind: points, points: [{at: 0 s, to: 0.05}]}\n"
                             "controllers:\n  - {kind: model_inverse, rig: " +
                             model + "}\n",
                         MCKIBBEN_TEST_DATA),
                  warnings);
    return warnings.empty() ? std::string() : to_text(warnings.front());
  };
  EXPECT_EQ(warnings_of("{base: thesis, muscle: {rest_radius: 8 mm}}", "thesis"), "");
  for (const char* rig : {"thesis", "{base: thesis, muscle: {rest_length: 300 mm}}"})
    EXPECT_NE(warnings_of(rig, "thesis")
                  .find("test.yaml:7:32: warning: rig = thesis: this is the simulated rig itself, so "
                        "model_inverse knows it exactly"),
              std::string::npos)
        << warnings_of(rig, "thesis");
}

}  // namespace
}  // namespace mckibben::input
