// Exit statuses, where words go, and what becomes of folders that are already there.
#include <string>

#include <gtest/gtest.h>

#include <sim/engine/versions.hpp>
#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;

using Program = WithQuickScenario;

TEST_F(Program, TellsItsVersion) {
  const std::string said = run("--version").out;
  EXPECT_EQ(said.rfind("mckibben " MCKIBBEN_VERSION "\nSUNDIALS " + engine::sundials_version(), 0), 0u)
      << said;
}

TEST_F(Program, UsageErrorsAre64) {
  for (const char* arguments :
       {"", "fly", "run", "run quick.yaml --threads 0", "run quick.yaml --threads many",
        "run quick.yaml --frobnicate", "run quick.yaml more.yaml", "schema kitchen",
        "run quick.yaml --seed -1", "run quick.yaml --seed 010", "run quick.yaml --seed 1e3",
        "run quick.yaml --seed 99999999999999999999"}) {
    const auto said = run(arguments);
    EXPECT_EQ(said.status, 64) << arguments;
    EXPECT_EQ(said.out, "") << arguments;
    EXPECT_NE(said.err, "") << arguments;
  }
}

TEST_F(Program, AnUnknownVerbIsNamedWithWhatWasMeant) {
  EXPECT_TRUE(holds(run("replya x").err, "unknown verb replya; did you mean replay?"));
}

TEST_F(Program, BadInputIs65AndNothingIsRun) {
  write_text(scratch / "bad.yaml", std::string(quick_scenario) + "sede: 3\nduration: 1 s\n");
  const auto said = run("run bad.yaml");
  EXPECT_EQ(said.status, 65);
  EXPECT_EQ(said.out, "");
  EXPECT_TRUE(holds(said.err, "bad.yaml:9:1: error: ", "did you mean seed",
                    "bad.yaml:10:1: error: "));  // all errors at once
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

TEST_F(Program, MissingInputIs66) {
  EXPECT_EQ(run("run nowhere.yaml").status, 66);
  EXPECT_EQ(run("replay nowhere").status, 66);
  EXPECT_EQ(run("check quick.yaml nowhere.yaml").status, 66);
}

TEST_F(Program, AnUnmetCriterionIs1) {
  write_text(scratch / "strict.yaml", std::string(quick_scenario) + "criteria: [{rmse_below: 1e-9}]\n");
  const auto said = run("run strict.yaml");
  EXPECT_EQ(said.status, 1);
  EXPECT_TRUE(holds(said.out, "criteria not met"));
  EXPECT_TRUE(fs::exists(scratch / "out/strict/run.json"));
}

// A law that pulls a heavy load past the range in which the braid is defined.
TEST_F(Program, ANumericalFailureIs70AndNamesTimeStateAndCause) {
  write_text(scratch / "fall.yaml",
             "schema: mckibben-scenario/1\nrig: {muscle: {stop_stiffness: 1e5 N/m},"
             " effects: {residual_law: {terms: [{of: m g, coefficient: -400 N}]}}}\n"
             "loads: [45 kg, 11.138 kg]\nduration: 1 s\ntarget: {kind: steps, start: 0.01, moves: []}\n"
             "controllers: [{kind: step_current, moves: []}]\n");
  const auto said = run("run fall.yaml");
  EXPECT_EQ(said.status, 70);
  EXPECT_TRUE(holds(said.out, "integration failed at t = ", "contraction_ratio = ", "(settling)"));
  EXPECT_TRUE(fs::exists(scratch / "out/fall/11.138kg_step_current.csv"));  // the sound run is not lost
  EXPECT_TRUE(holds(said.out, "\n  step_current (1 of 2 loads)  "));
  EXPECT_TRUE(lacks(said.out, "cannot be evaluated"));

  write_text(scratch / "fall.yaml",
             read_text(scratch / "fall.yaml") + "criteria: [{rmse_below: 0.9, spread_below: 0.9}]\n");
  const auto judged = run("run fall.yaml");
  EXPECT_EQ(judged.status, 70);
  EXPECT_TRUE(lacks(judged.out, "criteria not met"));
  EXPECT_TRUE(holds(judged.out, "criteria that cannot be evaluated\n",
                    "  step_current at 45 kg: its errors, as it has no result\n",
                    "  step_current: its spread, as 1 of 2 loads have a result\n"));
  const auto document = input::Json::parse(read_text(scratch / "out/fall/run.json"));
  EXPECT_EQ(document.at("criteria_not_evaluated").size(), 2u);
  EXPECT_EQ(document.at("spreads").at(0).at("runs_with_result"), 1);
  const std::string report = read_text(scratch / "out/fall/report.html");  // and the page leads to it alone
  EXPECT_TRUE(
      holds(report, "<tr><th scope='row'>45 kg</th><td>no result</td>",
            "<tr data-group='0'><th scope='row'><a href='#group-0' data-group='0'>11.138 kg</a></th>"));
}

TEST_F(Program, WhatCannotBeWrittenIs74) {
  write_text(scratch / "file", "mine");
  EXPECT_EQ(run("run quick.yaml --out file").status, 74);
  EXPECT_EQ(run("run quick.yaml --out file/below").status, 74);
  EXPECT_EQ(read_text(scratch / "file"), "mine");
  EXPECT_EQ(run("run quick.yaml --json > /dev/full; exit $?; true").status, 74);
}

TEST_F(Program, ResultsAreSwappedInWhole) {
  ASSERT_EQ(run("run quick.yaml --out r").status, 0);
  const auto before = fs::last_write_time(scratch / "r/run.json");
  ASSERT_EQ(run("run quick.yaml --out r").status, 0);
  EXPECT_NE(fs::last_write_time(scratch / "r/run.json"), before);
  int entries = 0;  // quick.yaml and r: no leftovers
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(static_cast<const fs::path&>(scratch)))
    ++entries;
  EXPECT_EQ(entries, 2);
}

