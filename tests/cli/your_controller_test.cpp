// Controllers of one's own in a scenario, end to end: the shipped examples agree to the bit, on any number of
// threads; one that fails takes its own runs along and no others.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;
using input::Json;

/// The shipped folder, with what its page says to build.
void copy_examples(const fs::path& folder) {
  fs::copy(MCKIBBEN_SOURCE_DIR "/scenarios/your_controller", folder);
  fs::copy(MCKIBBEN_EXAMPLE_CONTROLLER, folder / "controller");
  fs::copy(MCKIBBEN_EXAMPLE_PLUGIN, folder / "plugin.so");
}

TEST(YourController, TheExamplesAgreeToTheBitOnAnyNumberOfThreads) {
  const Scratch scratch;
  copy_examples(scratch / "");
  for (const std::string threads : {"1", "3"}) {
    const Said said =
        mckibben("run your_controller.yaml --out out" + threads + " --threads " + threads, scratch);
    ASSERT_EQ(said.status, 0) << said.err;
  }
  EXPECT_EQ(shell("diff -r out1 out3", scratch).status, 0);
  const Json document = Json::parse(read_text(scratch / "out1/run.json"));
  ASSERT_EQ(document.at("runs").size(), 6U);
  for (const auto& run : document.at("runs")) {
    EXPECT_LT(run.at("rmse").get<double>(), 0.02);
    const std::string file = run.at("file").get<std::string>();
    const std::string in_python = file.substr(0, file.find('_')) + "_in_python.csv";  // LOAD_CONTROLLER.csv
    EXPECT_TRUE(read_text(scratch / "out1/" / file) == read_text(scratch / "out1/" / in_python)) << file;
  }
}

TEST(YourController, InOctaveAgreesToo) {
  if (shell("command -v octave-cli", "/").status != 0) GTEST_SKIP() << "there is no Octave here";
  const Scratch scratch;
  copy_examples(scratch / "");
  write_text(scratch / "o.yaml",
             "schema: mckibben-scenario/1\nloads: [16 kg]\nduration: 0.6 s\n"
             "target: {kind: ramps, start: 0.06, moves: [{at: 0.1 s, lasting: 0.3 s, to: 0.1}]}\n"
             "controllers:\n  - {kind: plugin, name: c, library: plugin.so}\n"
             "  - {kind: external, name: o, command: octave-cli --quiet --norc controller.m}\n");
  const Said said = mckibben("run o.yaml", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(shell("cmp out/o/16kg_c.csv out/o/16kg_o.csv", scratch).status, 0);
}

TEST(YourController, OneThatFailsTakesItsOwnRunAlong) {
  const Scratch scratch;
  write_text(scratch / "f.yaml",
             "schema: mckibben-scenario/1\nloads: [11 kg, 16 kg]\nduration: 0.5 s\n"
             "target: {kind: minimum_jerk, start: 0.05, moves: []}\n"
             "controllers:\n"
             "  - {kind: external, name: dies, command: 'read a; echo 5; read b; echo no more >&2; exit 7'}\n"
             "  - {kind: external, name: heavy, tell_load: true, command: 'read a; case $a in "
             "*load_kg\\\":16,*) exit 5;; esac; echo 6; while read b; do echo 6; done'}\n"
             "  - {kind: sine_current, low: 5 mA, high: 9 mA, period: 1 s}\n");
  const Said said = mckibben("run f.yaml --threads 2", scratch);
  EXPECT_EQ(said.status, 70) << said.err;
  const Json document = Json::parse(read_text(scratch / "out/f/run.json"));
  const std::string death = "tick 0 (0 s): it ended with status 7; its last words: \"no more\"";
  for (const auto& run : document.at("runs")) {
    const bool heavy = run.at("controller") == "heavy" && run.at("load_kg") == 16.0;
    if (run.at("controller") == "dies")
      EXPECT_EQ(run.at("failure"), death);
    else if (heavy)
      EXPECT_EQ(run.at("failure"), "before the run: it ended with status 5");
    else
      EXPECT_FALSE(run.contains("failure")) << run;
  }
  EXPECT_TRUE(holds(said.out, death));
  EXPECT_TRUE(holds(read_text(scratch / "out/f/report.html"), "it ended with status 7"));
}

TEST(YourController, LastWordsThatAreNoTextLoseNothingOfTheOthers) {
  const Scratch scratch;
  write_text(scratch / "f.yaml",
             "schema: mckibben-scenario/1\nloads: [11 kg]\nduration: 0.5 s\n"
             "target: {kind: minimum_jerk, start: 0.05, moves: []}\n"
             "controllers:\n"
             "  - {kind: external, name: last, command: \"read a; printf '\\\\377 bad' >&2; exit 2\"}\n"
             "  - {kind: external, name: says, command: \"read a; printf '\\\\377\\\\n'\"}\n"
             "  - {kind: sine_current, low: 5 mA, high: 9 mA, period: 1 s}\n");
  const Said said = mckibben("run f.yaml", scratch);
  EXPECT_EQ(said.status, 70) << said.err;
  EXPECT_TRUE(holds(said.out, "its last words: \"? bad\"", "its answer is no number of mA: \"?\""));
  EXPECT_TRUE(fs::exists(scratch / "out/f/11kg_sine_current.csv"));
}

TEST(YourController, CheckRunsNothingOfIt) {
  const Scratch scratch;
  write_text(scratch / "c.yaml",
             "schema: mckibben-scenario/1\nloads: [11 kg]\nduration: 0.5 s\n"
             "target: {kind: minimum_jerk, start: 0.05, moves: []}\n"
             "controllers: [{kind: external, command: touch it_ran}]\n");
  EXPECT_EQ(mckibben("check c.yaml", scratch).status, 0);
  EXPECT_FALSE(fs::exists(scratch / "it_ran"));
  write_text(scratch / "p.yaml",
             "schema: mckibben-scenario/1\nloads: [11 kg]\nduration: 0.5 s\n"
             "target: {kind: minimum_jerk, start: 0.05, moves: []}\n"
             "controllers: [{kind: plugin, library: nowhere.so}]\n");
  const Said missing = mckibben("run p.yaml", scratch);
  EXPECT_EQ(missing.status, 66);
  EXPECT_TRUE(holds(missing.err, "p.yaml:5:39: "));
}

}  // namespace
}  // namespace mckibben::cli
