// The verb study from end to end: its files, its JSON, and what it refuses.
#include <string>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

TEST(Study, WritesPagePictureTableAndDocument) {
  const Scratch scratch;
  write_text(scratch / "small.yaml", campaign_of_sines());
  for (const std::string name : {"lag", "counting", "figures"}) {
    const Said said = mckibben("study " + name + " small.yaml", scratch);
    ASSERT_EQ(said.status, 0) << said.err;
    const std::filesystem::path folder = scratch / "out" / ("study-" + name + "-small");
    EXPECT_EQ(said.out, read_text(folder / (name + ".md")));
    EXPECT_NE(said.out.find("from the campaign `small`, 12 runs"), std::string::npos);
    EXPECT_EQ(said.out.find("a test makes the page again"), std::string::npos)
        << "only those in docs/studies";
    EXPECT_EQ(read_text(folder / (name + ".svg")).rfind("<svg", 0), 0u);
    EXPECT_NE(read_text(folder / (name + ".csv")).find(','), std::string::npos);
    const auto document = input::Json::parse(read_text(folder / (name + ".json")));
    EXPECT_EQ(document.at("schema"), "mckibben-study/1");
    EXPECT_EQ(document.at("study"), name);
  }
  const Said json = mckibben("study lag small.yaml --json --threads 1", scratch);
  EXPECT_EQ(json.out, read_text(scratch / "out/study-lag-small/lag.json"));
}

TEST(Study, RefusesWhatItCannotJudge) {
  const Scratch scratch;
  EXPECT_EQ(mckibben("study friction small.yaml", scratch).status, 64);
  EXPECT_EQ(mckibben("study lag missing.yaml", scratch).status, 66);
  write_text(scratch / "small.yaml", campaign_of_sines("[11.138 kg, 23.406 kg]"));
  const Said few = mckibben("study lag small.yaml", scratch);
  EXPECT_EQ(few.status, 65);
  EXPECT_NE(few.err.find("small.yaml:1:1: error: "), std::string::npos) << few.err;
  EXPECT_NE(few.err.find("needs 4 loads"), std::string::npos) << few.err;
  EXPECT_EQ(few.err.find("--load-order"), std::string::npos) << few.err;
  EXPECT_TRUE(std::filesystem::is_empty(scratch / "out"));  // no result, whole or in part
}

}  // namespace
}  // namespace mckibben::cli
