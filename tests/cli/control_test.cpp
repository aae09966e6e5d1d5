// The verb control: a dry run shows the run that is simulated; what a simulated bench leaves is a data set
// that replays; what cannot drive a bench is refused.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

using input::Json;

constexpr const char* on_bench =
    "schema: mckibben-scenario/1\nrig: {base: thesis, settling_time: 0.06 s}\nloads: [16.138 kg]\n"
    "duration: 0.6 s\ntarget: {kind: ramps, start: 0.06, moves: [{at: 0.1 s, lasting: 0.3 s, to: 0.1}]}\n"
    "controllers: [{kind: pid, proportional: 60 mA, integral_time: 0.15 s, derivative_time: 0.05 s}]\n";

TEST(Control, ADryRunShowsWhatWouldBeSentAndWritesNothing) {
  const Scratch scratch;
  write_text(scratch / "b.yaml", on_bench);
  const Said said = mckibben("control b.yaml --dry-run --device serial --port /nowhere", scratch);
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.out, "nothing is sent", "b: 50 of 50 ticks of 12 ms"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
  EXPECT_EQ(said.out, mckibben("control b.yaml --dry-run", scratch).out);
}

// docs/sensors.md: at 0.1 mm, 30 mm are 300.
TEST(Control, ALasersCountsAreStepsOfItsResolution) {
  const Scratch scratch;
  std::string text = on_bench;
  text.replace(text.find("settling_time"), 0,
               "sensors: [{signal: contraction, kind: laser, resolution: 0.1 mm}], ");
  text.replace(text.find("duration: 0.6"), 13, "duration: 1.2");
  write_text(scratch / "b.yaml", text);
  const std::string out = mckibben("control b.yaml --dry-run", scratch).out;
  const std::size_t last = out.find("\n    99 ");
  ASSERT_NE(last, std::string::npos) << out;
  EXPECT_NEAR(std::stod(out.substr(last + 8)), 300.0, 5.0) << out;
}

TEST(Control, ADryRunIsASummaryUnlessAskedForAll) {
  const Scratch scratch;
  write_text(scratch / "b.yaml", on_bench);
  const auto lines = [](const Said& said) { return std::ranges::count(said.out, '\n'); };
  const Said brief = mckibben("control b.yaml --dry-run", scratch);
  const Said all = mckibben("control b.yaml --dry-run --verbose", scratch);
  EXPECT_TRUE(holds(brief.out, "\n     4 ", "\n   ...   40 more: --verbose\n    45 ", "\n    49 "));
  EXPECT_TRUE(holds(brief.out, "50 commands of 3.999 to ", " mA, one every 12 ms, the largest change "));
  EXPECT_EQ(lines(brief) + 39, lines(all)) << "ten rows and a line that says so, in place of fifty";
  EXPECT_FALSE(holds(all.out, "..."));
  EXPECT_EQ(mckibben("control b.yaml --verbose", scratch).status, 64);
}

TEST(Control, TheNextCommandLeavesOutWhatTheSimulatedBenchAdds) {
  const Scratch scratch;
  const auto next = [&](const std::string& rig) {
    std::string text(on_bench);
    const std::string from = "{base: thesis, settling_time: 0.06 s}";
    text.replace(text.find(from), from.size(), rig);
    write_text(scratch / "b.yaml", text);
    const std::string err = mckibben("control b.yaml --most-missed 1000", scratch).err;
    return err.substr(std::min(err.find("next: "), err.size()));
  };
  const std::string leak = "effects: {muscle_leak: {conductance: '5e-10 m3/(s.Pa)'}}";
  EXPECT_EQ(next("{" + leak + "}"), "next: mckibben diagnose out/b-control --rig thesis\n");
  write_text(scratch / "mine.yaml", "schema: mckibben-rig/1\nbase: thesis\n");
  EXPECT_EQ(next("{base: mine.yaml, " + leak + "}"),
            "next: mckibben diagnose out/b-control --rig mine.yaml\n");
  EXPECT_EQ(next("{base: thesis, settling_time: 0.06 s, " + leak + "}"),
            "next: mckibben diagnose out/b-control\n");
}

