// The jitter of an encoder, told from the counts that it goes back and forth.
#include <cmath>

#include <gtest/gtest.h>

#include <sim/diagnose/noise.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {
namespace {

struct Sensed {
  double jitter, tolerance;  ///< the estimate's, relative
};

class Jitter : public testing::TestWithParam<Sensed> {};

TEST_P(Jitter, IsToldFromTheReadingsAndCountsInTheFloor) {
  const auto [jitter, tolerance] = GetParam();
  domain::Campaign campaign;
  campaign.loads_kg = {11.138, 16.138, 23.406};
  campaign.currents = three_kinds();
  campaign.noise = {.encoder_jitter = jitter};
  campaign.seed = 6;
  domain::Dataset data;
  std::vector<std::vector<bool>> masked;
  for (const run::CampaignJob& job : run::jobs_of(campaign)) {
    data.runs.push_back(run::measured(campaign, run::run_job(campaign, job)));
    masked.emplace_back(data.runs.back().current_mA.size(), false);
  }
  const NoiseFloor floor = noise_floor(data, masked, {});
  EXPECT_NEAR(floor.jitter, jitter, tolerance * jitter + 1e-5);
  const double truth = std::hypot(floor.count / std::sqrt(12.0), jitter);
  EXPECT_NEAR(floor.judged, truth, 0.15 * truth);
  EXPECT_FALSE(floor.noisy && jitter < floor.count);
}

INSTANTIATE_TEST_SUITE_P(Encoders, Jitter,
                         testing::Values(Sensed{0.0, 0.0}, Sensed{5e-5, 0.5}, Sensed{1e-4, 0.25},
                                         Sensed{2e-4, 0.15}, Sensed{4e-4, 0.15}, Sensed{8e-4, 0.15}),
                         [](const auto& tested) {
                           return fmt::format("Of{:.0f}Millionths", 1e6 * tested.param.jitter);
                         });

}  // namespace
}  // namespace mckibben::diagnose