TEST_F(Program, NothingOfTheUsersIsLost) {
  ASSERT_EQ(run("run quick.yaml --out r").status, 0);
  write_text(scratch / "r/notes.txt", "mine");
  const auto said = run("run quick.yaml --out r");
  EXPECT_EQ(said.status, 0);
  EXPECT_EQ(read_text(scratch / "r.old-1/notes.txt"), "mine");
  EXPECT_FALSE(fs::exists(scratch / "r/notes.txt"));
  EXPECT_TRUE(holds(said.err, "r.old-1"));
}

TEST_F(Program, AResultOfAnotherJobOrOneThatWasChangedIsSetAside) {
  write_text(scratch / "other.yaml", quick_scenario);
  ASSERT_EQ(run("run quick.yaml --out r").status, 0);
  const std::string first = read_text(scratch / "r/run.json");
  const Said said = run("run other.yaml --out r");
  ASSERT_EQ(said.status, 0);
  EXPECT_TRUE(
      holds(said.err, "r was not an unchanged earlier result of this verb and input; it was moved to "));
  EXPECT_EQ(read_text(scratch / "r.old-1/run.json"), first);
  write_text(scratch / "r/table.txt", "annotated");
  ASSERT_EQ(run("run other.yaml --out r").status, 0);
  EXPECT_EQ(read_text(scratch / "r.old-2/table.txt"), "annotated");
}

TEST_F(Program, TheCurrentFolderIsNeverReplaced) {
  for (const char* out : {".", "..", "/"}) {
    const auto said = run(std::string("run quick.yaml --out ") + out);
    EXPECT_EQ(said.status, 74) << out;
    EXPECT_EQ(said.out, "") << out;
  }
  EXPECT_EQ(read_text(scratch / "quick.yaml"), quick_scenario);
}

TEST_F(Program, AFolderThatIsReadFromIsNeverReplaced) {
  fs::create_directory(scratch / "mine");
  write_text(scratch / "mine/quick.yaml", quick_scenario);
  write_text(
      scratch / "mine/campaign.yaml",
      "schema: mckibben-campaign/1\nloads: [11 kg]\n"
      "currents: [{duration: 1 s, current: {kind: sine_current, low: 5 mA, high: 9 mA, period: 1 s}}]\n");
  EXPECT_EQ(run("run mine/quick.yaml --out mine").status, 74);
  EXPECT_EQ(run("dataset mine/campaign.yaml --out mine").status, 74);
  fs::rename(scratch / "mine", scratch / "mine-truth");
  EXPECT_EQ(run("dataset mine-truth/campaign.yaml --out mine").status, 74);
  fs::rename(scratch / "mine-truth", scratch / "mine");
  EXPECT_TRUE(fs::exists(scratch / "mine/quick.yaml"));
}

