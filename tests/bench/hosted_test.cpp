// Controllers that break, and the program itself that is killed or suspended: the device is vented, what was
// recorded until then is there, and the reason is said.
#include <csignal>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <controllers/external.hpp>
#include <controllers/plugin.hpp>
#include <sim/bench/loop.hpp>
#include <sim/bench/serial.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/simulate.hpp>

#include "board.hpp"

namespace mckibben::bench {
namespace {

constexpr std::size_t all_ticks = 40, until = 10;  // at which most of them break

/// Keeps what was put out.
class Kept final : public Device {
 public:
  std::int64_t counts(double) override { return 3; }
  void put(double current_mA, double) override { put_mA.push_back(current_mA); }
  std::vector<double> put_mA;
};

LoopPlan plan() {
  LoopPlan all;
  all.rig.tick_s = 0.03;
  all.rig.settling_time_s = 5 * all.rig.tick_s;
  all.ticks = all_ticks;
  all.limits = {4.0, 20.0};
  return all;
}

struct Breaking {
  const char* kind;
  std::string does;  ///< a script of the shell, or settings of the library
  const char* says;  ///< empty: it goes on to the end
  std::size_t rows = until;
};

std::ostream& operator<<(std::ostream& out, const Breaking& one) {
  return out << one.kind;
}

void breaks(const Breaking& one, const auto& settings, Clock&& clock, LoopPlan all) {
  Kept device;
  const auto known = run::knowledge_of(all.rig, std::vector<double>(all_ticks, 0.1));
  const Recorded recorded = drive(device, settings.make(known), all, clock);
  EXPECT_EQ(run::take_interrupt(), std::string(one.says) == "stopped by the user");
  EXPECT_NE(recorded.stopped.find(one.says), std::string::npos) << recorded.stopped;
  EXPECT_EQ(recorded.stopped.empty(), *one.says == '\0') << recorded.stopped;
  EXPECT_EQ(recorded.rows.size(), one.rows);
  ASSERT_FALSE(device.put_mA.empty());
  EXPECT_EQ(device.put_mA.back(), 0.0);
}

const std::string answers =  // ten ticks
    "read h; echo 6; i=0; while [ $i -lt 10 ]; do read l; echo 7; i=$((i+1)); done; read l; ";
constexpr const char* no_answer = "no answer within 1 s";

const Breaking externals[] = {
    {"goes_on", "read h; echo 6; while read l; do echo 7; done", "", all_ticks},
    {"takes_long_to_begin", "sleep 0.5; read h; echo 6; while read l; do echo 7; done", "", all_ticks},
    {"hangs", answers + "sleep 60", no_answer},
    {"ends", answers + "exit 3", "it ended with status 3"},
    {"ends_well", answers + "exit 0", "it ended with status 0"},
    {"says_nan", answers + "echo NaN; cat >/dev/null", "its command is no finite number"},
    {"says_infinity", answers + "echo inf; cat >/dev/null", "its command is no finite number"},
    {"says_too_much", answers + "yes 7 | head -n 200000; cat >/dev/null", "it said more than one line",
     until + 1},
    {"ends_no_line", answers + "yes 7 | head -n 2000000 | tr -d '\\n'; sleep 60", "its answer is no line"},
    {"complains", answers + "yes no | head -n 200000 >&2; echo 7; while read l; do echo 7; done", "",
     all_ticks},
    {"last_words_no_text", answers + "printf '\\377\\376 bad' >&2; exit 2", "last words: \"?? bad\""},
    {"says_no_text", answers + "printf '\\377\\376\\n'; cat >/dev/null",
     "its answer is no number of mA: \"??\""},
    {"leaves_one_behind", answers + "sleep 60 & exit 1", no_answer},
    {"ends_us", answers + "kill -TERM $(sed -n 's/^PPid:[^0-9]*//p' /proc/$PPID/status); sleep 60",
     "stopped by the user"},
    {"crashes", answers + "kill -SEGV $$", "it was ended by a signal: Segmentation fault"},
    {"closes_its_output", answers + "exec >&- 2>&-; sleep 60", "it closed its output"},
    {"is_not_there", "/nowhere/controller", "before the run: it ended with status 127", 0},
    {"never_begins", "sleep 60", "before the run: no answer within 4 s", 0},
};

class Externals : public testing::TestWithParam<Breaking> {};

TEST_P(Externals, AreVentedAndRecorded) {
  controllers::ExternalSettings settings;
  settings.command = GetParam().does;
  settings.time_limit_s = 1.0;
  settings.start_limit_s = 4.0;
  breaks(GetParam(), settings, PatientClock(), plan());
}

INSTANTIATE_TEST_SUITE_P(All, Externals, testing::ValuesIn(externals),
                         [](const auto& one) { return std::string(one.param.kind); });

constexpr const char *ended = "the controller's process ended with status ",
                     *by_signal = "the controller's process was ended by a signal: ",
                     *no_finite = "its command is no finite number";

const Breaking plugins[] = {
    {"goes_on", "goes_on", "", all_ticks},
    {"prints", "prints", "", all_ticks},
    {"nan", "nan", no_finite},
    {"infinite", "infinite", no_finite},
    {"rests_at_nan", "rests_at_nan", no_finite, 0},
    {"no_text", "no_text", "its library refuses: \"????"},
    {"half_a_letter", "half_a_letter", "its library refuses: \"\xc3\xa4"},
    {"refuses", "refuses", "before the run: its library refuses: \"????", 0},
    {"exits", "exits", ended},
    {"exits_at_once", "exits_at_once", ended},
    {"crashes", "crashes", "the controller's process "},  // AddressSanitizer makes a status of it
    {"aborts", "aborts", "the controller's process "},
    {"is_killed", "is_killed", by_signal},
    {"closes_all", "closes_all", "the controller's process "},
    {"ends_us", "ends_us", "stopped by the user"},
    {"crashes_at_the_end", "crashes_at_the_end", "once its run was over", all_ticks},
};

controllers::PluginSettings wild(const std::string& does) {
  controllers::PluginSettings settings;
  settings.library = MCKIBBEN_WILD_PLUGIN;
  settings.settings = does;
  return settings;
}

class Plugins : public testing::TestWithParam<Breaking> {};

TEST_P(Plugins, AreVentedAndRecorded) {
  breaks(GetParam(), wild(GetParam().does), PatientClock(), plan());
}

INSTANTIATE_TEST_SUITE_P(All, Plugins, testing::ValuesIn(plugins),
                         [](const auto& one) { return std::string(one.param.kind); });

TEST(Plugins, ThatDoNotComeBackAreStoppedByTheWatchdog) {
  LoopPlan all = plan();
  all.most_missed_ticks = 30;  // a busy machine misses some
  for (const char* does : {"hangs", "suspends"})
    breaks({does, does, "watchdog: the controller does not answer at tick 10"}, wild(does), RealClock(), all);
  all.start_limit_s = 0.3;
  breaks({"", "", "the controller has not begun within 0.3 s", 0}, wild("never_begins"), RealClock(), all);
}

/// Sends this process a signal at its tenth reading.
class Sends final : public Device {
 public:
  Sends(Device& inside, int signal) : inside_(inside), signal_(signal) {}
  std::int64_t counts(double now_s) override {
    if (++asked_ == 10) raise(signal_);
    return inside_.counts(now_s);
  }
  void put(double current_mA, double now_s) override { inside_.put(current_mA, now_s); }

