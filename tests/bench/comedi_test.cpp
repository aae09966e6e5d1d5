// Boards by Comedi, at the stand-in: a loop at one is a loop at the simulated bench, but for the output's
// steps; wiring that cannot be is told.
#include <string>

#include <gtest/gtest.h>

#include <controllers/pid.hpp>
#include <sim/bench/comedi.hpp>
#include <sim/bench/loop.hpp>
#include <sim/bench/simulated.hpp>
#include <sim/run/simulate.hpp>

#ifdef MCKIBBEN_COMEDI
#include <comedi.h>

#include "stand_in/comedi.hpp"
#endif

namespace mckibben::bench {
namespace {

std::string refusal(const std::string& file, const Wiring& wiring, const plant::Rig& rig = {}) {
  try {
    open_comedi(file, wiring, rig);
  } catch (const DeviceFailure& failure) {
    return failure.what();
  }
  return "";
}

#ifdef MCKIBBEN_COMEDI

Recorded driven(Device& device, Clock& clock) {
  controllers::PidSettings settings;
  settings.proportional_mA = 30.0;
  settings.integral_time_s = 0.3;
  settings.derivative_time_s = 0.0;
  LoopPlan plan;
  plan.ticks = 150;
  plan.limits = {4.0, 20.0};
  auto controller = settings.make(run::knowledge_of(plan.rig, std::vector<double>(150, 0.1)));
  return drive(device, std::move(controller), plan, clock);
}

TEST(ComediBench, IsDrivenAsTheSimulatedOneIs) {
  EXPECT_TRUE(has_comedi());
  for (const bool in_mA : {false, true}) {
    PatientClock clock, other;
    stand_in() = {.clock = &clock, .in_mA = in_mA};
    const auto board = open_comedi("/dev/comedi0", {.encoder = {{8, 10}}}, plant::Rig{});
    EXPECT_EQ(stand_in().line_of_a, static_cast<int>(NI_GPCT_PFI_OTHER_SELECT(8)));
    EXPECT_EQ(stand_in().line_of_b, static_cast<int>(NI_GPCT_PFI_OTHER_SELECT(10)));
    const Recorded recorded = driven(*board, clock);
    EXPECT_EQ(recorded.stopped, "");
    EXPECT_EQ(stand_in().written, in_mA ? 0U : 0x8000U);  // vented: 0 mA, 0 V
    Simulated bench(plant::Rig{}, 16.138, {}, 0.0);
    const Recorded expected = driven(bench, other);
    ASSERT_EQ(recorded.rows.size(), expected.rows.size());
    EXPECT_GT(recorded.rows.back().counts, 200);  // past the counter's end
    for (std::size_t k = 0; k < recorded.rows.size(); ++k)
      EXPECT_NEAR(static_cast<double>(recorded.rows[k].counts), static_cast<double>(expected.rows[k].counts),
                  3)
          << k;
    stand_in() = {};
  }
}

TEST(ComediBench, GivesAValveItsVoltsAsTheyAre) {
  PatientClock clock;
  stand_in() = {.clock = &clock};
  plant::Rig volts;
  plant::command_in(volts, plant::CommandUnit::V, -5.0, 5.0);
  volts.dac = plant::dac_for(volts.valve);
  const auto board = open_comedi("/dev/comedi0", {}, volts);
  board->put(-5.0, 0.0);
  EXPECT_EQ(stand_in().written, 0x4000U);  // of -10 to 10 V
  board->put(5.0, 0.0);
  EXPECT_EQ(stand_in().written, 0xBFFFU);
  volts.dac.largest_command = 12.0;
  EXPECT_EQ(
      refusal("/dev/comedi0", {}, volts),
      "/dev/comedi0: subdevice 1 has no range from -5 to 12 V; the rig's dac gives -5 to 12 V, and most "
      "boards -10 to 10 V at most: write dac: {lowest_command: -5 V, largest_command: 10 V}; behind an "
      "amplifier, write zero_command, span_command and dac in volts before it");
  stand_in() = {};
}

TEST(ComediBench, CountsDownThroughZero) {
  PatientClock clock;
  stand_in() = {.clock = &clock};
  const auto board = open_comedi("/dev/comedi0", {}, plant::Rig{});
  board->put(15.0, 0.0);
  clock.wait_until(3.0);
  const auto up = board->counts(3.0);
  board->put(0.0, 3.0);
  clock.wait_until(9.0);
  EXPECT_GT(up, 100);
  EXPECT_LT(board->counts(9.0), up / 2);
  stand_in().unplugged = true;
  EXPECT_THROW(board->counts(9.0), DeviceFailure);
  EXPECT_THROW(board->put(0.0, 9.0), DeviceFailure);
  stand_in() = {};
}

TEST(ComediBench, SaysWhatIsWrongWithTheWiring) {
  EXPECT_EQ(refusal("/dev/comedi3", {}),
            "/dev/comedi3 cannot be opened as a board: No such file or directory");
  EXPECT_EQ(refusal("/dev/comedi0", {.output = 0}), "/dev/comedi0: subdevice 0 is no analog output");
  EXPECT_EQ(refusal("/dev/comedi0", {.counter = 1}), "/dev/comedi0: subdevice 1 is no counter");
  EXPECT_EQ(refusal("/dev/comedi0", {.channel = 2}),
            "/dev/comedi0: subdevice 1 has 2 channels, none is number 2");
  EXPECT_EQ(
      refusal("/dev/comedi0", {.full_scale_V = 12.0}),
      "/dev/comedi0: subdevice 1 has no range from 0 to 20 mA or 0 to 12 V; --full-scale 12 V: most "
      "boards give 0 to 10 V at most; use a stage that makes 20 mA of 10 V, and leave out --full-scale");
  EXPECT_EQ(refusal("/dev/comedi0", {.encoder = {{8, 99}}}),
            "/dev/comedi0: subdevice 11 does not take line 99 for its encoder");
}

#else

TEST(ComediBench, IsMissedWhereItIsNot) {
  EXPECT_FALSE(has_comedi());
  EXPECT_NE(refusal("/dev/comedi0", {}).find("install libcomedi-dev"), std::string::npos);
}

#endif

}  // namespace
}  // namespace mckibben::bench
