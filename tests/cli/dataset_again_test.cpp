// The verb dataset where there is something already: an interruption leaves no trace, and nothing of the
// user's is lost.
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <sim/input/campaign_file.hpp>
#include <sim/input/dataset_file.hpp>

#include "dataset.hpp"

namespace mckibben::cli {
namespace {

TEST_F(Dataset, AnInterruptedOneGoesOnAndItsFilesAreTheSame) {
  ASSERT_EQ(run("dataset small.yaml --out whole --format mat,netcdf").status, 0);
  begin(scratch / "parts", input::read_campaign(scratch / "small.yaml"), 5, {"netcdf", "mat", "csv"});
  // One of them was killed before its last file; another left half a file that nobody waits for.
  fs::remove(scratch / "parts.unfinished/runs/m1_up_r2.json");
  fs::remove(scratch / "parts.unfinished/data/m1_up_r1.csv");
  write_text(scratch / "parts.unfinished/data/.mckibben-3", "time_s,curr");
  const auto finished = scratch / "parts.unfinished/data/m1_c01_r1.nc";
  const auto before = fs::last_write_time(finished);
  const auto said = run("dataset small.yaml --out parts --format mat,netcdf");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.err, "3 of 8 runs are there already"));
  EXPECT_EQ(fs::last_write_time(scratch / "parts/m1_c01_r1.nc"), before);  // not made again
  EXPECT_EQ(contents(scratch / "whole"), contents(scratch / "parts"));
  EXPECT_EQ(contents(scratch / "whole-truth"), contents(scratch / "parts-truth"));
  EXPECT_FALSE(exists("parts.unfinished"));
}

TEST_F(Dataset, OtherFormatsStartAnewAndNothingIsLeftOver) {
  begin(scratch / "parts", input::read_campaign(scratch / "small.yaml"), 5, {"mat"});
  const auto said = run("dataset small.yaml --out parts");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.err, "starting anew"));
  for (const auto& [name, text] : contents(scratch / "parts")) EXPECT_FALSE(name.ends_with(".mat")) << name;
  EXPECT_FALSE(exists("parts.unfinished.old-1"));
}

TEST_F(Dataset, RunsThatSomebodyChangedAreMadeAgain) {
  ASSERT_EQ(run("dataset small.yaml --out whole").status, 0);
  begin(scratch / "parts", input::read_campaign(scratch / "small.yaml"), 7);
  const auto unfinished = scratch / "parts.unfinished";
  const auto spoil = [&](const std::string& name, const std::string& old, const std::string& with) {
    std::string text = read_text(unfinished / name);
    const auto at = text.find(old);
    ASSERT_NE(at, std::string::npos) << name;
    write_text(unfinished / name, text.replace(at, old.size(), with));
  };
  spoil("data/m1_c01_r1.csv", "0.012,", "0.013,");  // same size
  spoil("truth/m1_c01_r2.csv", "\n0.024,", "\n");   // shorter
  spoil("data/thesis/m1_up_r1.txt", "4", "4.0");    // longer
  spoil("runs/m1_up_r2.json", "\"rows\": ", "\"rows\": 1");
  write_text(unfinished / "runs/m2_c01_r1.json", "{}");
  const auto untouched = fs::last_write_time(unfinished / "data/m2_c01_r2.csv");
  const auto said = run("dataset small.yaml --out parts");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.err, "2 of 8 runs are there already",
                    "5 runs are not as written, and made again: m1_c01_r1"));
  EXPECT_EQ(fs::last_write_time(scratch / "parts/m2_c01_r2.csv"), untouched);
  EXPECT_EQ(contents(scratch / "whole"), contents(scratch / "parts"));
  EXPECT_EQ(contents(scratch / "whole-truth"), contents(scratch / "parts-truth"));
}

TEST_F(Dataset, ACampaignThatChangedStartsAnew) {
  begin(scratch / "parts", input::read_campaign(scratch / "small.yaml"), 5);
  const auto said = run("dataset small.yaml --out parts --seed 9");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.err, "starting anew"));
  ASSERT_EQ(run("dataset small.yaml --out whole --seed 9").status, 0);
  EXPECT_EQ(contents(scratch / "whole"), contents(scratch / "parts"));
}

TEST_F(Dataset, AnotherRecordingIsAnotherCampaign) {
  const std::string head = "time_s,current_mA\n0,4\n";
  write_text(scratch / "given.csv", head + "0.012,8\n");
  write_text(scratch / "played.yaml",
             "schema: mckibben-campaign/1\nloads: [11 kg]\n"
             "currents: [{duration: 0.1 s, current: {kind: recorded_current, file: given.csv}}]\n");
  begin(scratch / "out", input::read_campaign(scratch / "played.yaml"), 1);
  write_text(scratch / "given.csv", head + "0.012,9\n");
  ASSERT_EQ(run("dataset played.yaml --out out").status, 0);
  EXPECT_EQ(input::read_dataset(scratch / "out").runs.at(0).current_mA.at(1), 9.0);
}

TEST_F(Dataset, NothingOfTheUsersIsLost) {
  ASSERT_EQ(run("dataset small.yaml --out r").status, 0);
  write_text(scratch / "r/thesis/notes.txt", "mine");
  fs::create_directories(scratch / "r.unfinished");
  write_text(scratch / "r.unfinished/plan.json", "mine too");
  const auto said = run("dataset small.yaml --out r");
  EXPECT_EQ(said.status, 0);
  EXPECT_EQ(read_text(scratch / "r.old-1/thesis/notes.txt"), "mine");
  EXPECT_EQ(read_text(scratch / "r.unfinished.old-1/plan.json"), "mine too");
  EXPECT_FALSE(exists("r/thesis/notes.txt"));
  EXPECT_FALSE(exists("r-truth.old-1"));
  ASSERT_EQ(run("dataset small.yaml --out r").status, 0);  // only ours by now: replaced
  EXPECT_FALSE(exists("r.old-2"));
}

TEST_F(Dataset, CtrlCEndsWith130AndSaysHowToGoOn) {
  std::string text = small_campaign;
  text.replace(text.find("repeats: 2"), 10, "repeats: 5000");
  write_text(scratch / "long.yaml", text);
  write_text(scratch / "stop.sh",
             "'" MCKIBBEN_PROGRAM
             "' dataset long.yaml --threads 1 > said 2> err & pid=$!\n"
             "until ls out/long.unfinished/runs/*.json || ! kill -0 $pid; do sleep 0.02; done > ls 2>&1\n"
             "kill -INT $pid; wait $pid\n");
  const std::string command = "cd '" + (scratch / "").string() + "' && sh stop.sh";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  const std::string err = read_text(scratch / "err");
  EXPECT_TRUE(holds(err, "interrupted; ", "The same command goes on"));
  EXPECT_FALSE(exists("out/long"));
  EXPECT_TRUE(exists("out/long.unfinished/plan.json"));
}

}  // namespace
}  // namespace mckibben::cli
