// The verb import from end to end: what it leaves open is refused until it is filled in, and then it replays;
// nothing that was edited is lost.
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"
#include "words_fit.hpp"

namespace mckibben::cli {
namespace {

constexpr const char* another_rig =
    "schema: mckibben-rig/1\nmuscle: {rest_length: 180 mm, rest_radius: 6 mm, braid_angle: 23 deg}\n"
    "valve: {zero_pressure: 0 bar, span_pressure: 6 bar, supply_pressure: 7 bar}\n"
    "encoder: {pulses_per_turn: 100000, wheel_ratio: 2}\n";

/// A laser's table of that rig, as Excel has it: bench/load_5kg.csv.
constexpr const char* record =
    "$M dataset campaign.yaml --out d > log 2>&1 && mkdir bench && awk -F, 'NR == 1 {print "
    "\"sep=;\\nZeit;Soll;Laser;\\n"
    "ms;V;mm;\"} NR > 1 {s = sprintf(\"%.1f;%.4f;%.4f;\", $1 * 1000, ($2 - 4) / 1.6, 412.5 - $3 * 180); "
    "gsub(/\\./, \",\", s); print s}' d/m1_s.csv > bench/load_5kg.csv";

/// Writes values in place of FILL_IN.
void write_filled(const std::filesystem::path& file,
                  const std::vector<std::pair<std::string, std::string>>& values) {
  std::string text = read_text(file);
  for (const auto& [key, value] : values)
    text = std::regex_replace(text, std::regex(key + ": FILL_IN"), key + ": " + value);
  write_text(file, text);
}

class Import : public ::testing::Test {
 protected:
  Import() {
    write_text(scratch_ / "rig.yaml", another_rig);
    write_text(
        scratch_ / "campaign.yaml",
        "schema: mckibben-campaign/1\nrig: rig.yaml\nloads: [5 kg]\ncurrents: [{name: s, duration: 2.4 s, "
        "current: {kind: sine_current, low: 4 mA, high: 14 mA, period: 2.4 s}}]\n");
    EXPECT_EQ(shell(record, scratch_).status, 0);
  }
  Scratch scratch_;
};

TEST_F(Import, ThePictureNamesEveryRun) {
  ASSERT_EQ(
      shell(
          "for n in 1 2 3 4 5 6 7 8 9; do cp bench/load_5kg.csv bench/measured_with_load_5kg_run$n.csv; done",
          scratch_)
          .status,
      0);
  const Said said = mckibben("import bench/measured*.csv --out mine", scratch_);
  ASSERT_EQ(said.status, 0) << said.err;
  const std::string svg = read_text(scratch_ / "mine/understood.svg");
  EXPECT_TRUE(words_fit(svg));
  EXPECT_TRUE(holds(svg, "run9"));
}

TEST_F(Import, ThePictureSaysAUnitOnce) {
  write_text(
      scratch_ / "t.csv",
      "t [ms],U [V],p [bar],Laser [mm]\n0,0,0,412\n12,1,0.5,411\n24,2,1,405\n36,3,1.5,400\n48,2,1,404\n"
      "60,1,0.5,409\n");
  ASSERT_EQ(mckibben("import t.csv --out mine", scratch_).status, 0);
  const std::string svg = read_text(scratch_ / "mine/understood.svg");
  EXPECT_TRUE(holds(svg, "over t [ms]<", "command: U [V]<", "(Laser [mm] - 412"));
}

TEST_F(Import, WhatIsOpenIsRefusedAndThenReplays) {
  const Said said = mckibben("import bench/load_5kg.csv --out mine", scratch_);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.out, "8 values are to be filled in (FILL_IN) in mine; then: mckibben check mine"));
  EXPECT_TRUE(holds(read_text(scratch_ / "mine/understood.svg"), "contraction: (Laser [mm] - FILL_IN) x -1"));
  const Said refused = mckibben("check mine", scratch_);
  EXPECT_EQ(refused.status, 65);
  EXPECT_TRUE(holds(refused.err, "rest_length = FILL_IN: the recorded data do not contain it"));

