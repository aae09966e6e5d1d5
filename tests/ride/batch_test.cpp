// Several rigs or pairs under one drive, in common steps: each goes where it goes alone, and differences
// between them are sensitivities.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/ride/batch.hpp>
#include <sim/ride/ride.hpp>

namespace mckibben::ride {
namespace {

constexpr double group_tick_s = 0.012;
constexpr int group_ticks = 84;

Drive group_drive(int k) {
  Drive drive{{.current_mA = 11.0 - 6.0 * std::cos(0.05 * k)}};
  drive.opposite.current_mA = 12.0 + 4.0 * std::sin(0.03 * k);
  return drive;
}

class Group final : public BatchItem {
 public:
  template <class Of>
  explicit Group(const std::vector<Of>& rigs) {
    for (const Of& rig : rigs) riders_.emplace_back(rig).start(group_drive(0), 0.0);
  }
  std::span<Rider> riders() override { return riders_; }
  bool go_on() override {
    if (k_ == group_ticks) return false;
    for (Rider& rider : riders_) rider.hold(group_drive(k_), group_tick_s * (k_ + 1));
    ++k_;
    return true;
  }
  void end(const engine::Counters&, const engine::NumericalFailure* why) override {
    ended = true;
    if (why != nullptr) failure = why->what();
  }

  bool ended = false;
  std::string failure;

 private:
  std::vector<Rider> riders_;
  int k_ = 0;
};

/// In lanes where they can be.
template <class Of>
std::vector<Reading> together(const std::vector<Of>& rigs, double tolerance, bool in_lanes = true) {
  const auto group = std::make_shared<Group>(rigs);
  const BatchKey key = batch_key(group->riders(), group_drive(0), {solver::Method::erk, tolerance});
  EXPECT_EQ(key.in_lanes, in_lanes);
  if (in_lanes) {
    Batch batch(key, rigs.size());
    EXPECT_TRUE(batch.submit(group));
    batch.run();
  } else {
    Alone(group->riders(), key).run(*group);
  }
  EXPECT_TRUE(group->ended);
  EXPECT_EQ(group->failure, "");
  std::vector<Reading> readings;
  for (const Rider& rider : group->riders()) readings.push_back(rider.now.reading);
  return readings;
}

template <class Of>
void expect_as_alone(const std::vector<Of>& rigs, const std::vector<Reading>& readings,
                     double most_m = 3e-8) {
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    Ride alone(rigs[i], {solver::Method::erk, 1e-9});
    alone.start(group_drive(0), 0.0);
    for (int k = 0; k < group_ticks; ++k) alone.step(group_drive(k), group_tick_s * (k + 1));
    EXPECT_NEAR(readings[i].wheel_m, alone.reading().wheel_m, most_m) << i;
    EXPECT_NEAR(readings[i].of(plant::Sensed::muscle_pressure, 2),
                alone.reading().of(plant::Sensed::muscle_pressure, 2), 1.0)
        << i;
  }
  EXPECT_GT(std::abs(readings[0].wheel_m - readings[1].wheel_m), 1e-6);
}

TEST(Batch, EachRigOfAGroupGoesWhereItGoesAlone) {
  for (const auto memory : {plant::FrictionMemory::lugre, plant::FrictionMemory::coulomb}) {
    plant::Rig rig, lagging;
    lagging.effects.get<plant::ValveLag>().time_s = 0.03;
    rig.friction.memory = lagging.friction.memory = memory;
    const std::vector<Loaded> rigs{{rig, 11.0}, {lagging, 16.138}, {rig, 23.0}};
    expect_as_alone(rigs, together(rigs, 1e-9, memory == plant::FrictionMemory::lugre));
  }
}

// Each is carried to the instants at which another's command is felt, too.
TEST(Batch, LateCommandsOfAGroupAreFeltBetweenInstants) {
  for (const auto memory : {plant::FrictionMemory::lugre, plant::FrictionMemory::coulomb}) {
    std::vector<Loaded> rigs(2, {plant::Rig{}, 16.138});
    for (Loaded& one : rigs) one.rig.friction.memory = memory;
    rigs[0].rig.effects.get<plant::CommandDelay>().time_s = 1.5 * group_tick_s;
    rigs[1].rig.effects.get<plant::CommandDelay>().time_s = 2.2 * group_tick_s;
    expect_as_alone(rigs, together(rigs, 1e-9, memory == plant::FrictionMemory::lugre), 1e-7);
  }
}

TEST(Batch, RigsThatDifferInMoreThanNumbersGoToo) {
  plant::Rig area, log;
  area.friction.law = plant::FrictionLaw::area;
  log.friction.law = plant::FrictionLaw::logarithmic;
  const std::vector<Loaded> rigs{{plant::Rig{}, 16.138}, {area, 16.138}, {log, 16.138}};
  expect_as_alone(rigs, together(rigs, 1e-9));
}

TEST(Batch, EachPairOfAGroupGoesWhereItGoesAlone) {
  plant::Rig one, two;
  one.effects.get<plant::ValveLag>().time_s = two.effects.get<plant::ValveLag>().time_s = 0.03;
  two.effects.get<plant::BladderCreep>().stiffness_N_per_m = 300.0;
  two.muscle.rest_radius_m *= 1.02;
  const plant::Link link{.contraction_ratio = 0.12, .inertia_kg_m2 = 0.2, .hangs_at_rad = 0.1};
  const std::vector<Loaded> pairs{{plant::thesis_pair()}, {plant::pair_of(one, two, link)}};
  expect_as_alone(pairs, together(pairs, 1e-9));
}

TEST(Batch, DifferencesOverATinyChangeAreSensitivities) {
  const auto rises = [](double low_m, double high_m, double tolerance) {
    std::vector<Loaded> rigs{{plant::Rig{}, 16.138}, {plant::Rig{}, 16.138}};
    rigs[0].rig.muscle.rest_radius_m = low_m;
    rigs[1].rig.muscle.rest_radius_m = high_m;
    const auto readings = together(rigs, tolerance);
    return (readings[1].wheel_m - readings[0].wheel_m) / (high_m - low_m);
  };
  constexpr double radius_m = 7.5e-3;
  const double slope = rises(radius_m, radius_m + 1e-9, 1e-5);  // a loose tolerance
  const double exact = rises(radius_m - 2e-6, radius_m + 2e-6, 1e-11);
  EXPECT_GT(std::abs(exact), 0.3);
  EXPECT_NEAR(slope, exact, 5e-3 * std::abs(exact));
}

}  // namespace
}  // namespace mckibben::ride
