// The scenario that init writes is a good one, as it stands and with everything in it switched on.
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include <sim/domain/scenario.hpp>
#include <sim/input/field_list.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/rigs.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;

/// Only as long as all moves need to begin.
std::string shortened(const std::string& scenario) {
  return std::regex_replace(scenario, std::regex("\nduration: [^\n]*"), "\nduration: 3.1 s");
}

TEST(Init, WritesAScenarioThatRuns) {
  const Scratch scratch;
  const Said said = mckibben("init mine.yaml", scratch);
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.out, "mckibben run mine.yaml"));
  EXPECT_EQ(mckibben("check mine.yaml", scratch).out, "mine.yaml: ok\n");
  write_text(scratch / "short.yaml", shortened(read_text(scratch / "mine.yaml")));
  const Said run = mckibben("run short.yaml", scratch);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "results in out/short\n") << "no warnings";
}

TEST(Init, WritesNothingThatDoesNotWorkWhenSwitchedOn) {
  const Scratch scratch;
  ASSERT_EQ(mckibben("init", scratch).status, 0);
  const std::string plain = read_text(scratch / "scenario.yaml");
  const std::string all = std::regex_replace(plain, std::regex("\n( *)#([a-z])"), "\n$1$2");
  EXPECT_EQ(all.size() + 9, plain.size()) << "nine lines are off";
  write_text(scratch / "all.yaml", shortened(all));
  EXPECT_EQ(mckibben("check all.yaml", scratch).err, "");
  const Said run = mckibben("run all.yaml --json", scratch);
  EXPECT_EQ(run.status, 0) << run.err;
  const auto scenario = input::Json::parse(run.out).at("scenario");
  EXPECT_EQ(scenario.at("name"), "mine");
  EXPECT_TRUE(scenario.at("rig").at("effects").contains("muscle_leak"));
}

// Every key of a scenario is in it, with the words that the reference has for it.
TEST(Init, TellsOfEveryKey) {
  const Scratch scratch;
  ASSERT_EQ(mckibben("init", scratch).status, 0);
  const std::string text = read_text(scratch / "scenario.yaml");
  for (const auto& info : input::list_fields<domain::Scenario>())
    EXPECT_TRUE(holds(text, "# " + info.key + ": " + info.meaning)) << info.key;
}

TEST(Init, TellsOfEveryMuscleByCatalogue) {
  const Scratch scratch;
  ASSERT_EQ(mckibben("init", scratch).status, 0);
  const std::string text = read_text(scratch / "scenario.yaml");
  for (const auto name : input::shipped_rigs())
    EXPECT_TRUE(name == "thesis_pair" || text.find(name) != std::string::npos) << name;
}

TEST(Init, NeverOverwrites) {
  const Scratch scratch;
  write_text(scratch / "mine.yaml", "mine");
  fs::create_symlink("nowhere", scratch / "link.yaml");
  for (const char* name : {"mine.yaml", "link.yaml", ".", "mine.yaml/below.yaml", "''"}) {
    const Said said = mckibben(std::string("init ") + name, scratch);
    EXPECT_EQ(said.status, 74) << name;
    EXPECT_EQ(said.out, "") << name;
  }
  EXPECT_EQ(read_text(scratch / "mine.yaml"), "mine");
  EXPECT_FALSE(fs::exists(scratch / "nowhere"));
  EXPECT_EQ(input::Json::parse(mckibben("init far/down.yaml --json", scratch).out).at("file"),
            "far/down.yaml");
  EXPECT_TRUE(fs::exists(scratch / "far/down.yaml"));
}

}  // namespace
}  // namespace mckibben::cli
