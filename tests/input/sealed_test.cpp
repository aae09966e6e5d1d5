// Sealed muscles in files: rigs read and written back, data sets without a command, scenarios without a
// controller.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include <sim/input/dataset_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/scenario_file.hpp>

#include "rig_text.hpp"
#include "scratch.hpp"

namespace mckibben::input {
namespace {

TEST(SealedFile, IsReadAndWrittenBack) {
  const Rig rig = rig_of("valve: {kind: none, fill_pressure: 3 bar ± 0.1 bar}");
  EXPECT_TRUE(rig.valve.seals());
  EXPECT_EQ(rig.valve.fill_pressure_Pa, 3e5);
  EXPECT_DOUBLE_EQ(rig.spreads.at("valve.fill_pressure"), 1e4);
  const Json written = to_json(rig).at("valve");
  EXPECT_EQ(written.at("kind"), "none");
  for (const char* other : {"zero_command", "supply_pressure", "conductance", "proportional_band"})
    EXPECT_FALSE(written.contains(other)) << other;
  EXPECT_EQ(to_json(rig_of("valve: " + written.dump())), to_json(rig));
}

TEST(SealedFile, DataNeedNoCommand) {
  const Scratch scratch;
  std::ofstream(scratch / "a.csv") << "t,p\n0,2\n0.1,1.9\n0.2,1.8\n0.3,1.75\n0.4,1.7\n";
  std::ofstream(scratch / "dataset.yaml") << R"(schema: mckibben-dataset/1
rig: {mechanics: {kind: held_length}, valve: {kind: none}}
columns: {time: {column: t, unit: s}, muscle_pressure: {column: p, unit: bar}}
runs: [{id: a, file: a.csv}]
)";
  const Dataset data = read_dataset(scratch / "dataset.yaml");
  EXPECT_EQ(data.judged(), domain::Judged::pressure);
  EXPECT_FALSE(data.runs[0].measured->gives("command"));
}

TEST(SealedFile, AScenarioNeedsNoController) {
  std::vector<Problem> warnings;
  const Scenario scenario = read_scenario(Source("sealed.yaml", R"(schema: mckibben-scenario/1
rig: {valve: {kind: none, fill_pressure: 3 bar}}
loads: [10 kg]
duration: 1 s
target: {kind: points, points: [{at: 0 s, to: 0.1}]}
joint_force: [{at: 0.5 s, force: 50 N}]
)",
                                                 ""),
                                          warnings);
  ASSERT_EQ(scenario.controllers.size(), 1u);
  EXPECT_EQ(controllers::name_of(scenario.controllers[0]), "sealed");
}

TEST(SealedFile, AScenarioNeedsNoTarget) {
  for (const char* mechanics : {"{kind: hanging_load}", "{kind: lever}"}) {
    const std::string text = std::string("schema: mckibben-scenario/1\nloads: [1 kg]\nduration: 1 s\n") +
                             "rig: {valve: {kind: none}, mechanics: " + mechanics + "}\n";
    std::vector<Problem> warnings;
    const Scenario scenario = read_scenario(Source("sealed.yaml", text, ""), warnings);
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(controllers::range(scenario.target, 1.0, 0.3), std::pair(0.0, 0.0));
    EXPECT_EQ(controllers::range(scenario.angle, 1.0, 0.3), std::pair(0.0, 0.0));
    EXPECT_EQ(scenario.controllers.size(), 1u);
  }
  std::vector<Problem> warnings;
  EXPECT_THROW(read_scenario(Source("open.yaml",
                                    "schema: mckibben-scenario/1\nloads: [1 kg]\nduration: 1 s\n"
                                    "controllers: [{kind: pid}]\n",
                                    ""),
                             warnings),
               BadInput);
}

}  // namespace
}  // namespace mckibben::input
