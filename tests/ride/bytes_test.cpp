// States as bytes: the same values have the same bytes, whatever lay between members before.
#include <cstring>
#include <new>
#include <string>

#include <gtest/gtest.h>

#include <sim/ride/bytes.hpp>

namespace mckibben::ride {
namespace {

struct Gap {
  float small;
  double large;
};

std::string bytes_over(int before) {
  alignas(Gap) unsigned char place[sizeof(Gap)];
  std::memset(place, before, sizeof place);
  auto* gap = new (place) Gap;
  gap->small = 1.5F;
  gap->large = 2.5;
  BytesWriter write;
  write(*gap);
  return write.closed();
}

// 4 bytes of an FMU's state were whatever the heap held before.
TEST(Bytes, HoldNothingButTheValues) {
  const std::string bytes = bytes_over(0x55);
  EXPECT_EQ(bytes, bytes_over(0xAA));
  Gap back{};
  BytesReader read(bytes);
  read(back);
  read.end();
  EXPECT_EQ(back.small, 1.5F);
  EXPECT_EQ(back.large, 2.5);
}

}  // namespace
}  // namespace mckibben::ride
