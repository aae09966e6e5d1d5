// What a results folder is never allowed to do: take the place of what is read, of what another program
// writes, of what somebody else put there; or wait. Kills and full disks at every step: tests/faults.
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;

/// Holds the lock of a results folder as a program does that is writing it.
class Holder {
 public:
  explicit Holder(const fs::path& lock) : file_(open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    EXPECT_EQ(flock(file_, LOCK_EX | LOCK_NB), 0);
  }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;
  ~Holder() { close(file_); }

 private:
  int file_;
};

using Out = WithQuickScenario;

TEST_F(Out, WhatIsReadIsNeverReplaced) {
  fs::create_directories(scratch / "f");
  write_text(scratch / "f/rig.yaml", "schema: mckibben-rig/1\n");
  fs::create_symlink("f/rig.yaml", scratch / "link.yaml");
  write_text(scratch / "on_it.yaml", std::string(quick_scenario) + "rig: f/rig.yaml\n");
  write_text(scratch / "r1.csv", "time_s,current_mA,contraction_ratio\n0,12,0.01\n0.012,12,0.02\n");
  write_text(scratch / "dataset.yaml",
             "schema: mckibben-dataset/1\nruns: [{id: r1, file: r1.csv, load: 11.138 kg}]\n");
  fs::copy_file(MCKIBBEN_SOURCE_DIR "/scenarios/thesis_calibration.yaml", scratch / "f/calibration.yaml");
  for (const char* arguments :
       {"diagnose . --rig f/rig.yaml", "replay . --rig f/rig.yaml", "replay . --rig link.yaml",
        "run on_it.yaml", "map f/calibration.yaml --ratios 1 --speeds 1",
        "map '" MCKIBBEN_SOURCE_DIR "/scenarios/thesis_calibration.yaml' --rig f/rig.yaml",
        "check f/rig.yaml"}) {
    const auto said = run(std::string(arguments) + " --out f");
    EXPECT_EQ(said.status, 74) << arguments << said.err;
    EXPECT_TRUE(holds(said.err, " is read from there; give another --out"));
    EXPECT_TRUE(fs::exists(scratch / "f/rig.yaml")) << arguments;
  }
}

TEST_F(Out, ASecondOneOnTheSameOutIsRefusedAtOnce) {
  write_text(scratch / "campaign.yaml",
             "schema: mckibben-campaign/1\nloads: [11 kg]\n"
             "currents: [{duration: 1 s, current: {kind: step_current, moves: []}}]\n");
  {
    const Holder lock(scratch / ".r.lock"), truth(scratch / ".d-truth.lock");
    for (const char* arguments : {"run quick.yaml --out r", "dataset campaign.yaml --out d"}) {
      const auto said = run(arguments);
      EXPECT_EQ(said.status, 74) << arguments;
      EXPECT_EQ(said.out, "");
      EXPECT_TRUE(holds(said.err, "it is being written by another program"));
    }
  }
  EXPECT_EQ(run("run quick.yaml --out r").status, 0);  // a lock that its holder left behind holds nobody
  EXPECT_FALSE(fs::exists(scratch / ".r.lock"));
  write_text(scratch / ".r.lock", "mine");
  EXPECT_EQ(run("run quick.yaml --out r").status, 74);
  EXPECT_EQ(read_text(scratch / ".r.lock"), "mine");
}

// It cannot be exchanged, which would otherwise be known only when all is calculated.
TEST_F(Out, AMountedFolderIsRefusedAtOnce) {
  const auto said = run("run quick.yaml --out /proc");
  EXPECT_EQ(said.status, 74);
  EXPECT_TRUE(holds(said.err, "/proc: a file system is mounted there"));
}

TEST_F(Out, AFifoInAnOldResultIsNotWaitedFor) {
  const std::string command = "cd '" + (scratch / "").string() +
                              "' && timeout 60 '" MCKIBBEN_PROGRAM "' run quick.yaml --out r > said 2>&1";
  ASSERT_EQ(run("run quick.yaml --out r").status, 0);
  for (const char* name : {"table.txt", ".mckibben-files"}) {
    fs::remove(scratch / "r" / name);
    ASSERT_EQ(mkfifo((scratch / "r" / name).c_str(), 0666), 0);
    EXPECT_EQ(std::system(command.c_str()), 0) << name;
  }
  EXPECT_TRUE(fs::is_fifo(scratch / "r.old-1/table.txt"));
  EXPECT_TRUE(fs::is_fifo(scratch / "r.old-2/.mckibben-files"));
}

TEST_F(Out, NoFileOfTheUsersIsWrittenOverOrThrough) {
  write_text(scratch / "precious", "mine");
  for (const char* name : {"my.yaml.part", ".mckibben-1"}) fs::create_symlink("precious", scratch / name);
  EXPECT_EQ(run("init my.yaml").status, 0);
  EXPECT_EQ(read_text(scratch / "precious"), "mine");
  EXPECT_TRUE(fs::is_symlink(scratch / "my.yaml.part"));
  EXPECT_TRUE(fs::is_symlink(scratch / ".mckibben-1"));
  EXPECT_EQ(run("check my.yaml").status, 0);
  write_text(scratch / ".mckibben-2", "begun by a program that was killed");
  EXPECT_EQ(run("init other.yaml").status, 0);
  EXPECT_FALSE(fs::exists(scratch / ".mckibben-2"));
}

}  // namespace
}  // namespace mckibben::cli
