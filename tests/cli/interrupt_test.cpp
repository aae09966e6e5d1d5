// Ctrl-C on a terminal: each long verb shows how far it is, then stops, keeps what is finished where that is
// of use, and says how to go on.
#include <cstdlib>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;
using input::Json;

class Interrupt : public InAFolder {
 protected:
  /// Runs the verb on a terminal of its own and presses Ctrl-C once what it shows matches `shown`.
  Said stop(const std::string& arguments, const std::string& shown) {
    write_text(scratch / "verb.sh", "echo $$ > pid\nexec '" MCKIBBEN_PROGRAM "' " + arguments + "\n");
    write_text(scratch / "stop.sh",
               "rm -f terminal pid\n"
               "script -qefc 'sh verb.sh' terminal > /dev/null < /dev/null & all=$!\n"
               "until grep -aqE '" +
                   shown +
                   "' terminal || ! kill -0 $all; do sleep 0.02; done 2> /dev/null\n"
                   "kill -INT $(cat pid); wait $all\n");
    const std::string command = "cd '" + static_cast<const fs::path&>(scratch).string() + "' && sh stop.sh";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", read_text(scratch / "terminal")};
  }
  bool exists(const std::string& name) { return fs::exists(scratch / name); }
  /// Results, whole or begun, and what is set aside.
  std::size_t entries(const std::string& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(scratch / folder), fs::directory_iterator()));
  }
};

constexpr const char* some_done = "[]] [1-9][0-9]*/";

/// Forty runs of a long time.
std::string long_scenario() {
  std::string text = "schema: mckibben-scenario/1\nloads: [10 kg";
  for (int i = 1; i < 40; ++i) text += ", " + std::to_string(10 + i) + " kg";
  return text +
         "]\nduration: 200 s\ntarget: {kind: steps, start: 0.05, moves: []}\n"
         "controllers: [{kind: triangle_current, low: 4 mA, high: 12 mA, period: 2 s}]\n";
}

/// Forty times the same measurement.
void write_long_dataset(const fs::path& folder) {
  fs::create_directory(folder);
  std::ofstream table(folder / "r.csv");
  table << "time_s,current_mA,contraction_ratio\n";
  for (int k = 0; k < 8000; ++k) table << std::to_string(0.012 * k) << ',' << (k / 100 % 8 + 4) << ",0.05\n";
  std::string text = "schema: mckibben-dataset/1\nruns:\n";
  for (int i = 10; i < 50; ++i) {
    const std::string n = std::to_string(i);
    text += "  - {id: r";
    text += n + ", file: r.csv, load: " + n + " kg}\n";
  }
  write_text(folder / "dataset.yaml", text);
}

TEST_F(Interrupt, OfRunLeavesTheRunsThatAreFinished) {
  write_text(scratch / "long.yaml", long_scenario());
  fs::create_directories(scratch / "out/long");
  write_text(scratch / "out/long/notes.txt", "mine");
  const Said said = stop("run long.yaml --threads 1", some_done);
  EXPECT_EQ(said.status, 130);
  EXPECT_TRUE(holds(said.err, "long: simulating [", "stopping after what is under way",
                    " of 40 runs are finished", "in out/long.interrupted",
                    "The same command makes all of them again"));
  EXPECT_EQ(read_text(scratch / "out/long/notes.txt"), "mine");
  const Json document = Json::parse(read_text(scratch / "out/long.interrupted/run.json"));
  EXPECT_EQ(document.at("interrupted"), true);
  std::size_t finished = 0;
  for (const Json& run : document.at("runs"))
    if (!run.contains("failure")) {
      ++finished;
      EXPECT_TRUE(exists("out/long.interrupted/" + run.at("file").get<std::string>()));
    }
  EXPECT_GT(finished, 0u);
  EXPECT_LT(finished, 40u);
  EXPECT_TRUE(holds(said.err, "interrupted; " + std::to_string(finished) + " of 40"));
  EXPECT_EQ(entries("out"), 2u);
}

TEST_F(Interrupt, OfReplayLeavesTheRunsThatAreFinished) {
  write_long_dataset(scratch / "data");
  const Said said = stop("replay data --threads 1 --json", some_done);
  EXPECT_EQ(said.status, 130);
  EXPECT_TRUE(holds(said.err, "of 40 runs are finished and in out/data-replay.interrupted"));
  const Json document = Json::parse(read_text(scratch / "out/data-replay.interrupted/run.json"));
  EXPECT_EQ(document.at("interrupted"), true);
  EXPECT_FALSE(document.at("runs")[0].contains("failure"));
  EXPECT_TRUE(exists("out/data-replay.interrupted/r10.csv"));
  EXPECT_EQ(document.at("runs")[39].at("failure"), "interrupted before it began");
  EXPECT_EQ(entries("out"), 1u);
}

TEST_F(Interrupt, OfMapLeavesTheTargetsThatAreFinished) {
  const Said said =
      stop("map '" MCKIBBEN_SOURCE_DIR
           "/scenarios/thesis_calibration.yaml' --load '16.138 kg' --ratios 300 --speeds 20 --out m",
           "simulating .*[]] [1-9][0-9]*/");
  EXPECT_EQ(said.status, 130);
  EXPECT_TRUE(holds(said.err, "of 12000 targets are finished and in m.interrupted"));
  const Json document = Json::parse(read_text(scratch / "m.interrupted/map.json"));
  EXPECT_EQ(document.at("interrupted"), true);
  EXPECT_FALSE(exists("m"));
}

