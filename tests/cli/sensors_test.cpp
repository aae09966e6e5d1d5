// A laser and a load cell from a rig file to `dataset` and back by `replay`.
#include <cmath>

#include <gtest/gtest.h>

#include <sim/input/dataset_file.hpp>
#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

TEST(SensorsOfARig, AreWhatADatasetIsReadThrough) {
  Scratch scratch;
  write_text(scratch / "small.yaml",
             "schema: mckibben-campaign/1\n"
             "rig:\n"
             "  sensor: {kind: laser, resolution: 10 um, noise: 0.05 mm, accuracy: 0.1 mm ± 0.02 mm}\n"
             "  load_cell: {fitted: true, resolution: 0.5 N, noise: 1 N}\n"
             "loads: [11.138 kg]\n"
             "currents:\n"
             "  - {duration: 2.4 s, current: {kind: sine_current, low: 4 mA, high: 20 mA, period: 2.4 s}}\n");
  const Said said = mckibben("dataset small.yaml", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(
      read_text(scratch / "out/small/m1_c01.csv").rfind("time_s,current_mA,contraction_ratio,force_N", 0),
      0u);
  const domain::Dataset dataset = input::read_dataset(scratch / "out/small");
  EXPECT_EQ(dataset.rig.sensors.position().kind, plant::SensorKind::laser);
  ASSERT_TRUE(dataset.runs[0].measured);
  for (const double force_N : dataset.runs[0].measured->read("force"))
    ASSERT_NEAR(force_N / 0.5, std::round(force_N / 0.5), 1e-6);

  const Said replayed = mckibben("replay out/small --json", scratch);
  ASSERT_EQ(replayed.status, 0) << replayed.err;
  const auto document = input::Json::parse(replayed.out);
  for (const auto& reading : document.at("runs").at(0).at("gaps")) {
    const bool force = reading.at("reading") == "force";
    const double scatter = force ? std::hypot(1.0, 0.5 / std::sqrt(12.0)) : 5e-5 / 0.3;
    EXPECT_NEAR(reading.at("rmse").get<double>(), scatter, 0.15 * scatter) << reading;
  }
  EXPECT_EQ(document.at("runs").at(0).at("gaps").size(), 2u);
}

TEST(SensorsOfARig, CheckNamesTheGearingOfTheBase) {
  Scratch scratch;
  write_text(scratch / "rig.yaml",
             "schema: mckibben-rig/1\n"
             "sensors: [{signal: contraction, kind: encoder, pulses_per_turn: 2500}]\n");
  const Said said = mckibben("check rig.yaml", scratch);
  EXPECT_EQ(said.status, 0);
  EXPECT_NE(said.err.find("rig.yaml:2:"), std::string::npos) << said.err;
  EXPECT_NE(said.err.find("write wheel_ratio: 1 if there is no gearing"), std::string::npos) << said.err;
}

}  // namespace
}  // namespace mckibben::cli
