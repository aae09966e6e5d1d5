// The verb doctor: finds the known cases here, and can tell when they are not found.
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <sim/cli/known_cases.hpp>
#include <sim/engine/versions.hpp>
#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

using input::Json;

TEST(Doctor, FindsTheKnownCasesWithBothMethods) {
  const Scratch scratch;
  const Said said = mckibben("doctor --json", scratch);
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(said.err, "");
  const Json document = Json::parse(said.out);
  EXPECT_EQ(document.at("ok"), true);
  ASSERT_EQ(document.at("cases").size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(document.at("cases")[i].at("method"), i % 2 == 0 ? "erk" : "cvode");
    EXPECT_LT(document.at("cases")[i].at("error").get<double>(), document.at("cases")[i].at("allowed"));
  }
  const Json& library = document.at("sundials");
  EXPECT_EQ(library.at("version"), engine::sundials_version());
  EXPECT_EQ(library.at("precision"), "double");
  EXPECT_GT(library.at("vector_sum_slowness").get<double>(), 0.0);
  EXPECT_FALSE(std::filesystem::exists(scratch / "out")) << "it leaves nothing behind";
}

TEST(Doctor, SaysWhatItFound) {
  const Scratch scratch;
  const Said said = mckibben("doctor", scratch);
  EXPECT_EQ(said.status, 0);
  for (const char* words : {"mckibben " MCKIBBEN_VERSION, "optimisation", "All is well."})
    EXPECT_NE(said.out.find(words), std::string::npos) << said.out;
  EXPECT_EQ(said.out.find("BAD"), std::string::npos) << said.out;
}

// Integrated carelessly, the cases are not found: a check that cannot fail checks nothing.
TEST(Doctor, SaysWhenACaseIsNotFound) {
  const Scratch scratch;
  const Said said = mckibben("doctor --tolerance 1e-3", scratch);
  EXPECT_EQ(said.status, 70);
  EXPECT_NE(said.out.find("  BAD   steps of current"), std::string::npos) << said.out;
  EXPECT_NE(said.out.find("cannot be trusted"), std::string::npos);
  EXPECT_EQ(mckibben("doctor --tolerance 1", scratch).status, 64);
}

TEST(Doctor, SaysWhereNothingCanBeWritten) {
  const Scratch scratch;
  write_text(scratch / "out", "a file");
  const Said said = mckibben("doctor --json", scratch);
  EXPECT_EQ(said.status, 74);
  EXPECT_EQ(Json::parse(said.out).at("out").at("writable"), false);
}

TEST(Doctor, HoldsTheStoredTrajectoryThatTheEngineIsTestedAgainst) {
  std::ifstream file(MCKIBBEN_TEST_DATA "/reference/m16.138_steps-7-0.6-16.csv");
  std::string line;
  std::getline(file, line);
  for (std::size_t row = 0; std::getline(file, line) && row / stored_ticks < std::size(stored_rows); ++row) {
    if (row % stored_ticks != 0) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    double time_s = 0, current_mA = 0, e = 0, speed = 0, valve_bar = 0, muscle_bar = 0;
    cells >> time_s >> current_mA >> e >> speed >> valve_bar >> muscle_bar;
    const StoredRow& stored = stored_rows[row / stored_ticks];
    EXPECT_NEAR(stored.current_mA, current_mA, 1e-8);
    EXPECT_EQ(stored.contraction_ratio, e);
    EXPECT_EQ(stored.muscle_pressure_bar, muscle_bar);
  }
}

}  // namespace
}  // namespace mckibben::cli
