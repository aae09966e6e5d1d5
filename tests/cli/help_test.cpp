// Help, and what is said of words that are none: for every verb, from the program's own list of verbs.
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/cli/app.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

std::vector<std::string> verbs() {
  CLI::App app("", "mckibben");
  Asked asked;
  build(app, asked);
  std::vector<std::string> names;
  for (const auto* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

/// The commands of a help text, without what is said of them: two blanks and more end one.
std::vector<std::string> commands(const std::string& help) {
  std::vector<std::string> found;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("  mckibben ", 0) == 0) {
      const std::string command = line.substr(11);
      found.push_back(command.substr(0, std::min(command.find("  "), command.find(" >"))));
    }
  return found;
}

/// Whether the command line is one that the program takes; nothing is run.
std::string refusal(const std::string& command) {
  CLI::App app("", "mckibben");
  Asked asked;
  build(app, asked);
  try {
    app.parse(command);
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return "";
}

TEST(Help, OfTheProgramTeaches) {
  const Scratch scratch;
  const Said said = mckibben("--help", scratch);
  EXPECT_EQ(said.status, 0);
  EXPECT_TRUE(holds(said.out, "simulates a pneumatic muscle"));
  EXPECT_GE(commands(said.out).size(), 3u);
  for (const std::string& command : commands(said.out)) EXPECT_EQ(refusal(command), "") << command;
  for (const std::string& verb : verbs()) EXPECT_TRUE(holds(said.out, "\n  " + verb + " ")) << verb;
  EXPECT_TRUE(lacks(said.out, "Subcommands")) << "a verb is in no group";
}

TEST(Help, ThePageOfTheCommandLineHasEveryVerbUnderItsGroup) {
  const std::string page = read_text(MCKIBBEN_SOURCE_DIR "/docs/command_line.md");
  CLI::App app("", "mckibben");
  Asked asked;
  build(app, asked);
  for (const auto* verb : app.get_subcommands({})) {
    const std::size_t group = page.find("\n## " + verb->get_group() + "\n");
    ASSERT_NE(group, std::string::npos) << verb->get_group();
    const std::string part = page.substr(group, page.find("\n## ", group + 1) - group);
    EXPECT_TRUE(std::regex_search(part, std::regex("\n\\| `" + verb->get_name() + "[ `]")))
        << verb->get_name();
  }
}

TEST(Help, OfEveryVerbHasExamplesThatItTakes) {
  const Scratch scratch;
  for (const std::string& verb : verbs()) {
    const Said said = mckibben(verb + " --help", scratch);
    EXPECT_EQ(said.status, 0) << verb;
    EXPECT_EQ(said.err, "") << verb;
    EXPECT_TRUE(holds(said.out, "Examples:\n")) << verb;
    EXPECT_GE(commands(said.out).size(), 2u) << said.out;
    for (const std::string& command : commands(said.out)) {
      EXPECT_EQ(command.rfind(verb, 0), 0u) << command;
      EXPECT_EQ(refusal(command), "") << command;
    }
  }
}

TEST(Help, ThatCannotBePrintedIs74) {
  const Scratch scratch;
  EXPECT_EQ(mckibben("run --help > /dev/full; exit $?; true", scratch).status, 74);
}

struct Slip {
  const char *arguments, *said;
};

TEST(DidYouMean, ForVerbsOptionsAndValues) {
  const Scratch scratch;
  for (const Slip& slip : {
           Slip{"replya x", "unknown verb replya; did you mean replay?"},
           {"", "a verb is missing; to begin: mckibben init my.yaml"},
           {"run x.yaml --treads 3", "unknown option --treads; did you mean --threads?"},
           {"run --oout=x", "unknown option --oout; did you mean --out?"},
           {"calibrate x --kfg", "unknown option --kfg; did you mean --kgf?"},
           {"map x --extrapolate-laod", "did you mean --extrapolate-load?"},
           {"help", "unknown verb help; did you mean --help?"},
           {"run x.yaml --threads 0", "0 is not a number from 1 to 1024"},
           {"diff a b --tolerance nan", "nan is not a number from 0 to 1"},
           {"--versoin", "unknown option --versoin; did you mean --version?"},
           {"--json run x.yaml",
            "unknown option --json (options: -h, --help, --version; those of a verb stand"},
           {"calibrate x --fit jiont", "unknown choice jiont; did you mean joint?"},
           {"schema senario", "unknown kind senario; did you mean scenario?"},
           {"schema rig --format yml", "unknown format yml; did you mean yaml?"},
           {"effects muscle_leek", "unknown effect muscle_leek; did you mean muscle_leak?"},
           {"effects lqr", "lqr is not an effect; here: `linearise --lqr`"},
           {"effects 'thread friction'", "not an effect; here: `friction`"},
           {"effects Schlauch", "not an effect; here: `hose`"},
           {"effects regulator", "not an effect; here: `kind: regulator`"},
       }) {
    const Said said = mckibben(slip.arguments, scratch);
    EXPECT_EQ(said.status, 64) << slip.arguments;
    EXPECT_EQ(said.out, "") << slip.arguments;
    EXPECT_TRUE(holds(said.err, slip.said));
  }
  EXPECT_TRUE(lacks(mckibben("run -x", scratch).err, "did you mean"));
  const Said far = mckibben("quench x", scratch);
  EXPECT_TRUE(lacks(far.err, "did you mean"));
  EXPECT_TRUE(holds(far.err, "verbs: init, run, dataset, "));
}

TEST(DidYouMean, ForTermsOfTheField) {
  const Scratch scratch;
  write_text(scratch / "rig.yaml",
             "schema: mckibben-rig/1\neffects:\n  leak: {}\n  hysteresis: {}\n  creep: {}\n  Coulomb: {}\n"
             "  stribeck: {}\n  dead-band: {}\n");
  EXPECT_TRUE(holds(mckibben("check rig.yaml", scratch).err, "did you mean muscle_leak?",
                    "did you mean bladder_hysteresis or valve_hysteresis or isometric_hysteresis?",
                    "did you mean bladder_creep?", "did you mean guide_friction?",
                    "did you mean speed_dependent_friction?", "did you mean valve_dead_band?"));
  write_text(scratch / "scenario.yaml",
             "schema: mckibben-scenario/1\nloads: [9 kg]\nduration: 1 s\ntarget: {kind: steps, moves: []}\n"
             "rig: {valve: {kind: proportional}}\n"
             "controllers:\n  - {kind: PID}\n  - {kind: lqr}\n  - {kind: pid, Kp: 3, ki: 1, kd: 1}\n");
  EXPECT_TRUE(holds(mckibben("check scenario.yaml", scratch).err, "did you mean pid?",
                    "did you mean external or plugin?", "did you mean servo or regulator?",
                    "did you mean proportional?", "did you mean integral_time?",
                    "did you mean derivative_time?"));
}

TEST(DidYouMean, ForEffectsInRigFiles) {
  const Scratch scratch;
  write_text(scratch / "rig.yaml",
             "schema: mckibben-rig/1\neffects:\n  muscle_leek: {conductance: 1e-10 m3/(s Pa)}\n"
             "  valve_lag: {tmie: 20 ms}\n  hardening_braid: {}\n");
  const Said said = mckibben("check rig.yaml", scratch);
  EXPECT_EQ(said.status, 65);
  EXPECT_TRUE(holds(said.err, "did you mean muscle_leak?", "did you mean time?"));
}

}  // namespace
}  // namespace mckibben::cli
