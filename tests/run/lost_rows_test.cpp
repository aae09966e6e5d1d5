// Rows that are missing though the stamps go on.
#include <gtest/gtest.h>

#include <sim/data/examine.hpp>
#include <sim/data/lost_rows.hpp>

#include "measured_on.hpp"
#include "says.hpp"
#include "switched_on.hpp"

namespace mckibben::run {
namespace {

/// The sound data's run without its rows from `begin` to before `end`.
domain::Dataset without(std::size_t run, std::ptrdiff_t begin, std::ptrdiff_t end) {
  domain::Dataset data = sound();
  const auto cut = [&](auto& rows) {
    if (!rows.empty()) rows.erase(rows.begin() + begin, rows.begin() + end);
  };
  cut(data.runs[run].current_mA);
  for (domain::Reading& reading : data.runs[run].readings) cut(reading.values), cut(reading.missing);
  return data;
}

std::vector<std::size_t> found(const domain::Run& run) {
  return data::after_lost_rows(run, plant::Rig{}.tick_s);
}

TEST(LostRows, SoundDataAreSilent) {
  for (const auto& [name, rig] : plant::rigs_with_one_effect())
    for (const domain::Run& run : measured_on(rig, {11.138, 16.138}).runs)
      EXPECT_TRUE(found(run).empty()) << name << " " << run.id;
}

TEST(LostRows, AreTold) {
  const domain::Dataset data = without(1, 30, 75);  // the next step of the staircase and the rise after it
  EXPECT_EQ(found(data.runs[1]), std::vector<std::size_t>{30});
  const auto findings = data::implausible(data);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings.front().runs, std::vector<std::size_t>{1});
  EXPECT_TRUE(holds(findings.front().message,
                    "from 0.348 s to 0.36 s, its rows 30 and 31, all that was recorded jumps at once: rows "
                    "are missing",
                    "45 rows fewer than each other one, 0.54 s", "to: 0.348 s or from: 0.36 s"));
  EXPECT_EQ(said(data), std::vector<std::string>{});  // and no other cause is looked for
  const auto looked = look(data).findings;
  EXPECT_TRUE(std::ranges::any_of(looked, [](const data::Finding& one) {
    return one.severity == data::Severity::left_out && holds(one.message, "rows are missing before 0.360 s");
  }));
}

TEST(LostRows, AreTheSameWithinAHoldOfTheCommand) {
  const domain::Dataset data = without(1, 43, 80);  // of one step all but its beginning
  EXPECT_EQ(data.runs[1].current_mA[42], data.runs[1].current_mA[43]);
  EXPECT_EQ(found(data.runs[1]), std::vector<std::size_t>{43});
}

TEST(LostRows, AreToldOfASine) {
  EXPECT_EQ(found(without(0, 40, 100).runs[0]), std::vector<std::size_t>{40});
}

TEST(LostRows, APositionThatJumpsAloneIsNone) {
  domain::Dataset data = sound();
  std::vector<double>& ratios = data.runs[1].judged().values;
  for (std::size_t k = 100; k < ratios.size(); ++k) ratios[k] += 0.05;
  EXPECT_TRUE(found(data.runs[1]).empty());
}

TEST(LostRows, ARecorderThatRepeatsItsReadingsLosesNone) {
  domain::Dataset data = sound();
  for (domain::Reading& reading : data.runs[0].readings)
    for (std::size_t k = 0; k < reading.values.size(); ++k) reading.values[k] = reading.values[k - k % 8];
  EXPECT_TRUE(found(data.runs[0]).empty());
}

}  // namespace
}  // namespace mckibben::run
