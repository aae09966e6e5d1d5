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

TEST(Upgrade, SaysWhichVersionIsRead) {
  const auto found = notes("schema: mckibben-scenario/7\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(
      found[0],
      "old.yaml:1:9: schema = mckibben-scenario/7: this version reads mckibben-scenario/1; write that, and "
      "check the file");
  EXPECT_TRUE(notes("schema: mckibben-scenario/1\nname: new\n").empty());
  EXPECT_TRUE(notes("schema: of-somebody-else/2\n").empty());
  EXPECT_TRUE(notes("name: none\n").empty());
}

}  // namespace
}  // namespace mckibben::input
