// What the machine may refuse: streams that are closed, full or not read, names that cannot be, limits on
// files, memory and threads. No result is lost by it, and none of it is called a defect.
#include <string>

#include <gtest/gtest.h>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;

class Machine : public WithQuickScenario {
 protected:
  Said sh(const std::string& script) { return shell(script, scratch); }
  bool is_whole(const std::string& folder) const { return fs::exists(scratch / folder / ".mckibben-files"); }
  /// A measured run as a MAT-file.
  void make_mat() {
    ASSERT_EQ(run("run quick.yaml --format mat --out made").status, 0);
    fs::copy(scratch / "made/11.138kg_sine_current.mat", scratch / "r1.mat");
    write_text(scratch / "dataset.yaml",
               "schema: mckibben-dataset/1\nruns: [{id: r1, file: r1.mat, load: 11.138 kg}]\n");
  }
};
using Memory = Machine;

TEST_F(Machine, WhatCannotBeSaidOnStderrIsNoFailure) {
  for (const std::string gone : {"2>&-", "2>/dev/full"}) {
    EXPECT_EQ(sh("\"$M\" run quick.yaml --out r " + gone).status, 0) << gone;
    EXPECT_TRUE(is_whole("r")) << gone;
    EXPECT_EQ(sh("\"$M\" run missing.yaml " + gone).status, 66) << gone;
    fs::remove_all(scratch / "r");
  }
}

TEST_F(Machine, WhatCannotBePrintedIsInTheFolder) {
  for (const std::string gone : {">&-", ">/dev/full", "<&- >&- 2>&-"}) {
    const Said said = sh("\"$M\" run quick.yaml --out r " + gone);
    EXPECT_EQ(said.status, 74) << gone;
    EXPECT_EQ(said.err.empty(), gone.ends_with("2>&-")) << said.err;
    EXPECT_TRUE(is_whole("r")) << gone;
    fs::remove_all(scratch / "r");
  }
}

TEST_F(Machine, AReaderThatGoesAwayIsNoFailure) {
  const std::string nobody = "mkfifo p; exec 4<>p 5>p 4>&-; ";  // a pipe whose reader has gone
  for (const std::string arguments : {"--help", "schema", "run quick.yaml --json"}) {
    const Said said = sh("rm -f p; " + nobody + "\"$M\" " + arguments + " >&5");
    EXPECT_EQ(said.status, 0) << arguments;
    EXPECT_TRUE(lacks(said.err, "cannot"));
  }
  EXPECT_TRUE(is_whole("out/quick"));
  write_text(scratch / "bad.yaml", "schema: mckibben-scenario/1\n");
  EXPECT_EQ(sh("rm -f p; " + nobody + "\"$M\" check bad.yaml --json >&5").status, 65);
}

TEST_F(Machine, ClosedStreamsAreNeverTakenForFiles) {
  make_mat();
  EXPECT_EQ(sh("\"$M\" replay . --out r <&- 2>&-").status, 0);
  EXPECT_EQ(sh("\"$M\" replay . --out s >&-").status, 74);
  EXPECT_TRUE(is_whole("r"));
  EXPECT_TRUE(is_whole("s"));
}

TEST_F(Machine, NamesThatNoResultCanHoldAreRefusedAtOnce) {
  write_text(scratch / "bad\xff.yaml", quick_scenario);
  for (const std::string arguments :
       {"run 'bad\xff.yaml'", "run quick.yaml --out 'r\xff'", "run quick.yaml --out 'two\nlines'"}) {
    const Said said = run(arguments);
    EXPECT_EQ(said.status, 64) << arguments;
    EXPECT_TRUE(holds(said.err, "holds control characters or is not UTF-8"));
  }
  fs::create_directory(scratch / "\xff");
  EXPECT_EQ(sh("cd '\xff' && \"$M\" run ../quick.yaml").status, 64);
}

