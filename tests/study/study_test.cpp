// The studies: the pages that are checked in are what the program makes of the thesis's campaign; and what is
// found is what must be so.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <plant/geometry.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/output/chart.hpp>
#include <sim/run/simulate.hpp>
#include <sim/study/counting.hpp>
#include <sim/study/figures.hpp>
#include <sim/study/lag.hpp>

namespace mckibben::study {
namespace {

const run::ProgressHook no_progress = [](const std::string&, std::size_t, std::size_t) {};

std::string checked_in(const std::string& name) {
  std::ifstream file(MCKIBBEN_SOURCE_DIR "/docs/studies/" + name, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Number {
  double value = 0.0, last_place = 0.0;
  const char* end = nullptr;
};

/// The number at the start of a text, and what one more in its last digit would be.
Number number_at(const char* text, const char* end) {
  Number number;
  number.end = std::from_chars(text, end, number.value).ptr;
  const std::string digits(text, number.end);
  const auto exponent = digits.find('e');
  const std::string mantissa = digits.substr(0, exponent);
  const auto point = mantissa.find('.');
  const auto decimals = point == std::string::npos ? 0 : mantissa.size() - point - 1;
  const int power = exponent == std::string::npos ? 0 : std::stoi(digits.substr(exponent + 1));
  number.last_place = std::pow(10.0, power - static_cast<int>(decimals));
  return number;
}

/// The same texts, and the same numbers in them but for the last digit, in which machines differ. Returns
/// where they part, empty if they do not.
std::string difference(const std::string& made, const std::string& kept) {
  const char *a = made.data(), *b = kept.data();
  const char *const a_end = a + made.size(), *const b_end = b + kept.size();
  while (a != a_end && b != b_end) {
    if (std::isdigit(static_cast<unsigned char>(*a)) != 0 &&
        std::isdigit(static_cast<unsigned char>(*b)) != 0) {
      const Number now = number_at(a, a_end), then = number_at(b, b_end);
      if (std::abs(now.value - then.value) > 1.01 * std::max(now.last_place, then.last_place)) break;
      a = now.end;
      b = then.end;
    } else if (*a++ != *b++) {
      break;
    }
  }
  if (a == a_end && b == b_end) return "";
  return std::string(a, std::min(a + 60, a_end)) + " instead of " + std::string(b, std::min(b + 60, b_end));
}

/// As few loads and speeds as the orders of the thesis allow.
domain::Campaign small_campaign() {
  domain::Campaign campaign;
  campaign.name = "small";
  campaign.loads_kg = {11.138, 14.0, 18.87, 23.406};
  for (const double period_s : {2.4, 3.6, 6.0}) {
    controllers::SineCurrent sine;
    sine.low_mA = 0.0;
    sine.high_mA = 20.0;
    sine.period_s = period_s;
    campaign.currents.push_back(
        {"n" + std::to_string(static_cast<int>(1e3 * period_s)), 3.0 * period_s, sine});
  }
  campaign.noise.gauge_Pa = 1e4;  // the study's gauge has none
  return campaign;
}

const Evidence& small() {
  static const Evidence evidence = gather(small_campaign(), 1, no_progress);
  return evidence;
}

TEST(Study, ThePagesAreWhatTheThesissCampaignGives) {
  const Evidence evidence =
      gather(input::read_campaign(MCKIBBEN_SOURCE_DIR "/scenarios/thesis_campaign.yaml"), 0, no_progress);
  for (const std::string_view name : names) {
    const Study study = make(name, evidence);
    EXPECT_EQ(difference(study.page, checked_in(study.name + ".md")), "")
        << "make it again: docs/testing.md, Studies";
    EXPECT_EQ(difference(output::chart_svg(study.picture), checked_in(study.name + ".svg")), "")
        << study.name;
  }
}

TEST(Study, ADifferenceIsNoticed) {
  EXPECT_EQ(difference("f0 = 0.0917 at 16 %", "f0 = 0.0916 at 16 %"), "");
  EXPECT_NE(difference("f0 = 0.0919 at 16 %", "f0 = 0.0916 at 16 %"), "");
  EXPECT_NE(difference("f0 = 0.0916 at 16 %, no", "f0 = 0.0916 at 16 %"), "");
  EXPECT_EQ(difference("1.2e-06", "1.3e-06"), "");
  EXPECT_NE(difference("1.2e-05", "1.2e-06"), "");
}

TEST(Study, DoesNotDependOnThreads) {
  const Evidence threaded = gather(small_campaign(), 3, no_progress);
  for (const std::string_view name : names) {
    const Study one = make(name, small()), other = make(name, threaded);
    EXPECT_EQ(one.page, other.page);
    EXPECT_EQ(one.document, other.document);
    EXPECT_EQ(output::csv_of(one.picture), output::csv_of(other.picture));
  }
}

TEST(Study, TheRowsAreThoseOfTheCalibration) {
  std::array<std::size_t, 2> used{}, seen{};
  for (const thesis::Direction direction : thesis::directions)
    for (const auto& cell : small().from_current.grid.of(direction))
      used[static_cast<std::size_t>(direction)] += cell.samples.size();
  for (const Row& row : small().rows) ++seen[static_cast<std::size_t>(row.direction)];
  EXPECT_EQ(used, seen);
}

TEST(Study, TrueAccelerationIsTheSlopeOfTheTrueSpeed) {
  const double tick_s = small().campaign.rig.tick_s;
  Tally error, size;
  for (const Row& row : small().rows) {
    const auto& samples = small().recordings[row.run].samples;
    if (row.row + 1 >= samples.size()) continue;
    const double slope_per_s2 = (samples[row.row + 1].state.joint.contraction_speed_per_s -
                                 samples[row.row - 1].state.joint.contraction_speed_per_s) /
                                (2.0 * tick_s);
    error.add(row.truly.acceleration_m_per_s2 - small().campaign.rig.muscle.rest_length_m * slope_per_s2);
    size.add(row.truly.acceleration_m_per_s2);
  }
  EXPECT_LT(error.rms(), 0.1 * size.rms());
}

TEST(StudyLag, PressureFromTheCurrentRunsAheadOfTheMuscle) {
  const Lag lag = measure_lag(small());
  for (const LagAtSpeed& at : lag.of(thesis::Direction::contraction)) EXPECT_GT(at.shift_Pa.mean(), 0.0);
  for (const LagAtSpeed& at : lag.of(thesis::Direction::relaxation)) EXPECT_LT(at.shift_Pa.mean(), 0.0);
  const auto& speeds = lag.of(thesis::Direction::contraction);
  EXPECT_GT(speeds.back().shift_Pa.mean(), speeds.front().shift_Pa.mean());
  for (const LagAtSpeed& at : speeds)
    EXPECT_NEAR(at.from_gauge.mean(), at.truly.mean(), 0.1 * at.truly.mean());
}

TEST(StudyCounting, StepsAreThoseOfTheThesissRig) {
  const Counting counting = measure_counting(small());
  EXPECT_NEAR(counting.speed_step_per_s, 0.036, 5e-4);
  EXPECT_NEAR(counting.acceleration_step_per_s2, 3.03, 5e-3);
  EXPECT_GT(counting.alone.all[counted].deviation(), 2.0 * counting.alone.all[truly].deviation());
}

// T 4.31 leaves out the guide's damping and the wheel's inertia. With all else true, what it weighs wrong is
// those two, to within the half count by which the contraction ratio is not known.
TEST(StudyCounting, WithAllElseTrueOnlyGuideAndWheelAreLeft) {
  const plant::Rig& rig = small().campaign.rig;
  const plant::Braid braid(rig.muscle);
  const double half_count = 0.5 * run::contraction_per_count(rig);
  const double wheel_kg = rig.joint.wheel_inertia_kg_m2 / std::pow(rig.joint.wheel_radius_m, 2);
  for (const Row& row : small().rows) {
    if (row.direction != thesis::Direction::contraction) continue;
    const double a = row.truly.acceleration_m_per_s2, v = rig.muscle.rest_length_m * row.truly.speed_per_s;
    const double error_kg =
        weighed_kg(row.generated_N_per_Pa * row.muscle_Pa, row.friction_N, a) - row.load_kg;
    const double expected_kg =
        (rig.joint.guide_damping_N_s_per_m * v + wheel_kg * a) / (a + plant::gravity_m_per_s2);
    const double rounded_N =
        std::max(std::abs(braid.force_N(row.contraction_ratio - half_count, row.muscle_Pa) -
                          row.generated_N_per_Pa * row.muscle_Pa),
                 std::abs(braid.force_N(row.contraction_ratio + half_count, row.muscle_Pa) -
                          row.generated_N_per_Pa * row.muscle_Pa));
    ASSERT_NEAR(error_kg, expected_kg, 1e-6 + rounded_N / (a + plant::gravity_m_per_s2))
        << row.run << " " << row.row;
  }
}

TEST(StudyFigures, ALoadOfTheCalibrationIsWeighedAsTheThesisSays) {
  const Weighing weighed = weigh(small(), small().from_current, 14.0);
  EXPECT_EQ(weighed.failure, "");
  EXPECT_LT(std::abs(weighed.error()), printed_largest_error);
}

}  // namespace
}  // namespace mckibben::study
