// Draws of ensembles: what laws say of them, that each depends on seed, repeat and place alone, and that rigs
// that cannot be are told.
#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include <sim/domain/rig_number.hpp>
#include <sim/run/draws.hpp>
#include <sim/run/ensemble.hpp>

#include "campaign_runs.hpp"

namespace mckibben::run {
namespace {

domain::Varied named(domain::Varied number, const char* path, const char* unit) {
  number.path = path;
  number.unit = unit;
  return number;
}

domain::Campaign varying(int repeats, domain::Sampling sampling = domain::Sampling::random) {
  domain::Campaign campaign;
  campaign.name = "e";
  campaign.loads_kg = {11.138};
  campaign.currents = {{"c", 0.12, controllers::SineCurrent{}}};
  campaign.repeats = repeats;
  campaign.seed = 7;
  campaign.vary.numbers = {named(domain::Varied::normal(7.5e-3, 7.5e-5), "muscle.rest_radius", "m"),
                           named(domain::Varied::uniform(0.8, 1.2), "friction.scale", "1")};
  campaign.vary.sampling = sampling;
  return campaign;
}

struct Sums {
  double mean = 0.0, deviation = 0.0, skew = 0.0, low = INFINITY, high = -INFINITY;
};

Sums sums_of(const domain::Campaign& campaign, std::size_t k) {
  Sums sums;
  std::vector<double> all;
  for (int repeat = 1; repeat <= campaign.repeats; ++repeat) all.push_back(draws(campaign, repeat)[k]);
  for (const double x : all) sums.mean += x / campaign.repeats;
  for (const double x : all) {
    sums.deviation += std::pow(x - sums.mean, 2) / campaign.repeats;
    sums.skew += std::pow(x - sums.mean, 3) / campaign.repeats;
    sums.low = std::min(sums.low, x);
    sums.high = std::max(sums.high, x);
  }
  sums.deviation = std::sqrt(sums.deviation);
  sums.skew /= std::pow(sums.deviation, 3);
  return sums;
}

TEST(Draws, HaveTheMomentsOfTheirLaws) {
  const auto campaign = varying(20000);  // bounds below are four standard errors
  const Sums normal = sums_of(campaign, 0), uniform = sums_of(campaign, 1);
  EXPECT_NEAR(normal.mean, 7.5e-3, 4 * 7.5e-5 / std::sqrt(20000.0));
  EXPECT_NEAR(normal.deviation, 7.5e-5, 4 * 7.5e-5 / std::sqrt(40000.0));
  EXPECT_NEAR(normal.skew, 0.0, 4 * std::sqrt(6.0 / 20000.0));
  EXPECT_GE(normal.low, 7.2e-3);
  EXPECT_LE(normal.high, 7.8e-3);
  EXPECT_NEAR(uniform.mean, 1.0, 4 * 0.4 / std::sqrt(12.0 * 20000.0));
  EXPECT_NEAR(uniform.deviation, 0.4 / std::sqrt(12.0), 0.002);
  EXPECT_GE(uniform.low, 0.8);
  EXPECT_LE(uniform.high, 1.2);
  double together = 0.0;
  for (int repeat = 1; repeat <= campaign.repeats; ++repeat) {
    const auto drawn = draws(campaign, repeat);
    together += (drawn[0] - 7.5e-3) / 7.5e-5 * (drawn[1] - 1.0) / (0.4 / std::sqrt(12.0)) / campaign.repeats;
  }
  EXPECT_NEAR(together, 0.0, 4 / std::sqrt(20000.0));
}

TEST(Draws, OfALatinHypercubeEachIntervalHasOne) {
  const auto campaign = varying(1000, domain::Sampling::latin_hypercube);
  std::set<int> strata;
  for (int repeat = 1; repeat <= 1000; ++repeat)
    strata.insert(static_cast<int>((draws(campaign, repeat)[1] - 0.8) / 0.4 * 1000.0));
  EXPECT_EQ(strata.size(), 1000u);
  EXPECT_NEAR(sums_of(campaign, 0).mean, 7.5e-3, 1e-7);  // by chance alone it would be 2.4e-6
}

TEST(Draws, DependOnSeedRepeatAndPlaceOnly) {
  auto campaign = varying(100);
  const auto drawn = draws(campaign, 42);
  campaign.repeats = 100000;
  EXPECT_EQ(draws(campaign, 42), drawn);
  EXPECT_NE(draws(campaign, 43), drawn);
  campaign.seed = 8;
  EXPECT_NE(draws(campaign, 42), drawn);
  EXPECT_EQ(drawn_rig(varying(100), 42).muscle.rest_radius_m, drawn[0]);
  EXPECT_EQ(drawn_rig(varying(100), 42).friction.scale, drawn[1]);
}

TEST(Draws, APermutationMeetsEveryNumberOnce) {
  for (const std::uint64_t count : {1u, 2u, 3u, 17u, 1000u}) {
    std::set<std::uint64_t> met;
    for (std::uint64_t i = 0; i < count; ++i) met.insert(permuted(i, count, 99));
    EXPECT_EQ(met.size(), count);
    EXPECT_LT(*met.rbegin(), count);
  }
}

TEST(Draws, QuantilesAreThoseOfTheNormalLaw) {
  for (const double x : {-4.0, -1.5, -0.1, 0.0, 0.7, 3.9})
    EXPECT_NEAR(normal_quantile(0.5 * std::erfc(-x / std::sqrt(2.0))), x, 1e-11) << x;
}

TEST(Draws, RigsThatCannotBeAreTold) {
  plant::Rig rig;
  EXPECT_EQ(unfit(rig, 11.138), "");
  EXPECT_EQ(unfit(rig, 5000.0), "5000 kg: " + domain::too_heavy(5000.0, rig));
  rig.valve.supply_pressure_Pa = 1e5;  // below the pressure it is to give
  EXPECT_NE(unfit(rig, 11.138).find("valve."), std::string::npos) << unfit(rig, 11.138);
}

TEST(Ensemble, ABlockReadsBackFromItsBytes) {
  const auto campaign = varying(100);
  const EnsembleShape shape(campaign, Keep::rows);
  EXPECT_EQ(shape.in_block, 64u);
  EXPECT_EQ(shape.size_of(1), 36u);
  EnsembleBlock block(shape, 1);
  block.put(campaign, 70, run_job(campaign, job_of(campaign, 70)).recording);
  Recording failed;
  failed.failure = "why";
  block.put(campaign, 71, failed);
  const EnsembleBlock back(shape, 1, block.bytes());
  EXPECT_EQ(back.bytes(), block.bytes());
  EXPECT_TRUE(back.has(70) && back.has(71) && !back.has(72) && !back.whole());
  EXPECT_EQ(back.failures()[7], "why");
  EXPECT_EQ(back.of_run(3)[6], draws(campaign, 71)[0]);  // repeats count from 1
  EXPECT_TRUE(std::isnan(back.of_run(5)[7]));
  EXPECT_THROW(EnsembleBlock(shape, 0, block.bytes()), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::run
