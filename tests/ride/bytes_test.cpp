// States as bytes: the same values have the same bytes, whatever lay between members before.
#include <new>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include <plant/instruments.hpp>
#include <plant/rig.hpp>
#include <sim/ride/bytes.hpp>
#include <sim/ride/rider.hpp>

namespace mckibben::ride {
namespace {

struct Gap {
  float small;
  double large;
};

/// A value that is made where these bytes were before.
template <class Value>
struct Over {
  explicit Over(unsigned char before) {
    for (volatile unsigned char& byte : place) byte = before;  // else compilers leave it out
    value = new (place) Value;
  }

  alignas(Value) unsigned char place[sizeof(Value)];
  Value* value;
};

std::string bytes_of(const auto& value) {
  BytesWriter write;
  write(value);
  return write.closed();
}

template <class Value>
std::string bytes_over(unsigned char before, void (*fill)(Value& value)) {
  const Over<Value> made(before);
  fill(*made.value);
  return bytes_of(*made.value);
}

// 4 bytes of an FMU's state were whatever the heap held before.
TEST(Bytes, HoldNothingButTheValues) {
  const auto fill = [](Gap& gap) {
    gap.small = 1.5F;
    gap.large = 2.5;
  };
  const std::string bytes = bytes_over<Gap>(0x55, fill);
  EXPECT_EQ(bytes, bytes_over<Gap>(0xAA, fill));
  Gap back{};
  BytesReader read(bytes);
  read(back);
  read.end();
  EXPECT_EQ(back.small, 1.5F);
  EXPECT_EQ(back.large, 2.5);
}

// Two pickles of one state differed where no pressure was given.
TEST(Bytes, HoldNothingWhereAValueLacks) {
  const auto fill = [](Drive& drive) {
    drive.current_mA = 9.0;
    drive.opposite.valve_pressure_Pa = 2e5;
    drive.joint_force_N = 3.0;
    drive.supply_pressure_Pa = 6e5;
  };
  const std::string bytes = bytes_over<Drive>(0x55, fill);
  EXPECT_EQ(bytes, bytes_over<Drive>(0xAA, fill));
  Drive back;
  back.contraction_ratio = 0.1;
  BytesReader read(bytes);
  read(back);
  read.end();
  EXPECT_EQ(back.current_mA, 9.0);
  EXPECT_EQ(back.contraction_ratio, std::nullopt);
  EXPECT_EQ(back.opposite.muscle_pressure_Pa, std::nullopt);
  EXPECT_EQ(back.opposite.valve_pressure_Pa, 2e5);
  EXPECT_EQ(back.joint_force_N, 3.0);
  EXPECT_EQ(back.supply_pressure_Pa, 6e5);
}

// What a rig says of its sensor is no state; ends that its range lacks were whatever memory held.
TEST(Bytes, OfAReaderAreOfItsCountsAlone) {
  const auto reader_over = [](unsigned char before) {
    const Over<plant::Sensor> sensor(before);
    sensor.value->wiring = plant::EncoderWiring::crosswise;
    plant::Rig rig;
    rig.sensors.position() = *sensor.value;
    return plant::PositionReader(rig);
  };
  plant::PositionReader counted = reader_over(0x55), same = reader_over(0xAA), back = same;
  for (plant::PositionReader* each : {&counted, &same}) {
    each->count(0.0301);
    each->count(0.0200);
  }
  const std::string bytes = bytes_of(counted);
  EXPECT_EQ(bytes, bytes_of(same));
  BytesReader read(bytes);
  read(back);
  read.end();
  EXPECT_EQ(back.count(0.0250), counted.count(0.0250));
}

}  // namespace
}  // namespace mckibben::ride
