// Campaigns: what is read, names of currents, round trips, and that the shipped one is the thesis's.

#include <gtest/gtest.h>

#include <sim/input/campaign_file.hpp>
#include <sim/input/field_list.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/yaml_writer.hpp>

namespace mckibben::input {
namespace {

const std::string good_campaign = R"(schema: mckibben-campaign/1
rig: {gauge: {fitted: true}}
loads: [11.138 kg, 13870 g]
currents:
  - {duration: 2 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 2.4 s}}
  - {duration: 999 ms, current: {kind: triangle_current, name: slow, low: 4 mA, high: 20 mA, speed: 5.6 mA/s}}
  - {name: up, duration: 2 s, current: {kind: stair_current, low: 4 mA, high: 20 mA, steps: 4, dwell: 0.2 s}}
  - {duration: 2 s, current: {kind: recorded_current, file: tests/bad/good.csv}}
repeats: 3
noise: {encoder_jitter: 5e-5, current: 0.01 mA}
seed: 7
)";

Campaign campaign_of(const std::string& text) {
  return read_campaign(Source("some/my campaign.yaml", text, MCKIBBEN_SOURCE_DIR));
}

TEST(Campaign, ReadsEveryKindOfField) {
  const Campaign campaign = campaign_of(good_campaign);
  EXPECT_EQ(campaign.name, "my_campaign");
  EXPECT_NE(campaign.rig.sensors.of(plant::Sensed::muscle_pressure), nullptr);
  EXPECT_DOUBLE_EQ(campaign.loads_kg.at(1), 13.87);
  EXPECT_DOUBLE_EQ(campaign.currents.at(1).duration_s, 0.999);
  EXPECT_DOUBLE_EQ(std::get<controllers::SineCurrent>(*campaign.currents.at(0).current).period_s, 2.4);
  EXPECT_EQ(std::get<controllers::RecordedCurrent>(*campaign.currents.at(3).current).samples_mA,
            (std::vector<double>{4.0, 4.0}));
  EXPECT_EQ(campaign.repeats, 3);
  EXPECT_EQ(campaign.noise.encoder_jitter, 5e-5);
  EXPECT_EQ(campaign.seed, 7u);
  EXPECT_EQ(campaign.inputs.size(), 2u);
}

TEST(Campaign, NoiseInTheDeadBandOfARegulatorIsWarnedOf) {
  const auto warned = [](const std::string& band, const std::string& noise) {
    std::vector<Problem> warnings;
    read_campaign(
        Source("c.yaml",
               "schema: mckibben-campaign/1\n"
               "rig: {valve: {kind: regulator, zero_command: 0 V, span_command: 10 V, "
               "zero_pressure: 0 bar, span_pressure: 6 bar, time_constant: 0.1 s" +
                   band + "}, dac: {largest_command: 10 V}}\nloads: [11 kg]\n" +
                   "currents: [{duration: 2 s, current: {kind: sine_current, low: 2 V, high: 8 V, period: 2 "
                   "s}}]\n" +
                   noise,
               MCKIBBEN_SOURCE_DIR),
        &warnings);
    return std::ranges::count_if(warnings, [](const Problem& one) {
      return one.message.find("dead band of 12 mbar") != std::string::npos && one.place.line == 5;
    });
  };
  EXPECT_EQ(warned(", dead_band: 12 mbar", "noise: {current: 5 mV}\n"), 1);
  EXPECT_EQ(warned("", "noise: {current: 5 mV}\n"), 0);
  EXPECT_EQ(warned(", dead_band: 12 mbar", "noise: {encoder_jitter: 5e-5}\n"), 0);
}

TEST(Campaign, StepsBeginAtTheValvesZeroCurrent) {
  const Campaign campaign = campaign_of(
      "schema: mckibben-campaign/1\nrig: {valve: {zero_command: 1 mA}}\nloads: [11 kg]\n"
      "currents: [{duration: 2 s, current: {kind: step_current, moves: [{at: 1 s, to: 9 mA}]}}]\n");
  EXPECT_EQ(std::get<controllers::StepCurrent>(*campaign.currents.at(0).current).start_mA, 1.0);
}