  write_filled(scratch_ / "mine/rig.yaml", {{"rest_length", "180 mm"},
                                            {"rest_radius", "6 mm"},
                                            {"braid_angle", "23 deg"},
                                            {"kind", "servo"},
                                            {"zero_pressure", "0 bar"},
                                            {"span_pressure", "6 bar"},
                                            {"supply_pressure", "7 bar"}});
  const std::string rig = read_text(scratch_ / "mine/rig.yaml");
  const std::string dataset = read_text(scratch_ / "mine/dataset.yaml");
  const std::regex named(R"(; ([0-9.]+) is its median where [^\n]*\n.*zero: FILL_IN)");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(dataset, found, named)) << dataset;
  write_filled(scratch_ / "mine/dataset.yaml", {{"zero", found.str(1)}});
  EXPECT_EQ(mckibben("check mine", scratch_).err, "next: mckibben replay mine\n");
  const Said replayed = mckibben("replay mine --json", scratch_);
  ASSERT_EQ(replayed.status, 0) << replayed.err;
  const auto gap = input::Json::parse(replayed.out).at("runs").at(0).at("gaps").at(0);
  EXPECT_LT(gap.at("rmse").get<double>(), 1e-3) << gap.dump() << " but for the zero, which a load stretches";

  const Said again = mckibben("import bench/load_5kg.csv --out mine", scratch_);
  EXPECT_EQ(again.status, 0);
  EXPECT_TRUE(holds(again.err, "mine.old-1")) << "it was edited: " << again.err;
  EXPECT_EQ(read_text(scratch_ / "mine.old-1/rig.yaml"), rig);
}

TEST_F(Import, AFolderIsItsTables) {
  ASSERT_EQ(
      shell("cp bench/load_5kg.csv bench/load_5kg_2.csv && echo notes > bench/README && mkdir none", scratch_)
          .status,
      0);
  const Said said = mckibben("import bench --out mine", scratch_);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.out, "2 tables read", "load_5kg_2"));
  const Said none = mckibben("import none", scratch_);
  EXPECT_EQ(none.status, 66);
  EXPECT_TRUE(holds(none.err, "no table is in this folder"));
}

TEST_F(Import, ARunOfNoTimeIsRefusedByEveryVerb) {
  write_text(scratch_ / "fast.csv",
             "t,p,x\n0,1,0\n10,1.1,1\n20,1.2,2\n30,1.3,3\n40,1.4,4\n50,1.5,5\n60,1.6,6\n");
  write_text(scratch_ / "dataset.yaml",
             "schema: mckibben-dataset/1\nrig: rig.yaml\ncolumns: {time: {column: t, unit: us}, "
             "muscle_pressure: {column: p, "
             "unit: bar, as: input}, contraction: {column: x, unit: mm}}\nruns: [{id: r, file: fast.csv, "
             "load: 5 kg}]\n");
  for (const char* verb : {"check", "replay", "diagnose"}) {
    const Said said = mckibben(std::string(verb) + " dataset.yaml", scratch_);
    EXPECT_EQ(said.status, 65) << verb << said.err;
    EXPECT_TRUE(holds(said.err, "lasts 0.06 ms", "unit: ms")) << verb;
  }
}

/// Values FILL_IN in what import wrote, without comments.
std::size_t left_in(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for (const char* name : {"dataset.yaml", "rig.yaml"}) {
    if (!std::filesystem::exists(folder / name)) continue;
    const std::string text = std::regex_replace(read_text(folder / name), std::regex("#[^\n]*"), "");
    const std::regex value("FILL_IN");
    count += static_cast<std::size_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), value), std::sregex_iterator()));
  }
  return count;
}

