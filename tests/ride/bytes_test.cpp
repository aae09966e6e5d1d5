// States as bytes: the same values have the same bytes, whatever lay between members before.
#include <cstring>
#include <new>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include <sim/ride/bytes.hpp>
#include <sim/ride/rider.hpp>

namespace mckibben::ride {
namespace {

struct Gap {
  float small;
  double large;
};

/// Of a value that is made where these bytes were before.
template <class Value>
std::string bytes_over(int before, void (*fill)(Value& value)) {
  alignas(Value) unsigned char place[sizeof(Value)];
  std::memset(place, before, sizeof place);
  auto* value = new (place) Value;
  fill(*value);
  BytesWriter write;
  write(*value);
  return write.closed();
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
}

}  // namespace
}  // namespace mckibben::ride
