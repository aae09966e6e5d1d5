// One command line in several processes, as mpirun and srun start them: the same bytes as one alone makes,
// also when some of them die. The launcher's variables are set here as Slurm sets them; mpirun itself is
// tried where it is installed.
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;

std::string campaign_with(int repeats) {
  return "schema: mckibben-campaign/1\nloads: [11.138 kg, 23.406 kg]\nnoise: {encoder_jitter: 1e-4}\n"
         "currents: [{duration: 1.2 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 2.4 "
         "s}}]\n"
         "repeats: " +
         std::to_string(repeats) + "\n";
}

/// Lets ranks 0 to N - 1 do `mckibben WORDS`: `started NUMBER`, then `all` waits and prints each status.
constexpr const char* ranks =
    "export SLURM_JOB_ID=77 SLURM_STEP_ID=0\n"
    "rank() { SLURM_PROCID=$1 \"$M\" $words > out-$1 2> err-$1 & eval pid_$1=$!; }\n"
    "start() { export SLURM_STEP_NUM_TASKS=$1; n=0; while [ $n -lt $1 ]; do rank $n; n=$((n+1)); done; }\n"
    "ended() { eval wait \\$pid_$1; echo $1: $?; }\n"
    "at_work() { until [ -e $1.ranks/rank-1 ] && ls $1.unfinished/runs/*.json; do sleep 0.01; done > "
    "/dev/null 2>&1; }\n";

class Cluster : public InAFolder {
 protected:
  Said script(const std::string& words, const std::string& lines) {
    return shell("words='" + words + "'\n" + ranks + lines, scratch);
  }
  void expect_same(const std::string& one, const std::string& other) {
    EXPECT_EQ(contents(scratch / one), contents(scratch / other));
    EXPECT_FALSE(fs::exists(scratch / (other + ".ranks")));
    EXPECT_FALSE(fs::exists(scratch / (other + ".unfinished")));
  }
};

TEST_F(Cluster, ADataSetIsTheSameFromThreeRanksAndFromOneAlone) {
  write_text(scratch / "c.yaml", campaign_with(12));
  const auto alone = mckibben("dataset c.yaml --out alone", scratch);
  ASSERT_EQ(alone.status, 0) << alone.err;
  const auto said = script("dataset c.yaml --out three", "start 3; ended 0; ended 1; ended 2");
  EXPECT_EQ(said.out, "0: 0\n1: 0\n2: 0\n") << read_text(scratch / "err-0");
  expect_same("alone", "three");
  expect_same("alone-truth", "three-truth");
  EXPECT_EQ(read_text(scratch / "out-0"), alone.out);
  for (const char* quiet : {"out-1", "err-1", "out-2", "err-2"})
    EXPECT_EQ(read_text(scratch / quiet), "") << quiet;
}

TEST_F(Cluster, TunedAndRunByThreeRanksTheResultIsTheSame) {
  write_text(scratch / "s.yaml",
             "schema: mckibben-scenario/1\nloads: [11.138 kg, 16.138 kg]\nduration: 0.6 s\n"
             "target: {kind: sine, mean: 0.05, amplitude: 0.02, period: 1 s}\n"
             "controllers: [{kind: pid}, {kind: sine_current, low: 5 mA, high: 9 mA, "
             "period: 1 s}]\nnoise: {encoder_jitter: 1e-4}");
  const auto alone = mckibben("run s.yaml --out alone", scratch);
  ASSERT_EQ(alone.status, 0) << alone.err;
  const auto said = script("run s.yaml --out three", "start 3; ended 0; ended 1; ended 2");
  EXPECT_EQ(said.out, "0: 0\n1: 0\n2: 0\n") << read_text(scratch / "err-0");
  expect_same("alone", "three");
  EXPECT_EQ(read_text(scratch / "out-0"), alone.out);
}

TEST_F(Cluster, ARankThatDiesLosesNothingButWhatItWasAt) {
  write_text(scratch / "c.yaml", campaign_with(60));
  ASSERT_EQ(mckibben("dataset c.yaml --out alone", scratch).status, 0);
  const auto said = script("dataset c.yaml --out three",
                           "start 3; at_work three; kill -9 $pid_1; ended 0; ended 1; ended 2");
  EXPECT_EQ(said.out, "0: 0\n1: 137\n2: 0\n") << read_text(scratch / "err-0");
  expect_same("alone", "three");
  expect_same("alone-truth", "three-truth");
}

