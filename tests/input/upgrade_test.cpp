// What `check --upgrade` finds: keys that are gone, versions that are others; nothing in what is shipped.
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/scenario_file.hpp>
#include <sim/input/upgrade.hpp>

namespace mckibben::input {
namespace {

constexpr std::string_view read_here[] = {scenario_schema};

std::vector<std::string> notes(const std::string& text) {
  std::vector<std::string> all;
  for (const Problem& one : to_upgrade(parse_yaml(Source("old.yaml", text, ".")), read_here))
    all.push_back(where(one) + ": " + one.message);
  return all;
}

TEST(Upgrade, SaysWhichKeysAreGoneAndWhere) {
  const auto found = notes(
      "schema: mckibben-scenario/1\n"
      "controllers:\n"
      "  - {kind: open_loop, calibration: c.yaml, weighing: {speed: 8 mA/s}}\n"
      "  - {kind: feedforward_pid, calibration: c.yaml, weighing: {speed: 8 mA/s}}\n"
      "  - kind: feedforward_pid\n"
      "    extrapolate_target: true\n");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].starts_with("old.yaml:4:50: weighing: remove it")) << found[0];
  EXPECT_TRUE(found[1].starts_with("old.yaml:6:5: extrapolate_target: remove it")) << found[1];
}

TEST(Upgrade, SaysWhatCommandsAreCalledToday) {
  const auto found = notes(
      "schema: mckibben-scenario/1\n"
      "rig: {valve: {zero_current: 0 mA}, dac: {largest_current: 10 mA}}\n"
      "controllers: [{kind: pid, lowest_current: 1 mA, highest_command: 9 mA}]\n");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0], "old.yaml:2:15: zero_current: write zero_command");
  EXPECT_EQ(found[2], "old.yaml:3:27: lowest_current: write lowest_command");
}

TEST(Upgrade, ShowsTheListInPlaceOfEachSensorsOwnKey) {
  const auto found = notes(
      "schema: mckibben-scenario/1\n"
      "rig:\n"
      "  base: thesis\n"
      "  encoder: {wheel_ratio: 3}\n"
      "  gauge: {fitted: true, resolution: 1 mbar ± 0.1 mbar}\n"
      "noise: {gauge: 4 mbar}\n"
      "model:\n"
      "  encoder: {wheel_ratio: 3}\n"
      "  sensor: {kind: laser, resolution: 10 um}\n"
      "  load_cell: {fitted: false, noise: 1 N}\n");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(
      found[0],
      "old.yaml:4:3: encoder: sensors are one list; write sensors: [{signal: contraction, kind: encoder, "
      "wheel_ratio: 3}, {signal: muscle_pressure, kind: gauge, resolution: 1 mbar ± 0.1 mbar}]");
  EXPECT_EQ(found[1],
            "old.yaml:8:3: encoder: sensors are one list; write sensors: [{signal: contraction, kind: laser, "
            "resolution: 10 um}, {signal: force, kind: none}]");
  EXPECT_TRUE(notes("schema: mckibben-scenario/1\nrig: {sensors: [{signal: force, kind: none}]}\n").empty());
}

TEST(Upgrade, SaysWhichVersionIsRead) {
  const auto note = [](const std::string& text) {
    const auto found = notes(text);
    return found.size() == 1 ? found[0] : "there are " + std::to_string(found.size());
  };
  const std::string reads = ": this version reads mckibben-scenario/1; ";
  EXPECT_EQ(note("schema: mckibben-scenario/0\n"),
            "old.yaml:1:9: schema = mckibben-scenario/0" + reads + "write that, and check the file");
  EXPECT_EQ(note("schema: mckibben-scenario/7\n"), "old.yaml:1:9: schema = mckibben-scenario/7" + reads +
                                                       "take the later one that the file was written for");
  EXPECT_EQ(note("schema: mckibben-scenario\n"),
            "old.yaml:1:9: schema = mckibben-scenario" + reads + "write that, and check the file");
  EXPECT_TRUE(notes("schema: mckibben-scenario/1\nname: new\n").empty());
  EXPECT_EQ(note("schema: of-somebody-else/2\n"),
            "old.yaml:1:9: schema = of-somebody-else/2 is none of this program's: mckibben-scenario/1");
  EXPECT_EQ(note("name: none\n"),
            "old.yaml:1:1: the file does not say what it is: schema: one of mckibben-scenario/1");
}

}  // namespace
}  // namespace mckibben::input