TEST_F(Machine, NamesThatAreTooLongAreSaid) {
  const std::string name(300, 'a');
  write_text(scratch / "dataset.yaml",
             "schema: mckibben-dataset/1\nruns: [{id: r, file: r.csv, load: 9 kg}]\n");
  write_text(scratch / "r.csv", "time_s,current_mA,contraction_ratio\n0,12,0.01\n0.012,12,0.02\n");
  const auto is_said = [&](const std::string& arguments, int status, const char* what) {
    const Said said = run(arguments);
    EXPECT_EQ(said.status, status) << arguments;
    EXPECT_TRUE(holds(said.err, what));
  };
  is_said("init " + name, 74, "File name too long");
  is_said("diagnose . --plan " + name, 74, "File name too long");
  is_said("replay . --rig " + name + ".yaml", 66, "File name too long");
  is_said("replay . --rig " + name, 66, "unknown rig");
  is_said("run quick.yaml --out " + name, 74, "cannot write");
}

TEST_F(Machine, ALimitOnTheSizeOfFilesIs74) {
  const Said said = sh("ulimit -f 4; \"$M\" run quick.yaml --out r");
  EXPECT_EQ(said.status, 74);
  EXPECT_TRUE(holds(said.err, "File too large"));
  EXPECT_FALSE(fs::exists(scratch / "r"));
}

TEST_F(Machine, TooFewDescriptorsAreNoFaultOfTheFile) {
  make_mat();
  for (const std::string descriptors : {"4", "5", "6"}) {
    // Without those that whoever runs the test left open: the loader would fail before us.
    const Said said =
        sh("exec 3>&- 4>&- 5>&- 6>&-; ulimit -n " + descriptors + "; \"$M\" check dataset.yaml");
    EXPECT_NE(said.status, 65) << said.err;
    EXPECT_TRUE(lacks(said.err, "defect"));
    if (said.status != 0) {
      EXPECT_TRUE(holds(said.err, "Too many open files"));
    }
  }
}

// What is refused takes less than 1 GiB; each of these took more.
TEST_F(Memory, OfFilesThatAreRefused) {
  write_text(scratch / "row.yaml",
             "schema: mckibben-dataset/1\nruns: [{id: r, file: row.csv, load: 9 kg}]\n");
  write_text(scratch / "head.yaml",
             "schema: mckibben-dataset/1\nruns: [{id: r, file: head.csv, load: 9 kg}]\n");
  write_text(scratch / "row.csv", "time_s,current_mA,contraction_ratio\n" + std::string(30'000'000, ','));
  write_text(scratch / "head.csv", std::string(30'000'000, ','));
  write_text(scratch / "deep.yaml", std::string(16'000'000, '['));
  std::string many = "a:\n";
  for (int i = 0; i < 4'000'000; ++i) many += "- 1\n";
  write_text(scratch / "many.yaml", many);
  for (const std::string file : {"row.yaml", "head.yaml", "deep.yaml", "many.yaml"}) {
    const Said said = sh("ulimit -v 1048576; \"$M\" check " + file);
    EXPECT_EQ(said.status, 65) << file << said.err;
    EXPECT_LT(said.err.size(), 1000u);
  }
  fs::create_directory(scratch / "a");
  write_text(scratch / "a/run.json", std::string(60'000'000, '['));
  EXPECT_EQ(sh("ulimit -v 1048576; \"$M\" diff a a").status, 65);
}

// Root may have as many processes as it likes; for others there is no thread but the first.
TEST_F(Machine, WithoutASecondThreadTheRunsAreMadeAllTheSame) {
  const Said said = sh("export M; bash -c 'ulimit -u 1; exec \"$M\" run quick.yaml --out r --threads 4'");
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(lacks(said.err, "defect"));
  EXPECT_TRUE(is_whole("r"));
}

// A thread's stack is as large as `ulimit -s` says, and there is no room for even one.
TEST_F(Memory, WithoutThreadsTheResultIsTheSame) {
  ASSERT_EQ(run("run quick.yaml --out many --threads 4").status, 0);
  const Said said = sh("ulimit -s 8000000; ulimit -v 4000000; \"$M\" run quick.yaml --out few --threads 4");
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(read_text(scratch / "few/run.json"), read_text(scratch / "many/run.json"));
}

}  // namespace
}  // namespace mckibben::cli