TEST_F(Program, ResultsGoWhereALinkLeads) {
  fs::create_directory(scratch / "disk");
  fs::create_directory_symlink(scratch / "disk", scratch / "link");
  fs::create_directory_symlink(scratch / "nowhere", scratch / "dangling");
  ASSERT_EQ(run("run quick.yaml --out link").status, 0);
  EXPECT_TRUE(fs::is_symlink(scratch / "link"));
  EXPECT_TRUE(fs::exists(scratch / "disk/run.json"));
  EXPECT_EQ(run("run quick.yaml --out dangling").status, 74);
}

TEST_F(Program, ABrokenPipeLosesNoResult) {
  run("run quick.yaml --json --out r | true; true");
  EXPECT_TRUE(fs::exists(scratch / "r/run.json"));
  for (const auto& entry : fs::directory_iterator(static_cast<const fs::path&>(scratch)))
    EXPECT_TRUE(lacks(entry.path().filename().string(), ".writing")) << entry.path();
}

TEST_F(Program, LoadsThatDifferLittleGetFilesOfTheirOwn) {
  write_text(
      scratch / "close.yaml",
      "schema: mckibben-scenario/1\nloads: [11.138 kg, 11.1380001 kg]\nduration: 1 s\n"
      "target: {kind: steps, start: 0.01, moves: []}\ncontrollers: [{kind: step_current, moves: []}]\n");
  ASSERT_EQ(run("run close.yaml").status, 0);
  EXPECT_TRUE(fs::exists(scratch / "out/close/11.138kg_step_current.csv"));
  EXPECT_TRUE(fs::exists(scratch / "out/close/11.1380001kg_step_current.csv"));
}

TEST_F(Program, APidThatCannotBeTunedFailsAlone) {
  write_text(scratch / "heavy.yaml",
             "schema: mckibben-scenario/1\nrig: {muscle: {stop_stiffness: 30000 N/m, stop_damping: 0 s/m}}\n"
             "loads: [11.138 kg]\nduration: 1 s\ntarget: {kind: steps, start: 0.01, moves: []}\n"
             "controllers: [{kind: pid, tuning_load: 500 kg}, {kind: step_current, moves: []}]\n");
  const auto said = run("run heavy.yaml");
  EXPECT_EQ(said.status, 70);
  EXPECT_TRUE(holds(said.out, "no gains gave a run that could be simulated"));
  EXPECT_TRUE(fs::exists(scratch / "out/heavy/11.138kg_step_current.csv"));
  EXPECT_FALSE(fs::exists(scratch / "out/heavy/11.138kg_pid.csv"));
}

TEST_F(Program, RiskToTheMuscleIsInTheJson) {
  write_text(scratch / "high.yaml",
             "schema: mckibben-scenario/1\nloads: [11.138 kg]\nduration: 3 s\n"
             "target: {kind: steps, start: 0.01, moves: []}\ncontrollers: [{kind: step_current, start: 18 "
             "mA, moves: []}]\n");
  const auto document = input::Json::parse(run("run high.yaml --json").out);
  EXPECT_EQ(document.at("runs").at(0).at("contraction").at("verdict"), "risk");
}

TEST_F(Program, AFailedRunLeavesEarlierResultsAlone) {
  ASSERT_EQ(run("run quick.yaml --out r").status, 0);
  const std::string before = read_text(scratch / "r/run.json");
  write_text(scratch / "quick.yaml", "schema: mckibben-scenario/1\n");
  EXPECT_EQ(run("run quick.yaml --out r").status, 65);
  EXPECT_EQ(read_text(scratch / "r/run.json"), before);
}

TEST_F(Program, CheckSaysOnceThatARigIsUnknown) {
  const std::string rig = "rig: {base: thesis, friction: {scale: 1 ± unknown}}\n";
  std::string text = read_text(scratch / "quick.yaml");
  for (const char* name : {"one.yaml", "two.yaml"}) write_text(scratch / name, text + rig);
  const std::string said = run("check one.yaml two.yaml").err, what = "± unknown, so results are one guess";
  EXPECT_NE(said.find(what), std::string::npos) << said;
  EXPECT_EQ(said.find(what), said.rfind(what)) << said;
}

