// Controllers that are somebody else's: what they hear, how far they are obeyed, and that whatever becomes of
// them is a failure with its reason.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include <controllers/external.hpp>
#include <controllers/plugin.hpp>

#include "scratch.hpp"

namespace mckibben::controllers {
namespace {

Knowledge known() {
  Knowledge paper;
  paper.contraction_per_count = 4e-4;
  paper.tick_s = 0.012;
  paper.largest_current_mA = 20.0;
  paper.target = {0.05, 0.1, 0.15};
  paper.model = {0.0075, 0.3, 0.4, 1.0, false};
  paper.valve = {4.0, 20.0, 0.5e5, 5e5};
  return paper;
}

ExternalSettings shell(const std::string& script) {
  ExternalSettings settings;
  settings.command = script;
  return settings;
}

/// Why it gave up; ticks go from 0 to 9.
std::string failure_of(Controller& controller) {
  controller.rest();
  try {
    for (std::int64_t k = 0; k < 10; ++k) controller.step({k, static_cast<double>(k) * 0.012, 3});
  } catch (const ControllerFailure& failure) {
    return failure.what();
  }
  return "";
}
std::string failure_of(const auto& settings) {
  return failure_of(*settings.make(known()));
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(External, HearsItsLinesAndIsObeyed) {
  const Scratch scratch;
  ExternalSettings settings = shell("while read line; do echo \"$line\" >> heard; echo 7.25; done");
  settings.folder = (scratch / "").string();
  settings.highest_target = 0.12;
  settings.tell_load = true;
  settings.preparation_ticks = 1;
  Knowledge paper = known();
  paper.load_kg = 11.5;
  {
    const auto controller = settings.make(paper);
    EXPECT_EQ(controller->preparation_ticks(), 1);
    EXPECT_EQ(controller->rest().current_mA, 7.25);
    EXPECT_EQ(controller->step({-1, -0.012, 0}).current_mA, 7.25);
    EXPECT_EQ(controller->step({2, 0.024, 1000000}).current_mA, 7.25);
    EXPECT_TRUE(controller->findings().empty());
  }
  EXPECT_EQ(text_of(scratch / "heard"),
            "{\"mckibben_controller\":1,\"period_s\":0.012,\"contraction_per_count\":4e-04,\"middle_of_"
            "count\":0.5,"
            "\"rest_length_m\":0.3,\"command_unit\":\"mA\",\"lowest_mA\":4,\"highest_mA\":20,\"largest_"
            "current_speed_mA_per_s\":null,"
            "\"load_kg\":11.5,\"preparation_ticks\":1,\"target\":[0.05,0.1,0.12]}\n"
            "{\"tick\":-1,\"time_s\":-0.012,\"counts\":0,\"counts_lost\":false,\"target\":0.05}\n"
            "{\"tick\":2,\"time_s\":0.024,\"counts\":1000000,\"counts_lost\":false,\"target\":0.12}\n");
}

TEST(External, OfARigInVoltsHearsAndGivesVolts) {
  const Scratch scratch;
  ExternalSettings settings = shell("while read line; do echo \"$line\" >> heard; echo 7.25; done");
  settings.folder = (scratch / "").string();
  settings.largest_current_speed_mA_per_s = 40.0;
  Knowledge paper = known();
  paper.largest_current_mA = 10.0;
  paper.valve = {-5.0, 5.0, 0.5e5, 5e5, "V"};
  EXPECT_EQ(settings.make(paper)->rest().current_mA, 5.0);
  EXPECT_NE(text_of(scratch / "heard")
                .find("\"command_unit\":\"V\",\"lowest_V\":-5,\"highest_V\":5,"
                      "\"largest_command_speed_V_per_s\":40,"),
            std::string::npos);
  EXPECT_EQ(failure_of(*shell("echo six").make(paper)),
            "before the run: its answer is no number of V: \"six\"");
}

TEST(External, IsObeyedWithinItsLimitsOnly) {
  ExternalSettings settings = shell("read hello; echo 1e3; while read line; do echo -5; done");
  settings.lowest_current_mA = 5.0;
  settings.largest_current_speed_mA_per_s = 100.0;
  const auto controller = settings.make(known());
  EXPECT_EQ(controller->rest().current_mA, 20.0);
  EXPECT_DOUBLE_EQ(controller->step({0, 0.0, 0}).current_mA, 18.8);
  for (std::int64_t k = 1; k < 20; ++k) controller->step({k, 0.0, 0});
  EXPECT_EQ(controller->step({20, 0.0, 0}).current_mA, 5.0);
  EXPECT_EQ(value_of(controller->findings(), "ticks_limited"), 22.0);
}

TEST(External, HearsThatCountsAreLost) {
  const Scratch scratch;
  ExternalSettings settings = shell("while read line; do echo \"$line\" >> heard; echo 8; done");
  settings.folder = (scratch / "").string();
  settings.fastest_load_per_s = 1.0;
  const auto controller = settings.make(known());
  controller->rest();
  controller->step({0, 0.0, 10});
  controller->step({1, 0.012, 5000});
  EXPECT_NE(text_of(scratch / "heard").find("\"counts\":10,\"counts_lost\":true"), std::string::npos);
  EXPECT_EQ(value_of(controller->findings(), "ticks_without_counts"), 1.0);
}

TEST(External, WhateverBecomesOfItIsAFailureWithItsReason) {
  const auto says = [](const std::string& script, const std::string& failure) {
    ExternalSettings settings = shell(script);
    settings.time_limit_s = 0.2;
    settings.start_limit_s = 5.0;
    EXPECT_EQ(failure_of(settings), failure) << script;
  };
  const std::string answers = "read hello; echo 6; read a; echo 6; read b; ";
  says(answers + "exit 3", "tick 1 (0.012 s): it ended with status 3");
  says(answers + "echo 'a reason' >&2; exit 1",
       "tick 1 (0.012 s): it ended with status 1; its last words: \"a reason\"");
  says(answers + "kill -SEGV $$", "tick 1 (0.012 s): it was ended by a signal: Segmentation fault");
  says(answers + "echo six; cat > /dev/null", "tick 1 (0.012 s): its answer is no number of mA: \"six\"");
  says(answers + "echo; cat > /dev/null", "tick 1 (0.012 s): its answer is no number of mA: \"\"");
  says(answers + "echo 6,5; cat > /dev/null", "tick 1 (0.012 s): its answer is no number of mA: \"6,5\"");
  says(answers + "echo nan; cat > /dev/null", "tick 1 (0.012 s): its command is no finite number");
  says(answers + "cat > /dev/null", "tick 1 (0.012 s): no answer within 0.2 s");
  says(answers + "printf 6; cat > /dev/null", "tick 1 (0.012 s): its answer is no line: \"6\"");
  says(answers + "printf '6\\n7\\n'; cat > /dev/null",
       "tick 2 (0.024 s): it said more than one line: \"7 \"");
  says(answers + "echo 6; exec >&- 2>&-; sleep 60", "tick 2 (0.024 s): it closed its output");
  says("exit 2", "before the run: it ended with status 2");
  const std::string unknown = failure_of(shell("/nowhere/controller"));
  EXPECT_EQ(unknown.rfind("before the run: it ended with status 127; its last words: ", 0), 0U) << unknown;
}

TEST(External, ALongTargetAndMuchChatterOnStderrBlockNobody) {
  Knowledge paper = known();
  paper.target.assign(40000, 0.123456789);
  const auto controller =
      shell("sleep 0.1; read hello; dd if=/dev/zero bs=1000 count=200 >&2 2> /dev/null; echo 5; cat >&2")
          .make(paper);
  EXPECT_EQ(controller->rest().current_mA, 5.0);
}

TEST(External, LeavesNoProcessBehind) {
  const Scratch scratch;
  ExternalSettings settings = shell("sleep 1000 & echo $! > sleeper; echo 5; wait");
  settings.folder = (scratch / "").string();
  settings.make(known())->rest();
  const int sleeper = std::stoi(text_of(scratch / "sleeper"));
  for (int i = 0; i < 200 && kill(sleeper, 0) == 0; ++i) usleep(10000);
  std::string state = text_of("/proc/" + std::to_string(sleeper) + "/stat");
  EXPECT_TRUE(kill(sleeper, 0) != 0 || state.find(") Z ") != std::string::npos) << state;
}

PluginSettings library(const std::string& path) {
  PluginSettings settings;
  settings.library = path;
  return settings;
}

TEST(Plugin, IsTheSameAsInAProcessOfItsOwn) {
  ExternalSettings process = shell(MCKIBBEN_EXAMPLE_CONTROLLER);
  const auto apart = process.make(known()), within = library(MCKIBBEN_EXAMPLE_PLUGIN).make(known());
  EXPECT_EQ(apart->rest().current_mA, within->rest().current_mA);
  double moved_mA = 0.0;
  for (std::int64_t k = 0; k < 200; ++k) {
    const Reading reading{k, static_cast<double>(k) * 0.012, (k * k) % 300};
    const double current_mA = apart->step(reading).current_mA;
    EXPECT_EQ(current_mA, within->step(reading).current_mA) << k;
    moved_mA = std::max(moved_mA, current_mA);
  }
  EXPECT_GT(moved_mA, 5.0);
}

TEST(Plugin, WhateverIsWrongWithItIsAFailureWithItsReason) {
  PluginSettings settings = library(MCKIBBEN_EXAMPLE_PLUGIN);
  settings.settings = "nonsense";
  EXPECT_EQ(failure_of(settings),
            "before the run: its library refuses: \"settings are gain=MA Ti=S, not: nonsense\"");
  settings.settings = "gain=20 Ti=0.5";
  EXPECT_EQ(failure_of(settings), "");
  EXPECT_EQ(failure_of(library("/nowhere/plugin.so"))
                .rfind("before the run: its library cannot be used: /nowhere/plugin.so: ", 0),
            0U);
  EXPECT_EQ(failure_of(library(MCKIBBEN_LATER_PLUGIN)),
            "before the run: its library is for version 3 of the interface, not 2");
  Knowledge in_volts = known();
  in_volts.valve = {0.0, 10.0, 0.5e5, 5e5, "V"};
  EXPECT_EQ(
      failure_of(*library(MCKIBBEN_EARLIER_PLUGIN).make(in_volts)),
      "before the run: its library is for version 1 of the interface, whose commands are in mA; here they "
      "are in V");
  EXPECT_EQ(failure_of(library(MCKIBBEN_EARLIER_PLUGIN)), "tick 0 (0 s): its command is no finite number");
  EXPECT_EQ(failure_of(library(MCKIBBEN_POOR_PLUGIN)),
            "before the run: its library has no mckibben_controller_rest");
  EXPECT_EQ(failure_of(library(MCKIBBEN_SILENT_PLUGIN)), "tick 0 (0 s): its command is no finite number");
}

}  // namespace
}  // namespace mckibben::controllers
