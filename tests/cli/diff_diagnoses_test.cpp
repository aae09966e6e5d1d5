// The verb diff of two folders that diagnose wrote.
#include <cmath>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;
using input::Json;

Json told(const char* value_key, double value, double error, const char* unit) {
  return {{value_key, value}, {"unit", unit}, {"ci95", {value - 1.96 * error, value + 1.96 * error}}};
}

/// A diagnosis with a leak, if it has any, and a radius.
Json diagnosis(double leak, double radius_m) {
  Json effects = Json::array();
  if (leak > 0.0)
    effects.push_back({{"name", "muscle_leak"},
                       {"parameters", {{"conductance", told("value", leak, 1e-12, "m3/(s.Pa)")}}}});
  Json radius = told("fitted", radius_m, 1e-5, "m");
  radius["path"] = "muscle.rest_radius";
  return {{"schema", "mckibben-diagnosis/1"},
          {"verdict", leak > 0.0 ? "missing_effect" : "nothing_missing"},
          {"effects", effects},
          {"recalibrated", {{"rest_radius", radius}}},
          {"gap",
           {{"unit", "1"},
            {"nominal_rmse", 2e-3},
            {"recalibrated_rmse", 1e-3},
            {"corrected_rmse", 1.3e-4},
            {"noise_floor", 1.3e-4}}}};
}

class DiffOfDiagnoses : public testing::Test {
 protected:
  void put(const std::string& folder, const Json& document) {
    fs::create_directory(scratch / folder);
    write_text(scratch / folder / "diagnosis.json", document.dump());
  }
  Said diff(const std::string& arguments) { return mckibben("diff " + arguments, scratch); }
  Json number(const std::string& arguments, std::size_t index) {
    return Json::parse(diff(arguments + " --json").out).at("numbers").at(index);
  }
  Scratch scratch;
};

TEST_F(DiffOfDiagnoses, TellsWhatHasGrownInStandardErrorsOfBoth) {
  put("may", diagnosis(1.2e-10, 7.5e-3));
  put("june", diagnosis(1.3e-10, 7.52e-3));
  const Json leak = number("may june", 0), radius = number("may june", 1);
  EXPECT_EQ(leak.at("name"), "muscle_leak.conductance");
  EXPECT_NEAR(leak.at("deviations").get<double>(), 1e-11 / std::hypot(1e-12, 1e-12), 1e-6);
  EXPECT_EQ(leak.at("changed"), true);
  EXPECT_EQ(radius.at("name"), "muscle.rest_radius");
  EXPECT_NEAR(radius.at("deviations").get<double>(), std::sqrt(2.0), 1e-6);
  EXPECT_EQ(radius.at("changed"), false);
  const std::string text = diff("may june").out;
  for (const char* words : {"missing_effect, both", "changed", "+7.1", "The rig has changed"})
    EXPECT_NE(text.find(words), std::string::npos) << text;
}

TEST_F(DiffOfDiagnoses, TellsWhatIsNewAndWhatIsGone) {
  put("tight", diagnosis(0.0, 7.5e-3));
  put("leaking", diagnosis(1.2e-10, 7.5e-3));
  EXPECT_EQ(number("tight leaking", 0).at("left"), nullptr);
  EXPECT_EQ(number("tight leaking", 0).at("changed"), true);
  EXPECT_NE(diff("tight leaking").out.find("nothing_missing, then missing_effect"), std::string::npos);
  EXPECT_NE(diff("tight leaking").out.find(" new"), std::string::npos);
  EXPECT_NE(diff("leaking tight").out.find(" gone"), std::string::npos);
}

/// The same with a law of two terms.
Json with_law(double straight_N, double wave_N, double wavelength_m, const char* wave) {
  Json document = diagnosis(0.0, 7.5e-3);
  Json straight = told("coefficient", straight_N, 0.1, "N"), second = told("coefficient", wave_N, 0.1, "N");
  straight["term"] = "F e^3";
  second["term"] = wave;
  second["wavelength"] = told("value", wavelength_m, 1e-5, "m");
  second["phase"] = told("value", 0.5, 0.01, "rad");
  document["verdict"] = "unknown_effect";
  document["residual_law"] = {{"terms", {straight, second}}, {"valid_for", "these runs"}};
  return document;
}

TEST_F(DiffOfDiagnoses, TellsHowALawWithoutANameHasChanged) {
  put("may", with_law(-8.0, 6.0, 9.06e-3, "sin(2 pi x / 9.060 mm)"));
  put("june", with_law(-8.0, 7.0, 9.07e-3, "sin(2 pi x / 9.070 mm)"));
  for (const auto& [index, name, changed] : {std::tuple{0u, "residual_law.F e^3", false},
                                             {1u, "residual_law.wave 2", true},
                                             {2u, "residual_law.wave 2.wavelength", false},
                                             {3u, "residual_law.wave 2.phase", false}}) {
    const Json one = number("may june", index);
    EXPECT_EQ(one.at("name"), name);
    EXPECT_EQ(one.at("changed"), changed) << name;
  }
  put("none", diagnosis(0.0, 7.5e-3));
  EXPECT_NE(diff("none may").out.find(" new"), std::string::npos);
}

TEST_F(DiffOfDiagnoses, OfTheSameRigFindsNoChange) {
  put("may", diagnosis(1.2e-10, 7.5e-3));
  const Said said = diff("may may --out d");
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.out.find("the rig is the same as far as these data tell"), std::string::npos);
  EXPECT_EQ(Json::parse(read_text(scratch / "d/diff.json")).at("changed"), false);
}

TEST_F(DiffOfDiagnoses, RefusesWhatIsNone) {
  put("may", diagnosis(1.2e-10, 7.5e-3));
  fs::create_directory(scratch / "empty");
  EXPECT_EQ(diff("may empty").status, 66);
  EXPECT_EQ(diff("may may --tolerance 1").status, 64);
  Json torn = diagnosis(1.2e-10, 7.5e-3);
  torn["recalibrated"]["rest_radius"]["ci95"] = 3;
  Json forces = diagnosis(1.2e-10, 7.5e-3);
  forces["gap"]["unit"] = "N";
  for (const Json& bad : {Json::array(), Json{{"schema", "mckibben-run/1"}},
                          Json{{"schema", "mckibben-diagnosis/1"}}, torn, forces}) {
    put("bad", bad);
    for (const char* order : {"may bad", "bad may"}) {
      const Said said = diff(order);
      EXPECT_EQ(said.status, 65) << bad << said.err;
      EXPECT_NE(said.err.find("bad"), std::string::npos) << said.err;
    }
  }
}

}  // namespace
}  // namespace mckibben::cli
