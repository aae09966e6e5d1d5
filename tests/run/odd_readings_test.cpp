// Jumps that stay, of readings that a logger repeats until the sensor has the next.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <sim/data/odd_readings.hpp>

namespace mckibben::data {
namespace {

constexpr double count = 0.05, tick_s = 0.005;  // mm, s

/// The load [mm]: at rest for a second, up by 1 mm in 12 ms, down again, and at rest.
double height(double time_s) {
  constexpr double mm_per_s = 1.0 / 0.012;
  return mm_per_s * (std::fdim(time_s, 1.0) - 2.0 * std::fdim(time_s, 1.6) + std::fdim(time_s, 2.2));
}

/// Logged every 5 ms.
std::vector<double> logged(double renewed_s, double jump_s, double jump) {
  std::vector<double> values;
  for (double time_s = 0.0; time_s < 3.0; time_s += tick_s) {
    const double read_s = std::floor(time_s / renewed_s + 1e-6) * renewed_s;
    values.push_back(std::floor((height(read_s) + (read_s < jump_s ? 0.0 : jump)) / count) * count);
  }
  return values;
}

std::optional<std::size_t> jump_of(const std::vector<double>& values) {
  const std::vector<double> even(values.size(), 0.0);
  return lost_counts(values, even, std::vector<bool>(values.size(), false), count, tick_s);
}

TEST(OddReadings, ReadingsThatAreRepeatedWhileTheLoadMovesDoNotJump) {
  for (const double renewed_s : {0.005, 0.007, 0.008, 0.012, 0.02, 0.1})
    EXPECT_FALSE(jump_of(logged(renewed_s, 9.0, 0.0))) << renewed_s;
}

TEST(OddReadings, JumpsOfRepeatedReadingsAreFound) {
  for (const double renewed_s : {0.005, 0.012, 0.02})
    for (const double jump_s : {0.5, 1.3, 1.9, 2.6})
      for (const double jump : {-20.0, 20.0}) {
        const auto row = jump_of(logged(renewed_s, jump_s, jump));
        ASSERT_TRUE(row) << renewed_s << " " << jump_s << " " << jump;
        EXPECT_NEAR(static_cast<double>(*row) * tick_s, jump_s, renewed_s + tick_s);
      }
}

}  // namespace
}  // namespace mckibben::data
