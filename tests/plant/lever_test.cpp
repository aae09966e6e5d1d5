// A lever's geometry: angle, arm and its slope over the rise of the cord, by attachment points and by a
// table; and which levers cannot be.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <plant/plant.hpp>

namespace mckibben::plant {
namespace {

Lever with_table(std::vector<ArmAtOf<double>> arms) {
  Lever lever;
  lever.arms = std::move(arms);
  return lever;
}

/// What attachment points make of the arm, line by line.
Lever table_of(const Lever& points, double from_rad, double to_rad, int lines) {
  const Turning turning(points);
  Lever lever = points;
  for (int i = 0; i <= lines; ++i) {
    const double angle = from_rad + (to_rad - from_rad) * i / lines;
    lever.arms.push_back({angle, turning.at(turning.rise_m(angle)).arm_m});
  }
  return lever;
}

void expect_consistent(const Lever& lever) {
  const Turning turning(lever);
  EXPECT_NEAR(turning.rise_m(0.0), 0.0, 1e-15);
  for (double angle = -0.17; angle < 1.9; angle += 0.1) {
    const Stand<double> stand = turning.at(turning.rise_m(angle));
    constexpr double step = 1e-6;
    EXPECT_NEAR(stand.angle_rad, angle, 1e-12);
    EXPECT_NEAR(stand.arm_m, (turning.rise_m(angle + step) - turning.rise_m(angle - step)) / (2.0 * step),
                1e-9);
    const auto arm_at = [&](double at) { return turning.at(turning.rise_m(at)).arm_m; };
    EXPECT_NEAR(stand.arm_slope_m, (arm_at(angle + step) - arm_at(angle - step)) / (2.0 * step), 1e-8)
        << angle;
    EXPECT_TRUE(turning.in_domain(turning.rise_m(angle)));
  }
}

TEST(Lever, ItsArmIsTheSlopeOfItsCord) {
  expect_consistent(Lever{});
  expect_consistent(with_table({{0.0, 0.04}}));
  expect_consistent(with_table({{-0.5, 0.03}, {0.25, 0.05}, {1.25, 0.05}, {2.0, 0.02}}));
}

// By hand: points 30 cm and 5 cm from the pivot, at a right angle c = sqrt(0.0925) m and r = a b/c.
TEST(Lever, PointsGiveTheArmByHand) {
  const Turning turning(Lever{});
  const double opened_m = std::sqrt(0.0925 + 0.03 * std::cos(30.0 * degree_rad));
  const Stand<double> stand = turning.at(opened_m - std::sqrt(0.0925));
  EXPECT_NEAR(stand.angle_rad, 60.0 * degree_rad, 1e-12);
  EXPECT_NEAR(stand.arm_m, 0.015 / std::sqrt(0.0925), 1e-14);
}

TEST(Lever, ATableOfItsOwnArmsIsTheLever) {
  const Lever points, table = table_of(points, -0.2, 2.0, 220);
  const Turning one(points), other(table);
  for (double angle = -0.2; angle < 2.0; angle += 0.03)
    EXPECT_NEAR(one.rise_m(angle), other.rise_m(angle), 2e-6) << angle;
}

TEST(Lever, ItsDomainEndsWhereTheArmVanishes) {
  const Turning turning(Lever{});
  EXPECT_FALSE(turning.in_domain(turning.rise_m(150.0 * degree_rad) + 1e-6));
  EXPECT_FALSE(turning.in_domain(turning.rise_m(-30.0 * degree_rad) - 1e-6));
  EXPECT_FALSE(turning.in_domain(turning.rise_m(148.0 * degree_rad)));
  EXPECT_TRUE(turning.in_domain(turning.rise_m(147.0 * degree_rad)));
}

TEST(Lever, ALoadPullsByItsLeverAndItsAngle) {
  Rig rig;
  Lever lever = with_table({{0.0, 0.03}});
  lever.spring_preload_N_m = 0.5;
  lever.spring_N_m_per_rad = 2.0;
  rig.mechanics = lever;
  // (m_l L + m d) sin(theta - theta_d) and 0.5 N m at angle 0, where the muscle is at its rest length
  const double by_hand_kg = ((1.0 * 0.15 + 4.0 * 0.3) * 0.5 + 0.5 / gravity_m_per_s2) / 0.03;
  EXPECT_NEAR(rig.pulled_kg(4.0), by_hand_kg, 1e-12);
  std::get<Lever>(rig.mechanics).plane = Plane::horizontal;
  EXPECT_NEAR(rig.pulled_kg(4.0), 0.5 / gravity_m_per_s2 / 0.03, 1e-12);
}

std::string rules_of(const Rig& rig) {
  std::string all;
  const auto report = [&](std::string_view key, std::string_view message) {
    all.append(key).append(": ").append(message).append("\n");
  };
  rig.rules(report);
  rig.joint.rules(report);
  if (rig.lever() != nullptr) rig.lever()->rules(report);
  return all;
}

TEST(Lever, OneThatCannotWorkIsRefused) {
  Rig rig;
  rig.mechanics = Lever{};
  EXPECT_EQ(rules_of(rig), "");
  const auto expect = [&](const std::string& rule, const auto& change) {
    Rig wrong = rig;
    change(wrong, *wrong.lever());
    EXPECT_NE(rules_of(wrong).find(rule), std::string::npos) << rule << "\n" << rules_of(wrong);
  };
  expect("the cord cannot be taut", [](Rig&, Lever& lever) { lever.base_m = 0.2; });
  expect("arm vanishes before the muscle is at its largest contraction",
         [](Rig&, Lever& lever) { lever.attached_m = 0.04; });
  expect("arm vanishes before the muscle is at its rest length", [](Rig&, Lever& lever) {
    lever.opening_rad = 170.0 * degree_rad;
    lever.contraction_ratio = 0.1;
  });
  expect("arms ends before", [](Rig&, Lever& lever) { lever.arms = {{0.0, 0.05}, {1.0, 0.05}}; });
  expect("arms begins after", [](Rig&, Lever& lever) { lever.arms = {{0.1, 0.05}, {2.0, 0.05}}; });
  expect("angles must ascend", [](Rig&, Lever& lever) { lever.arms = {{0.0, 0.05}, {0.0, 0.06}}; });
  expect("parallel axes", [](Rig&, Lever& lever) { lever.inertia_kg_m2 = 0.02; });
  expect("of a lever say those of mechanics", [](Rig& one, Lever&) { one.joint.spring_N_per_m = 1.0; });
  expect("which a lever has not",
         [](Rig& one, Lever&) { one.effects.get<GuideFriction>().coefficient = 0.1; });
  expect("by an encoder or a potentiometer",
         [](Rig& one, Lever&) { one.sensors.position().kind = SensorKind::laser; });
  expect("are of a hanging load: say lowest_angle", [](Rig& one, Lever&) { one.joint.highest_ratio = 0.1; });
  expect("must be above lowest_angle", [](Rig& one, Lever&) { one.joint.highest_rad = -4.0; });
  Rig hanging;
  hanging.joint.lowest_rad = 0.0;
  EXPECT_NE(rules_of(hanging).find("are of a pair or a lever"), std::string::npos);
}

TEST(Lever, AStopOnTheWayAllowsWhatIsBeyond) {
  Rig rig;
  Lever lever;
  lever.attached_m = 0.04;
  rig.mechanics = lever;
  rig.joint.highest_rad = 100.0 * degree_rad;
  EXPECT_EQ(rules_of(rig), "");
  lever = Lever{};
  lever.arms = {{0.0, 0.05}, {1.0, 0.05}};
  rig.mechanics = lever;
  rig.joint.highest_rad = 1.0;
  EXPECT_EQ(rules_of(rig), "");
}

}  // namespace
}  // namespace mckibben::plant
