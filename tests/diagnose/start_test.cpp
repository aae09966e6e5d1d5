// Runs that do not begin settled: seen, and said.
#include <gtest/gtest.h>

#include <sim/data/parts.hpp>
#include <sim/diagnose/start.hpp>

#include "planted.hpp"
#include "says.hpp"

namespace mckibben::diagnose {
namespace {

Start look(const domain::Dataset& data) {
  std::vector<std::vector<bool>> masked;
  Runs runs;
  for (const auto& run : data.runs) {
    runs.push_back(masked.size());
    masked.push_back(run.judged().missing.empty() ? std::vector<bool>(run.current_mA.size(), false)
                                                  : run.judged().missing);
  }
  return look_at_start(Experiment(data, masked, 1), data.rig, runs);
}

TEST(Start, IsASuspectWhereRunsBeginInMotion) {
  auto data = small(plant::Rig{});
  const Gap gap{.noise_floor = 1e-4, .corrected_rmse = 1e-3};
  EXPECT_FALSE(look(data).suspect());
  EXPECT_EQ(sentence_of(look(data), gap, domain::Start::settled), "");
  constexpr std::ptrdiff_t lost = 40;  // the recorder was switched on late, while the sine was rising
  auto& late = data.runs[2];
  late.judged().values.erase(late.judged().values.begin(), late.judged().values.begin() + lost);
  late.current_mA.erase(late.current_mA.begin(), late.current_mA.begin() + lost);
  const Start start = look(data);
  EXPECT_EQ(start.unsettled, std::vector<std::string>{"r03"});
  EXPECT_GT(start.share_of_gap, 0.5);
  EXPECT_LT(start.share_of_time, 0.3);
  const std::string said = sentence_of(start, gap, domain::Start::settled);
  EXPECT_TRUE(holds(said, "in the first 1 s", "Not settled at the start", "start: moving"));
  EXPECT_TRUE(lacks(sentence_of(start, gap, domain::Start::moving), "settled"));
  EXPECT_EQ(sentence_of(start, {.noise_floor = 1e-3, .corrected_rmse = 1e-3}, domain::Start::settled), "");
}

TEST(Start, OfOneRunInPartsIsThatOfTheFirstPart) {
  auto data = small(plant::Rig{});
  data.runs.resize(1);
  auto& late = data.runs.front();
  constexpr std::ptrdiff_t lost = 40;
  late.judged().values.erase(late.judged().values.begin(), late.judged().values.begin() + lost);
  late.current_mA.erase(late.current_mA.begin(), late.current_mA.begin() + lost);
  const Start whole = look(data), parts = look(data::in_parts(data));
  EXPECT_EQ(parts.unsettled, std::vector<std::string>{"r01-1"});
  EXPECT_NEAR(parts.share_of_gap, whole.share_of_gap, 1e-3);
  EXPECT_NEAR(parts.share_of_time, whole.share_of_time, 1e-9);
}

}  // namespace
}  // namespace mckibben::diagnose
