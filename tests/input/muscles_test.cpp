// Muscles by catalogue: what the program has built in is the shipped file, and every number says how well it
// is known. What their threads bear where no file says it.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include <plant/friction.hpp>
#include <plant/geometry.hpp>

#include "rig_text.hpp"

namespace mckibben::input {
namespace {

TEST(Muscles, AreTheShippedFiles) {
  std::vector<InputFile> inputs;
  for (const std::string name :
       {"festo_dmsp_5", "festo_dmsp_10", "festo_dmsp_20", "festo_dmsp_40", "home_made"}) {
    const Rig built_in = read_rig(name, inputs);
    EXPECT_TRUE(inputs.empty()) << name;
    const Rig file = read_rig(MCKIBBEN_SOURCE_DIR "/scenarios/rigs/" + name + ".yaml", inputs);
    inputs.clear();
    EXPECT_EQ(rig_json(built_in), rig_json(file)) << name;
    EXPECT_EQ(built_in.spreads, file.spreads) << name;
    for (const char* key : {"rest_length", "rest_radius", "braid_angle", "end_correction", "dead_volume"})
      EXPECT_TRUE(built_in.spreads.contains(std::string("muscle.") + key)) << name << ' ' << key;
  }
}

TEST(Muscles, MayBeChangedLikeAnyBase) {
  const Rig rig = rig_of("base: festo_dmsp_20\nmuscle: {rest_length: 200 mm ± 1 mm}");
  EXPECT_DOUBLE_EQ(rig.muscle.rest_length_m, 0.2);
  EXPECT_DOUBLE_EQ(rig.spreads.at("muscle.rest_length"), 1e-3);
  EXPECT_DOUBLE_EQ(rig.muscle.rest_radius_m, 11.4e-3);
  EXPECT_DOUBLE_EQ(rig.spreads.at("effects.bladder_elasticity.force"), 0.15 * 254.0);
}

/// A settled muscle's force [N] where its threads do not rub.
double force_N(const Rig& rig, double contraction_ratio, double pressure_Pa) {
  const plant::Braid braid(rig.muscle);
  plant::Instant<double> now{};
  now.contraction_ratio = contraction_ratio;
  now.rise_m = contraction_ratio * rig.muscle.rest_length_m;
  return braid.force_N(contraction_ratio, pressure_Pa) +
         rig.effects.get<plant::BladderElasticity>().pull_N(now, 0.0);
}

struct Point {
  double contraction_ratio, pressure_Pa, force_N;
};
/// The first three columns of a table, each made SI by its factor; lengths are made ratios by one at rest.
std::vector<Point> points(const std::string& file, double per_bar, double rest_length_m) {
  std::ifstream in(MCKIBBEN_SOURCE_DIR "/scenarios/real/" + file);
  EXPECT_TRUE(in) << file;
  std::vector<Point> found;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream row(line);
    Point p{};
    row >> p.contraction_ratio >> p.pressure_Pa >> p.force_N;
    if (rest_length_m > 0.0) p.contraction_ratio = 1.0 - p.contraction_ratio / rest_length_m;
    p.pressure_Pa *= per_bar;
    found.push_back(p);
  }
  return found;
}

/// rms of what a rig pulls less than it should, as a share of the largest force.
double misses(const Rig& rig, const std::vector<Point>& map) {
  double squares = 0.0, largest_N = 0.0;
  for (const Point& p : map) {
    double pulled_N = force_N(rig, p.contraction_ratio, p.pressure_Pa);
    if (p.force_N == 0.0) pulled_N = std::max(pulled_N, 0.0);  // slack
    squares += (pulled_N - p.force_N) * (pulled_N - p.force_N);
    largest_N = std::max(largest_N, p.force_N);
  }
  return std::sqrt(squares / static_cast<double>(map.size())) / largest_N;
}

Rig festo(int diameter_mm, int rest_length_mm) {
  return rig_of("base: festo_dmsp_" + std::to_string(diameter_mm) +
                "\nmuscle: {rest_length: " + std::to_string(rest_length_mm) + " mm}");
}

TEST(Muscles, PullAsPrintedForceMapsSay) {
  for (const auto& [rig, table] : {std::pair{festo(10, 250), "sarosi_dmsp_10"},
                                   {festo(10, 189), "hunt_10"},
                                   {festo(20, 200), "sarosi_dmsp_20_200n"},
                                   {festo(20, 400), "sarosi_dmsp_20_400n"},
                                   {festo(40, 600), "tool_dmsp_40"},
                                   {festo(40, 1000), "bench_dmsp_40"}})
    EXPECT_LT(misses(rig, points(std::string("printed_laws/") + table + ".csv", 1e5, 0.0)), 0.05) << table;
  std::vector<Point> map;
  for (const char* length : {"198", "204", "219", "234", "250"})
    for (const Point& p : points(std::string("martens2017/dmsp_10_250_") + length + "mm.csv", 1.0, 0.25))
      map.push_back(p);
  EXPECT_EQ(map.size(), 85u);
  EXPECT_LT(misses(festo(10, 250), map), 0.05);
  map.clear();
  for (const char* length : {"222", "237", "250", "267", "282", "296"})
    for (const Point& p : points(std::string("martens2017/dmsp_20_300_") + length + "mm.csv", 1.0, 0.3))
      map.push_back(p);
  EXPECT_EQ(map.size(), 126u);
  EXPECT_LT(misses(festo(20, 300), map), 0.05);
}

// 37 mm of ends make that of a muscle of 10 to 40 cm; 32 mm make 35 %.
TEST(Muscles, PullLessTheShorterTheyAre) {
  EXPECT_NEAR(force_N(festo(10, 400), 0.0, 6e5) / force_N(festo(10, 100), 0.0, 6e5), 1.40, 0.06);
}

// 140 N, 1.5 kN and 6 kN at 6 bar, and a fifth or a quarter of the length.
TEST(Muscles, PullAboutAsTheyAreRated) {
  for (const auto& [name, rated_N, shortens] : {std::tuple{"festo_dmsp_5", 140.0, 0.20},
                                                {"festo_dmsp_20", 1500.0, 0.25},
                                                {"festo_dmsp_40", 6000.0, 0.25}}) {
    const Rig rig = rig_of(std::string("base: ") + name);
    EXPECT_NEAR(force_N(rig, 0.0, 6e5), rated_N, 0.19 * rated_N) << name;
    EXPECT_GT(force_N(rig, shortens - 0.01, 6e5), 0.0) << name;
    EXPECT_LT(force_N(rig, shortens + 0.05, 6e5), 0.0) << name;
  }
}

// Loops of length over pressure under a load that are as wide as the data sheet allows, 3 % of the length.
TEST(Muscles, HaveTheHysteresisOfTheirDataSheet) {
  for (const auto& [name, load_N] : {std::pair{"festo_dmsp_5", 15.0},
                                     {"festo_dmsp_10", 60.0},
                                     {"festo_dmsp_20", 150.0},
                                     {"festo_dmsp_40", 600.0}}) {
    const Rig rig = rig_of(std::string("base: ") + name);
    const plant::Braid braid(rig.muscle);
    const auto stands = [&](double pressure_Pa, double sign) {  // as threads hold it below or above
      double low = 0.0, high = 0.4;
      for (int i = 0; i < 50; ++i) {
        const double e = 0.5 * (low + high);
        const double level_N =
            friction_level_N(rig.friction, e, braid.contact_surface_m2(e), pressure_Pa, 0.0);
        (force_N(rig, e, pressure_Pa) > load_N + sign * level_N ? low : high) = e;
      }
      return low;
    };
    double widest = 0.0;
    for (double pressure_Pa = 1e4; pressure_Pa <= 6e5; pressure_Pa += 1e4)
      widest = std::max(widest, stands(pressure_Pa, -1.0) - stands(pressure_Pa, 1.0));
    EXPECT_NEAR(widest, 0.03, 0.003) << name;
  }
}

// A stop that no file writes bears all that the muscle lifts, wherever its size is written; one that a file
// writes stays.
TEST(Muscles, BearWhatTheyLift) {
  const auto bears = [](const Rig& rig) {
    const plant::Braid braid(rig.muscle);
    return braid.largest_load_kg() * plant::gravity_m_per_s2 >=
           braid.largest_force_N(rig.valve.span_pressure_Pa);
  };
  for (const char* text :
       {"muscle: {rest_radius: 10.8 mm}", "base: thesis\nmuscle: {rest_radius: 20 mm, count: 3}",
        "base: festo_dmsp_20\nvalve: {span_pressure: 8 bar, supply_pressure: 8 bar}",
        "muscle: {rest_length: 60 mm}", "valve: {span_pressure: 6 bar}", "muscle: {braid_angle: 12 deg}"})
    EXPECT_TRUE(bears(rig_of(text))) << text;
  EXPECT_GT(rig_of("muscle: {rest_radius: 10.8 mm}").muscle.stop_stiffness_N_per_m, 3e5);
  EXPECT_EQ(rig_of("muscle: {rest_radius: 6 mm}").muscle.stop_stiffness_N_per_m, 3e5);
  for (const char* name : {"thesis", "thesis_pair"})
    EXPECT_EQ(rig_of(std::string("base: ") + name).muscle.stop_stiffness_N_per_m, 3e5) << name;
  EXPECT_EQ(rig_of("muscle: {rest_radius: 10.8 mm, stop_stiffness: 3e5 N/m}").muscle.stop_stiffness_N_per_m,
            3e5);
  const Rig pair =
      rig_of("base: thesis_pair\nmechanics: {kind: pair, opposite: {muscle: {rest_radius: 12 mm}}}");
  EXPECT_EQ(pair.muscle.stop_stiffness_N_per_m, 3e5);
  EXPECT_TRUE(bears(opposite_rig(pair)));
}

}  // namespace
}  // namespace mckibben::input