TEST_F(Cluster, WithoutRank0TheOthersGoOnAndTheSameCommandCompletesIt) {
  write_text(scratch / "c.yaml", campaign_with(60));
  ASSERT_EQ(mckibben("dataset c.yaml --out alone", scratch).status, 0);
  const auto said = script("dataset c.yaml --out three",
                           "start 2; at_work three; kill -9 $pid_0; ended 0; ended 1\n"
                           "ls three.unfinished/runs | wc -l\n"
                           "unset SLURM_STEP_ID; \"$M\" $words > said 2>&1; echo $?");
  EXPECT_EQ(said.out.find("0: 137\n1: 0\n"), 0u) << said.out << read_text(scratch / "err-1");
  EXPECT_TRUE(holds(said.out, "\n0\n")) << read_text(scratch / "said");
  EXPECT_TRUE(holds(read_text(scratch / "said"), "runs are there already; going on"));
  expect_same("alone", "three");
}

TEST_F(Cluster, AnEarlierCallStillAtWorkIsNotDisturbed) {
  write_text(scratch / "c.yaml", campaign_with(120));
  const auto said = script("dataset c.yaml --out three",
                           "start 2; at_work three; kill -STOP $pid_1; kill -9 $pid_0; ended 0\n"
                           "unset SLURM_STEP_ID; \"$M\" $words > said 2>&1; echo $?; kill -9 $pid_1");
  EXPECT_EQ(said.out, "0: 137\n74\n") << read_text(scratch / "said");
  EXPECT_TRUE(holds(read_text(scratch / "said"), "an earlier call are still at work"));
}

TEST_F(Cluster, OtherInputInOneOfThemIsRefused) {
  write_text(scratch / "c.yaml", campaign_with(2));
  const auto said =
      script("dataset c.yaml --out two",
             "export SLURM_STEP_NUM_TASKS=2; rank 0; words=\"$words --seed 9\"; rank 1; ended 1; "
             "ended 0");
  EXPECT_EQ(said.out, "1: 74\n0: 0\n");
  EXPECT_TRUE(holds(read_text(scratch / "err-1"), "mckibben (rank 1): rank 0 has read other input"));
}

TEST_F(Cluster, Rank0AloneSpeaksAndDoesWhatIsNotShared) {
  write_text(scratch / "bad.yaml", campaign_with(0));
  EXPECT_EQ(script("dataset bad.yaml", "start 2; ended 0; ended 1").out, "0: 65\n1: 65\n");
  EXPECT_TRUE(holds(read_text(scratch / "err-0"), "repeats = 0"));
  EXPECT_EQ(read_text(scratch / "err-1"), "");
  EXPECT_EQ(script("schema rig", "start 2; ended 0; ended 1").out, "0: 0\n1: 0\n");
  EXPECT_TRUE(holds(read_text(scratch / "err-0"), "schema is not shared out; one of 2 processes does all"));
  EXPECT_EQ(read_text(scratch / "out-1"), "");
}

TEST_F(Cluster, WhatIsTheUsersInTheirFolderStays) {
  write_text(scratch / "c.yaml", campaign_with(2));
  fs::create_directory(scratch / "two.ranks");
  write_text(scratch / "two.ranks/notes.txt", "mine");
  EXPECT_EQ(mckibben("dataset c.yaml --out two", scratch).status, 74);
  EXPECT_EQ(read_text(scratch / "two.ranks/notes.txt"), "mine");
}

TEST_F(Cluster, MpirunStartsThem) {
  if (std::system("command -v mpirun > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "mpirun is not installed (Debian: openmpi-bin); its variables alone cannot be tried";
  write_text(scratch / "c.yaml", campaign_with(6));
  ASSERT_EQ(mckibben("dataset c.yaml --out alone", scratch).status, 0);
  const auto said = shell(
      "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1\n"
      "mpirun -n 2 --oversubscribe \"$M\" dataset c.yaml --out two",
      scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(lacks(said.err, "rank 1"));
  expect_same("alone", "two");
}

}  // namespace
}  // namespace mckibben::cli