TEST_F(Program, CheckTellsTheKindsApart) {
  write_text(scratch / "rig.yaml", "schema: mckibben-rig/1\nmuscle: {rest_length: 250 mm}\n");
  write_text(scratch / "odd.yaml", "schema: mckibben-kitchen/1\n");
  EXPECT_EQ(run("check quick.yaml rig.yaml").out,
            "quick.yaml: ok\nrig.yaml: ok\n  taken over from the base thesis: friction.scale, "
            "hose.conductance, muscle.braid_angle, muscle.dead_volume, muscle.end_correction, "
            "muscle.rest_radius, valve.conductance; write yours, or ± unknown\n");
  write_text(scratch / "open.yaml",
             "schema: mckibben-rig/1\nbase: home_made\nmuscle: {rest_length: 250 mm}\n"
             "valve: {conductance: 4e-9 m3/(s.Pa)}\n");
  EXPECT_EQ(run("check open.yaml").out, "open.yaml: ok\n") << "the base says that they are unknown";
  const auto said = run("check rig.yaml odd.yaml --json");
  EXPECT_EQ(said.status, 65);
  const auto document = input::Json::parse(said.out);
  EXPECT_EQ(document.at("files").at(0).at("ok"), true);
  EXPECT_EQ(document.at("files").at(1).at("problems").at(0).at("line"), 1);
}

TEST_F(Program, AResultsFolderSaysWhatToGiveInItsPlace) {
  ASSERT_EQ(run("run quick.yaml --out r").status, 0);
  const auto simulated = run("run r");
  EXPECT_EQ(simulated.status, 66);
  EXPECT_TRUE(holds(simulated.err,
                    "r: is a folder, not a file; written by `mckibben run quick.yaml`: give quick.yaml\n"));
  for (const char* verb : {"diagnose", "replay", "check", "calibrate"}) {
    const auto said = run(std::string(verb) + " r");
    EXPECT_EQ(said.status, 66) << verb;
    EXPECT_TRUE(holds(said.err,
                      "r: no dataset.yaml is in this folder; written by `mckibben run quick.yaml`; "
                      "of its tables one is made by: mckibben import r/*.csv\n"))
        << verb;
  }
  std::filesystem::create_directory(scratch / "mine");
  write_text(scratch / "mine/rig.yaml", "schema: mckibben-rig/1\n");
  EXPECT_TRUE(holds(run("live mine").err, "mine: is a folder, not a file; in it: mine/rig.yaml\n"));
}

TEST_F(Program, ShippedThesisRigIsTheBuiltInOne) {
  const auto said = run("schema rig --format yaml");
  EXPECT_EQ(said.status, 0);
  // The shipped file is this text under a heading.
  const std::string shipped = read_text(MCKIBBEN_SOURCE_DIR "/scenarios/rigs/thesis.yaml");
  EXPECT_TRUE(holds(shipped, said.out));
  write_text(scratch / "thesis.yaml", said.out);
  EXPECT_EQ(run("check thesis.yaml").status, 0);
}

TEST_F(Program, TheReferencePageIsWhatTheProgramPrints) {
  EXPECT_EQ(read_text(MCKIBBEN_SOURCE_DIR "/docs/reference.md"), run("schema all --format markdown").out)
      << "docs/reference.md is out of date: see docs/testing.md";
}

TEST(Check, SaysWhatIsToBeChangedForThisVersion) {
  const Scratch scratch;
  write_text(scratch / "old.yaml",
             "schema: mckibben-scenario/1\ncontrollers:\n  - {kind: feedforward_pid, weighing: {}}\n");
  write_text(scratch / "new.yaml", quick_scenario);
  const Said said = mckibben("check --upgrade old.yaml new.yaml", scratch);
  EXPECT_EQ(said.status, 65);
  EXPECT_TRUE(holds(said.err, "old.yaml:3:29: warning: weighing: remove it"));
  EXPECT_EQ(said.out, "new.yaml: ok (as this version wants it)\n");
  EXPECT_EQ(mckibben("check --upgrade nowhere.yaml", scratch).status, 66);
}

}  // namespace
}  // namespace mckibben::cli