TEST(Control, ASimulatedBenchLeavesADataSetThatReplays) {
  const Scratch scratch;
  write_text(scratch / "b.yaml", on_bench);
  // However busy the machine is.
  const Said said = mckibben("control b.yaml --most-missed 1000 --json", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const Json document = Json::parse(said.out);
  EXPECT_EQ(document.at("ticks"), 50);
  EXPECT_GE(document.at("late_ms").at("largest").get<double>(),
            document.at("late_ms").at("median").get<double>());
  EXPECT_EQ(mckibben("check out/b-control/dataset.yaml", scratch).status, 0);
  EXPECT_EQ(mckibben("replay out/b-control", scratch).status, 0);

  const std::string recorded = read_text(scratch / "out/b-control/bench.csv");
  ASSERT_EQ(mckibben("control b.yaml --most-missed 1000", scratch).status, 0);
  EXPECT_EQ(read_text(scratch / "out/b-control.old-1/bench.csv"), recorded);
}

TEST(Control, ASimulatedBenchRecordsItsGauge) {
  const Scratch scratch;
  std::string text = on_bench;
  text.replace(text.find("settling_time"), 0,
               "sensors: [{signal: muscle_pressure, kind: gauge, resolution: 0.005 bar}], ");
  write_text(scratch / "b.yaml", text);
  ASSERT_EQ(mckibben("control b.yaml --most-missed 1000", scratch).status, 0);
  EXPECT_TRUE(holds(read_text(scratch / "out/b-control/dataset.yaml"), "muscle_pressure_bar"));
  const Said said = mckibben("replay out/b-control --json", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const Json gaps = Json::parse(said.out).at("runs").at(0).at("gaps");
  ASSERT_EQ(gaps.size(), 2U) << said.out;
  EXPECT_EQ(gaps.at(1).at("reading"), "muscle_pressure");
  EXPECT_LT(gaps.at(1).at("rmse").get<double>(), 0.01) << "bar, however busy the machine is";
}

TEST(Control, AReplayKnowsWhenEachCommandWentOut) {
  const Scratch scratch;
  std::string text = on_bench;
  text.replace(text.find("settling_time"), 0,
               "valve: {kind: on_off, switching: pwm, pwm_frequency: 50 Hz, zero_command: 0 V, "
               "span_command: 10 V}, ");
  text.replace(text.find("60 mA"), 5, "60 V, rest_command: 5 V");
  write_text(scratch / "b.yaml", text);
  ASSERT_EQ(mckibben("control b.yaml --most-missed 1000", scratch).status, 0);
  const Said said = mckibben("replay out/b-control --json", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const Json gap = Json::parse(said.out).at("runs").at(0).at("gaps").at(0);
  EXPECT_LT(gap.at("rmse").get<double>(), 0.03) << "mm, however busy the machine is";
}

// A machine that is away for half a second: the device holds its output meanwhile.
TEST(Control, MissedTicksCanBeRead) {
  const Scratch scratch;
  std::string text(on_bench);
  text.replace(text.find("duration: 0.6 s"), 15, "duration: 2.4 s");
  write_text(scratch / "b.yaml", text);
  const Said said = shell(
      "$M control b.yaml --most-missed 1000 & "
      "until [ $(cat out/b-control.unfinished/bench.csv 2>/dev/null | wc -l) -gt 30 ]; do sleep 0.05; done; "
      "kill -STOP $!; sleep 0.5; kill -CONT $!; wait $!",
      scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const Said checked = mckibben("check out/b-control", scratch);
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_TRUE(lacks(checked.err, "no rows from"));
  const Said replayed = mckibben("replay out/b-control --json", scratch);
  ASSERT_EQ(replayed.status, 0) << replayed.err;
  EXPECT_LT(Json::parse(replayed.out).at("runs").at(0).at("gaps").at(0).at("rmse").get<double>(), 0.03);
}

TEST(Control, LeavesOutNoEffectOfItsRig) {
  const Scratch scratch;
  std::string text(on_bench);
  text.replace(text.find("thesis"), 6, "festo_dmsp_20");
  write_text(scratch / "b.yaml", text);
  const Said said = mckibben("control b.yaml --most-missed 1000", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(read_text(scratch / "out/b-control/rig.yaml"), "bladder_elasticity"));
  EXPECT_EQ(mckibben("replay out/b-control", scratch).status, 0);
}

TEST(Control, WhatWasRecordedOutlivesAKillAsADataSet) {
  const Scratch scratch;
  std::string text(on_bench);
  text.replace(text.find("duration: 0.6 s"), 15, "duration: 600 s");
  write_text(scratch / "b.yaml", text);
  const Said killed = shell(
      "$M control b.yaml --most-missed 1000 & "
      "until [ $(cat out/b-control.unfinished/bench.csv 2>/dev/null | wc -l) -gt 30 ]; do sleep 0.05; done; "
      "kill -KILL $!",
      scratch);
  EXPECT_EQ(mckibben("check out/b-control.unfinished/dataset.yaml", scratch).status, 0);
  EXPECT_EQ(mckibben("replay out/b-control.unfinished", scratch).status, 0);
  const std::string kept = read_text(scratch / "out/b-control.unfinished/bench.csv");
  write_text(scratch / "b.yaml", on_bench);
  const Said again = mckibben("control b.yaml --most-missed 1000", scratch);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_TRUE(
      holds(again.err, "b-control.unfinished is of an earlier recording that was not finished; it stays"));
  EXPECT_EQ(read_text(scratch / "out/b-control.unfinished/bench.csv"), kept);
  EXPECT_FALSE(std::filesystem::exists(scratch / "out/b-control.unfinished-2"));
}

TEST(Control, AFullDiskIs74AndKeepsWhatFoundRoom) {
  const Scratch scratch;
  std::string text(on_bench);
  text.replace(text.find("duration: 0.6 s"), 15, "duration: 2.4 s");
  write_text(scratch / "b.yaml", text);
  // A limit to the size of files, in blocks of 512 bytes: room for the rig, not for all rows.
  const Said said = shell("ulimit -f 12; $M control b.yaml --most-missed 1000", scratch);
  EXPECT_EQ(said.status, 74) << said.err;
  EXPECT_TRUE(
      holds(said.err, "what was recorded until the disk was full is in ", "out/b-control.unfinished"));
  const std::string rows = read_text(scratch / "out/b-control.unfinished/bench.csv");
  EXPECT_GT(rows.size(), 4000U);
  EXPECT_EQ(rows.back(), '\n');
  EXPECT_EQ(mckibben("replay out/b-control.unfinished", scratch).status, 0);
}

TEST(Control, RefusesWhatCannotDriveABench) {
  const Scratch scratch;
  const auto refused = [&](std::string text, const std::string& from, const std::string& to, const char* why,
                           const std::string& options = "") {
    text.replace(text.find(from), from.size(), to);
    write_text(scratch / "b.yaml", text);
    const Said said = mckibben("control b.yaml " + options, scratch);
    EXPECT_EQ(said.status, 65) << why;
    EXPECT_TRUE(holds(said.err, why));
  };
  refused(on_bench, "[16.138 kg]", "[11 kg, 16 kg]", "b.yaml:3:8: error: loads: one load hangs on a bench");
  refused(on_bench, "proportional: 60 mA, ", "", "b.yaml:6:15: error: controllers: pid has no gains");
  for (const char* weighs : {"{kind: model_inverse}", "{kind: model_inverse_feedback}"})
    refused(on_bench, "{kind: pid, proportional: 60 mA, integral_time: 0.15 s, derivative_time: 0.05 s}",
            weighs, "write it down as assumed_load");
  for (const char* options : {"--device serial", "--device comedi", "--port /dev/ttyACM0",
                              "--device serial --port /nowhere --encoder 8:10"})
    EXPECT_EQ(mckibben(std::string("control b.yaml ") + options, scratch).status, 64) << options;
  write_text(scratch / "b.yaml", on_bench);
  const Said unreachable = mckibben("control b.yaml --device serial --port /nowhere/port", scratch);
  EXPECT_EQ(unreachable.status, 70);
  EXPECT_TRUE(holds(unreachable.err, "/nowhere/port cannot be opened as a serial port: "));
}

TEST(Control, ADryRunWarnsOfVoltagesThatHardlyAnyBoardGives) {
  const Scratch scratch;
  std::string text(on_bench);
  text.replace(text.find("proportional: 60 mA"), 19, "proportional: 300 V");
  text.replace(text.find("settling_time: 0.06 s"), 21,
               "valve: {zero_command: -100 V, span_command: 100 V, zero_pressure: 0 bar, span_pressure: "
               "5 bar}, dac: {lowest_command: -100 V, "
               "largest_command: 100 V}");
  write_text(scratch / "b.yaml", text);
  const std::string dry = "control b.yaml --dry-run --device ";
  EXPECT_TRUE(holds(mckibben(dry + "comedi --port /dev/comedi0", scratch).err,
                    "warning: the rig's dac gives -100 to 100 V, and most boards -10 to 10 V at most: write "
                    "dac: {lowest_command: -10 V, largest_command: 10 V}"));
  const std::string serial = mckibben(dry + "serial --port /nowhere", scratch).err;
  EXPECT_TRUE(lacks(serial, "most boards"));
  EXPECT_TRUE(holds(serial,
                    "warning: the sketch in scenarios/bench_serial drives a stage of 0 to 20 mA: write "
                    "unit[] = \"V\" and largest_command = 100 in it, and use a stage that makes 0 to "
                    "100 V",
                    "for -100 V change put()"));
  write_text(scratch / "b.yaml", on_bench);
  EXPECT_TRUE(lacks(mckibben(dry + "serial --port /nowhere", scratch).err, "warning"));
}

TEST(Control, WhatEndsBeforeTheFirstTickLeavesNoDataSet) {
  const Scratch scratch;
  std::string dies(on_bench);
  dies.replace(
      dies.find("controllers:"), std::string::npos,
      "controllers: [{kind: external, name: dies, preparation_ticks: 5, command: read a; echo 4; read b}]\n");
  write_text(scratch / "b.yaml", dies);
  const Said said = mckibben("control b.yaml --most-missed 1000", scratch);
  EXPECT_EQ(said.status, 70);
  EXPECT_TRUE(holds(said.out, "0 of 50 ticks of 12 ms; it ended before tick 0, and nothing was recorded"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "out/b-control/control.json"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "out/b-control/dataset.yaml"));
}

#ifdef MCKIBBEN_AT_STAND_IN
TEST(Control, ABoardByComediLeavesADataSetThatReplays) {
  const Scratch scratch;
  write_text(scratch / "b.yaml", on_bench);
  const std::string comedi = MCKIBBEN_AT_STAND_IN " control b.yaml --device comedi --port /dev/comedi0 ";
  const Said said = shell(comedi + "--encoder 8:10 --most-missed 1000 --json", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(Json::parse(said.out).at("device"), "comedi");
  EXPECT_EQ(mckibben("replay out/b-control", scratch).status, 0);
  const auto refused = [&](const char* wiring, int status, const char* why) {
    const Said refusal = shell(comedi + wiring, scratch);
    EXPECT_EQ(refusal.status, status) << wiring;
    EXPECT_TRUE(holds(refusal.err, why));
  };
  refused("--output 0:0", 70, "/dev/comedi0: subdevice 0 is no analog output");
  refused("--output one", 64, "one is neither a number nor two with a colon");
  refused("--encoder 8", 64, "8: an encoder has two signals");
  refused("--full-scale '10 mA'", 64, "10 mA");
}
#endif

}  // namespace
}  // namespace mckibben::cli