// Before the rig as described has been simulated there is nothing to keep, and nothing is left behind.
TEST_F(Interrupt, OfDiagnoseLeavesEarlierResultsAlone) {
  const std::string campaign =
      "schema: mckibben-campaign/1\nloads: [11.138 kg, 14 kg, 18.87 kg, 23.406 kg]\n"
      "noise: {encoder_jitter: 1e-4}\n"
      "currents: [{duration: 8 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 2 s}}]\n";
  write_text(scratch / "some.yaml", campaign);
  ASSERT_EQ(mckibben("dataset some.yaml --out data", scratch).status, 0);
  const Said said = stop("diagnose data", "simulating the rig as described, step");
  EXPECT_EQ(said.status, 130) << said.err;
  EXPECT_TRUE(holds(said.err, "nothing was written", "The same command begins again"));
  EXPECT_EQ(entries("out"), 0u);
}

/// A leak that is hidden.
void write_leaking(const fs::path& folder) {
  write_text(
      folder / "leak.yaml",
      "schema: mckibben-campaign/1\nrig: {base: thesis, effects: {muscle_leak: {conductance: 2e-10 "
      "m3/(s.Pa)}}}\nloads: [11.138 kg, 14 kg, 18.87 kg, 23.406 kg]\nnoise: {encoder_jitter: 1e-4}\n"
      "currents: [{duration: 2 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 2 s}}]\n");
}

TEST_F(Interrupt, OfASearchKeepsWhatWasFound) {
  write_leaking(scratch);
  ASSERT_EQ(mckibben("dataset leak.yaml --out data", scratch).status, 0);
  const Said said = stop("diagnose data --threads 1", "looking for what would explain more, step");
  EXPECT_EQ(said.status, 130) << said.err;
  EXPECT_TRUE(holds(said.err, "what was found by then is in out/data-diagnose.interrupted"));
  const Json document = Json::parse(read_text(scratch / "out/data-diagnose.interrupted/diagnosis.json"));
  EXPECT_EQ(document.at("search").at("ended"), "by_user");
  EXPECT_TRUE(holds(document.at("because").get<std::string>(), "So far: ", "The search was ended by you"));
  EXPECT_FALSE(document.at("recalibrated").empty());  // the best so far
  EXPECT_FALSE(exists("out/data-diagnose"));
}

TEST_F(Interrupt, ASearchGoesOnFromWhereItWasEnded) {
  write_leaking(scratch);
  ASSERT_EQ(mckibben("dataset leak.yaml --out data", scratch).status, 0);
  EXPECT_TRUE(holds(mckibben("diagnose data --resume data", scratch).err, "data/search.bin: no such file"));
  ASSERT_EQ(stop("diagnose data --threads 1", "looking for what would explain more, step").status, 130);
  ASSERT_EQ(mckibben("diagnose data --out at_once", scratch).status, 0);
  const Said said = mckibben("diagnose data --resume out/data-diagnose.interrupted --out went_on", scratch);
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(read_text(scratch / "went_on/diagnosis.json"), read_text(scratch / "at_once/diagnosis.json"));
  EXPECT_FALSE(exists("went_on/search.bin"));  // it was through

  const fs::path kept = scratch / "out/data-diagnose.interrupted/search.bin";
  const std::string bytes = read_text(kept);
  const char* again = "diagnose data --resume out/data-diagnose.interrupted";
  std::string number = bytes, shape = bytes;
  number.back() = number.back() == 'a' ? 'b' : 'a';
  shape.replace(bytes.find("\"shapes\":[[") + 11, 1, "\"");
  for (const std::string& damaged :
       {bytes.substr(0, bytes.size() - 9), number, shape, std::string("nonsense")}) {
    write_text(kept, damaged);
    EXPECT_TRUE(holds(mckibben(again, scratch).err,
                      "search.bin: error: this is no search that was kept, or it is damaged"));
  }
  write_text(kept, bytes);
  write_text(scratch / "wide.yaml", "schema: mckibben-rig/1\nmuscle: {rest_radius: 8 mm}\n");
  EXPECT_TRUE(holds(mckibben(std::string(again) + " --rig wide.yaml", scratch).err,
                    "on other data, or on another rig"));
}

TEST_F(Interrupt, ATimeLimitEndsASearchWithWhatIsKnown) {
  write_leaking(scratch);
  ASSERT_EQ(mckibben("dataset leak.yaml --out data", scratch).status, 0);
  const Said said = mckibben("diagnose data --time-limit '1 us' --json", scratch);
  EXPECT_EQ(said.status, 0) << said.err;
  const Json document = Json::parse(said.out);
  EXPECT_EQ(document.at("verdict"), "cannot_tell");
  EXPECT_EQ(document.at("search").at("ended"), "by_time");
  EXPECT_EQ(document.at("search").at("not_done"), Json({"the rig's parameters", "effects and bench faults",
                                                        "general terms, for what is outside the catalogue"}));
  EXPECT_TRUE(holds(mckibben("diagnose data --time-limit '1 us' --out d", scratch).out,
                    "mckibben diagnose data --resume d"));
  EXPECT_EQ(mckibben("diagnose data --time-limit 0", scratch).status, 64);
  EXPECT_EQ(mckibben("diagnose data --time-limit '5 kg'", scratch).status, 64);
}

TEST_F(Interrupt, ProgressIsForTerminalsOnly) {
  write_text(scratch / "quick.yaml", quick_scenario);
  EXPECT_EQ(mckibben("run quick.yaml", scratch).err, "results in out/quick\n");
}

}  // namespace
}  // namespace mckibben::cli