TEST(Campaign, APairHasTwoCurrentsEachThatFollowTheirValves) {
  const Campaign campaign = campaign_of(
      "schema: mckibben-campaign/1\n"
      "rig: {base: thesis_pair, mechanics: {kind: pair, opposite: {valve: {zero_command: 1 mA}}}}\n"
      "currents:\n"
      "  - duration: 2 s\n"
      "    current_1: {kind: step_current, moves: []}\n"
      "    current_2: {kind: step_current, moves: []}\n"
      "  - name: played\n"
      "    duration: 1 s\n"
      "    current_1: {kind: recorded_current, file: tests/bad/good.csv}\n"
      "    current_2: {kind: sine_current, low: 6 mA, high: 14 mA, period: 1 s}\n");
  EXPECT_TRUE(campaign.loads_kg.empty());
  ASSERT_EQ(campaign.currents.size(), 2u);
  EXPECT_EQ(campaign.currents[0].name, "c01");
  EXPECT_FALSE(campaign.currents[0].current);
  EXPECT_EQ(std::get<controllers::StepCurrent>(*campaign.currents[0].current_1).start_mA, 4.0);
  EXPECT_EQ(std::get<controllers::StepCurrent>(*campaign.currents[0].current_2).start_mA, 1.0);
  EXPECT_EQ(std::get<controllers::RecordedCurrent>(*campaign.currents[1].current_1).samples_mA.size(), 2u);
  EXPECT_EQ(campaign_json(campaign_of(to_yaml(campaign_json(campaign)))), campaign_json(campaign));
}

TEST(Campaign, CurrentsWithoutANameAreNamedAfterWaveformOrPlace) {
  const Campaign campaign = campaign_of(good_campaign);
  EXPECT_EQ(campaign.currents.at(0).name, "c01");
  EXPECT_EQ(campaign.currents.at(1).name, "slow");
  EXPECT_EQ(campaign.currents.at(2).name, "up");
  EXPECT_EQ(campaign.currents.at(3).name, "c04");
}

TEST(Campaign, ResolvedReadsBackBitForBit) {
  const Json once = campaign_json(campaign_of(good_campaign));
  EXPECT_EQ(campaign_json(campaign_of(once.dump(2))).dump(), once.dump());
  EXPECT_EQ(campaign_json(campaign_of(to_yaml(once))).dump(), once.dump());
}

TEST(Campaign, SchemaOffersGivenCurrentsOnly) {
  const Json schema = json_schema(campaign_schema, "Campaign", list_fields<Campaign>());
  EXPECT_EQ(schema["required"], (Json{"schema", "currents"}));
  const Json& current = schema["properties"]["currents"]["items"];
  EXPECT_EQ(current["required"], Json{"duration"});
  EXPECT_EQ(current["properties"]["current"]["oneOf"].size(), 6u);
}

// T 3.3: twenty speeds of the current, 16.7 to 5.6 mA/s, five periods each; T 4.2: five loads.
TEST(Campaign, ShippedOneIsTheThesiss) {
  const Campaign campaign = read_campaign(MCKIBBEN_SOURCE_DIR "/scenarios/thesis_campaign.yaml");
  EXPECT_EQ(campaign.loads_kg, (std::vector<double>{11.138, 13.870, 16.138, 18.870, 23.406}));
  ASSERT_EQ(campaign.currents.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    const int samples = i < 19 ? 200 + 20 * static_cast<int>(i) : 600;
    const CampaignCurrent& current = campaign.currents[i];
    const auto& sine = std::get<controllers::SineCurrent>(*current.current);
    EXPECT_EQ(current.name, "n" + std::to_string(samples));
    EXPECT_NEAR(sine.period_s / campaign.rig.tick_s, samples, 1e-9);
    EXPECT_NEAR(current.duration_s / sine.period_s, 5.0, 1e-12);
    EXPECT_EQ(sine.low_mA, 0.0);
    EXPECT_EQ(sine.high_mA, 20.0);
  }
  const auto speed = [&](std::size_t i) {
    return 40.0 / std::get<controllers::SineCurrent>(*campaign.currents[i].current).period_s;
  };
  EXPECT_NEAR(speed(0), 16.7, 0.05);
  EXPECT_NEAR(speed(19), 5.6, 0.05);
  EXPECT_EQ(rig_json(campaign.rig), rig_json(Rig{}));
}

}  // namespace
}  // namespace mckibben::input