 private:
  Device& inside_;
  int signal_, asked_ = 0;
};

class Killed : public testing::TestWithParam<int> {};

TEST_P(Killed, TheControllersProcessVents) {
  Board board([](int, long) { return "3\n"; });
  const pid_t loop = fork();
  if (loop == 0) {
    LoopPlan all = plan();
    all.longest_silence_s = 0.5;
    controllers::ExternalSettings settings;
    settings.command = "read h; echo 6; while read l; do echo 7; done";
    Serial serial(board.port, all.rig);
    Sends device(serial, GetParam());
    PatientClock clock;
    drive(device, settings.make(run::knowledge_of(all.rig, {})), all, clock);
    _exit(0);
  }
  EXPECT_TRUE(board.vented());
  EXPECT_GT(board.heard().size(), 10U);
  kill(loop, SIGKILL);
  int status = 0;
  waitpid(loop, &status, 0);
  EXPECT_TRUE(!WIFEXITED(status) || WEXITSTATUS(status) != 0);
}

INSTANTIATE_TEST_SUITE_P(By, Killed, testing::Values(SIGKILL, SIGSEGV, SIGABRT, SIGBUS, SIGSTOP, SIGPROF),
                         [](const auto& one) { return std::string(sigabbrev_np(one.param)); });

}  // namespace
}  // namespace mckibben::bench