TEST_F(Import, RunsTakeOverNothingThatTheirTableLacks) {
  ASSERT_EQ(
      shell("mkdir mixed && awk -F, 'NR == 1 {print \"Zeit [s],Soll [mA],Laser [V],Kraft [N]\"} NR > 1 "
            "{print $1 \",\" $2 \",\" $3 \",49\"}' d/m1_s.csv > mixed/a_5kg.csv && "
            "cp mixed/a_5kg.csv mixed/b_6kg.csv && "
            "(printf 'LabVIEW Measurement\\t\\nSeparator\\tTab\\nX_Columns\\tOne\\n***End_of_Header***\\t\\n'"
            "'Channels\\t2\\t\\t\\nX0\\t0\\t0\\t\\nDelta_X\\t0.012\\t0.012\\t\\n***End_of_Header***\\t\\t\\t"
            "\\nX_Value\\tp [bar]\\twire [V]\\tComment\\n'; awk -F, 'NR > 1 {print $1 \"\\t\" $2 / 4 \"\\t\" "
            "$3}' d/m1_s.csv) > mixed/c_7kg.lvm && cp mixed/c_7kg.lvm mixed/d_8kg.lvm",
            scratch_)
          .status,
      0);
  const Said said = mckibben("import mixed --rig rig.yaml --out mine --json", scratch_);
  ASSERT_EQ(said.status, 0) << said.err;
  const std::string dataset = read_text(scratch_ / "mine/dataset.yaml");
  const std::size_t runs = dataset.find("runs:");
  EXPECT_TRUE(lacks(dataset.substr(0, runs), "Zeit", "Soll", "Kraft")) << "the .lvm has none of them";
  EXPECT_TRUE(holds(dataset.substr(0, runs), "Laser"));
  EXPECT_EQ(input::Json::parse(said.out).at("open"), left_in(scratch_ / "mine")) << dataset;
  EXPECT_EQ(left_in(scratch_ / "mine"), 5U) << "the laser's unit; each wire's, and zero of its p";
  write_filled(scratch_ / "mine/dataset.yaml", {{"unit", "1"}, {"zero", "0"}});
  EXPECT_TRUE(lacks(mckibben("check mine", scratch_).err, "is missing", "say as: ignored"));
}

TEST_F(Import, WhatADiagnosisRefusesIsNotNext) {
  ASSERT_EQ(shell("awk -F, 'NR == 1 {print \"t,U,F\"} NR > 1 {print $1 \",\" $2 \",49\"}' d/m1_s.csv > f.csv",
                  scratch_)
                .status,
            0);
  write_text(
      scratch_ / "dataset.yaml",
      "schema: mckibben-dataset/1\nrig: rig.yaml\nstart: settled\ncolumns: {time: {column: t, unit: s}, "
      "command: {column: U, unit: mA}, force: {column: F, unit: N}}\n"
      "runs: [{id: r, file: f.csv, load: 5 kg}]\n");
  EXPECT_TRUE(holds(mckibben("check dataset.yaml", scratch_).out, "contraction is not read"));
  const Said said = mckibben("replay dataset.yaml", scratch_);
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(lacks(said.err, "next: ")) << "diagnose refuses it";
}

TEST_F(Import, TakesARigThatIsKnownAndLeavesTablesAlone) {
  const Said said = mckibben("import bench/load_5kg.csv --rig rig.yaml --out sub/mine --json", scratch_);
  ASSERT_EQ(said.status, 0) << said.err;
  const auto document = input::Json::parse(said.out);
  EXPECT_EQ(document.at("schema"), "mckibben-import/1");
  EXPECT_EQ(document.at("open"), 5) << "the zero, and a valve in V";
  write_filled(scratch_ / "sub/mine/dataset.yaml", {{"zero", "412.5"}});
  write_filled(scratch_ / "sub/mine/rig.yaml", {{"kind", "servo"},
                                                {"zero_pressure", "0 bar"},
                                                {"span_pressure", "6 bar"},
                                                {"supply_pressure", "7 bar"}});
  EXPECT_EQ(mckibben("check sub/mine", scratch_).err, "next: mckibben replay sub/mine\n");
  const auto replayed = input::Json::parse(mckibben("replay sub/mine --json", scratch_).out);
  EXPECT_LT(replayed.at("runs").at(0).at("gaps").at(0).at("rmse").get<double>(), 1e-3);

  write_text(scratch_ / "my: rig #1.yaml", another_rig);
  EXPECT_EQ(mckibben("import bench/load_5kg.csv --rig 'my: rig #1.yaml' --out other", scratch_).status, 0);
  EXPECT_TRUE(holds(read_text(scratch_ / "other/rig.yaml"), R"(base: "../my: rig #1.yaml")"));

  EXPECT_EQ(mckibben("import bench/load_5kg.csv --out bench", scratch_).status, 74) << "tables are there";
  EXPECT_EQ(mckibben("import bench/none.csv", scratch_).status, 66);
  EXPECT_EQ(mckibben("import rig.yaml", scratch_).status, 65);
}

}  // namespace
}  // namespace mckibben::cli
