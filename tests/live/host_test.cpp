// A session in real time: what it tells its watchers, and recordings as data sets. No test looks at how fast
// it goes.
#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include <sim/input/dataset_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/live/host.hpp>
#include <sim/run/replay.hpp>

#include "scratch.hpp"

namespace mckibben::live {
namespace {

namespace fs = std::filesystem;
using input::Json;
using std::chrono::milliseconds;

/// Hears a host until something is so.
struct Watcher {
  explicit Watcher(Host& watched) : host(watched) {}
  Json until(const std::function<bool(const Json& state)>& so) {
    for (int i = 0; i < 100000; ++i) {
      const std::string text = host.news(heard, milliseconds(200));
      if (text.empty()) continue;
      const Json news = Json::parse(text);
      if (news.contains("samples"))
        for (const Json& sample : news["samples"]) times.push_back(sample[0].get<double>());
      if (news.contains("state")) state = news["state"];
      if (!state.is_null() && so(state)) return state;
    }
    ADD_FAILURE() << "it never came to that: " << state.dump();
    return state;
  }
  Host& host;
  Heard heard;
  Json state;
  std::vector<double> times;
};

class LiveHost : public testing::Test {
 protected:
  Scratch scratch;
  plant::Rig rig;
  std::vector<std::string> said;
  output::Say say = [this](const std::string& text) { said.push_back(text); };

  DataSets sets() { return {scratch / "out", "live test", say}; }
  /// Records so many ticks of a sweep.
  static void record(Host& host, bool from_rest, std::size_t ticks) {
    ASSERT_EQ(host.obey(Record{from_rest}), "");
    ASSERT_EQ(host.obey(Sweep{Sweep::Shape::sine, 4.0, 12.0, 1.0}), "");
    Watcher watcher(host);
    watcher.until([](const Json& state) { return state.at("recording").get<bool>(); });
    const std::size_t before = watcher.times.size();  // of what went before, too
    watcher.until([&](const Json&) { return watcher.times.size() > before + ticks; });
    ASSERT_EQ(host.obey(StopRecording{}), "");
  }
};

TEST_F(LiveHost, TellsEachWatcherSamplesInOrderAndWhatIsSo) {
  Host host(rig, 16.138, sets());
  Watcher one(host);
  const Json state = one.until([&](const Json&) { return one.times.size() > 40; });
  EXPECT_TRUE(std::ranges::is_sorted(one.times));
  EXPECT_EQ(one.times.front(), 0.0);
  EXPECT_EQ(state.at("load_kg"), 16.138);
  EXPECT_EQ(state.at("effects").size(), Session(rig, 16.138).switches().all().size());
  Watcher late(host);
  late.until([](const Json&) { return true; });
  EXPECT_EQ(late.times.front(), 0.0);  // it hears the last seconds
}

TEST_F(LiveHost, PauseHoldsTimeStill) {
  Host host(rig, 16.138, sets());
  Watcher watcher(host);
  ASSERT_EQ(host.obey(SetRunning{false}), "");
  watcher.until([](const Json& state) { return !state.at("running").get<bool>(); });
  const std::size_t before = watcher.times.size();
  std::this_thread::sleep_for(milliseconds(60));
  EXPECT_EQ(host.news(watcher.heard, milliseconds(10)), "");
  EXPECT_EQ(watcher.times.size(), before);
  ASSERT_EQ(host.obey(SetRunning{true}), "");
  watcher.until([&](const Json&) { return watcher.times.size() > before + 3; });
}

TEST_F(LiveHost, RefusesWhatIsNotTheTimeFor) {
  Host host(rig, 16.138, sets());
  EXPECT_EQ(host.obey(StopRecording{}), "nothing is being recorded");
  ASSERT_EQ(host.obey(Record{false}), "");
  EXPECT_EQ(host.obey(Record{false}), "a recording is under way");
  EXPECT_EQ(host.obey(SetCommand{99.0}), "current = 99 mA: must be from 0 to 20 mA");
  ASSERT_EQ(host.obey(StopRecording{}), "");
  host.write_recordings(say);
  EXPECT_FALSE(fs::exists(scratch / "out")) << "a handful of rows is no run";
}

TEST_F(LiveHost, WhatIsRecordedFromRestReplaysToTheCount) {
  rig.sensors.put(plant::gauge());
  Host host(rig, 16.138, sets());
  record(host, true, 150);
  host.finish(say);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said.front().find("Recorded "), 0u) << said.front();
  const domain::Dataset data = input::read_dataset(scratch / "out");
  ASSERT_EQ(data.runs.size(), 1u);
  EXPECT_EQ(data.runs[0].load_kg, 16.138);
  EXPECT_EQ(data.recorded.start, domain::Start::settled);
  EXPECT_GE(data.runs[0].current_mA.size(), 100u);
  EXPECT_TRUE(data.runs[0].find("muscle_pressure") != nullptr);
  const auto replayed = run::replay(data, 1, [](const std::string&, std::size_t, std::size_t) {});
  const double per_count = plant::count_height_m(rig) / rig.muscle.rest_length_m;
  const auto& samples = replayed.at(0).recording.samples;
  ASSERT_EQ(samples.size(), data.runs[0].current_mA.size());
  for (std::size_t k = 0; k < samples.size(); ++k)
    EXPECT_NEAR(static_cast<double>(samples[k].counts) * per_count, data.runs[0].judged().values[k], 1e-9)
        << k;
}

TEST_F(LiveHost, OfTwoMusclesWhatIsRecordedFromRestReplaysToTheCount) {
  rig = plant::thesis_pair();
  rig.sensors.put(plant::gauge());
  Host host(rig, 0.0, sets());
  ASSERT_EQ(host.obey(SetCommand{9.0, 2}), "");
  record(host, true, 150);
  EXPECT_EQ(host.obey(Record{false}),
            "of two muscles a recording begins from rest: their data sets cannot say otherwise");
  host.finish(say);
  EXPECT_EQ(said.front().find(" kg"), std::string::npos) << said.front();
  const domain::Dataset data = input::read_dataset(scratch / "out");
  ASSERT_EQ(data.runs.size(), 1u);
  const auto replayed = run::replay(data, 1, [](const std::string&, std::size_t, std::size_t) {});
  const auto& samples = replayed.at(0).recording.samples;
  const auto& read = data.runs[0].measured->read("angle");
  ASSERT_EQ(samples.size(), read.size());
  const double per_count = plant::count_height_m(rig) / rig.joint.wheel_radius_m;
  for (std::size_t k = 0; k < samples.size(); ++k)
    EXPECT_NEAR(static_cast<double>(samples[k].counts) * per_count, read[k], 1e-9) << k;
  EXPECT_GT(*std::ranges::max_element(read) - *std::ranges::min_element(read), 0.2);
}

TEST_F(LiveHost, SwitchingEndsARecordingAndBeginsAnotherDataSet) {
  Host host(rig, 16.138, sets());
  record(host, true, 120);
  host.write_recordings(say);
  record(host, true, 120);
  host.write_recordings(say);
  EXPECT_EQ(input::read_dataset(scratch / "out").runs.size(), 2u) << "one rig, one data set";
  ASSERT_EQ(host.obey(Record{false}), "");
  Watcher watcher(host);
  watcher.until([](const Json& state) { return state.at("recording").get<bool>(); });
  const std::size_t before = watcher.times.size();
  watcher.until([&](const Json&) { return watcher.times.size() > before + 130; });
  ASSERT_EQ(host.obey(SetEffect{"muscle_leak", true, 3e-10, 0.0}), "");
  const Json state = watcher.until([](const Json& now) { return !now.at("recording").get<bool>(); });
  EXPECT_FALSE(state.at("recording").get<bool>());
  host.write_recordings(say);
  EXPECT_NE(said.back().find("(it ended: effects were switched)"), std::string::npos) << said.back();
  const domain::Dataset moving = input::read_dataset(scratch / "out-2");
  EXPECT_EQ(moving.recorded.start, domain::Start::moving);
  EXPECT_TRUE(moving.rig.effects.absent());
  record(host, true, 120);
  host.finish(say);
  const domain::Dataset leaky = input::read_dataset(scratch / "out-3");
  EXPECT_TRUE(leaky.rig.effects.absent()) << "the data set's owner does not know of the leak";
  std::vector<domain::InputFile> read;
  const plant::Rig truth = input::read_rig((scratch / "out-3-truth/rig.yaml").string(), read);
  EXPECT_EQ(truth.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa, 3e-10);
}

TEST_F(LiveHost, OfEffectsOnlyThoseThatWereSwitchedOnAreHidden) {
  rig.effects.get<plant::ViscousDamping>().damping_N_s_per_m = 40.0;
  Host host(rig, 16.138, sets());
  ASSERT_EQ(host.obey(SetEffect{"muscle_leak", true, 3e-10, 0.0}), "");
  record(host, true, 120);
  host.finish(say);
  const plant::Rig known = input::read_dataset(scratch / "out").rig;
  EXPECT_EQ(known.effects.get<plant::ViscousDamping>().damping_N_s_per_m, 40.0);
  EXPECT_TRUE(known.effects.get<plant::MuscleLeak>().absent());
}

TEST_F(LiveHost, RowsAreOnDiskAsTheyCome) {
  Host host(rig, 16.138, sets());
  ASSERT_EQ(host.obey(Record{true}), "");
  Watcher watcher(host);
  watcher.until([](const Json& state) { return state.at("recording").get<bool>(); });
  const std::size_t before = watcher.times.size();
  for (std::size_t rows = 100; rows <= 200; rows += 100) {
    watcher.until([&](const Json&) { return watcher.times.size() > before + rows; });
    host.write_recordings(say);
    EXPECT_GE(input::read_dataset(scratch / "out.unfinished").runs.at(0).current_mA.size(), rows);
    EXPECT_TRUE(fs::exists(scratch / "out-truth.unfinished/truth.yaml"));
  }
  host.finish(say);
  EXPECT_EQ(input::read_dataset(scratch / "out").runs.size(), 1u);
  EXPECT_FALSE(fs::exists(scratch / "out.unfinished"));
  EXPECT_FALSE(fs::exists(scratch / "out-truth.unfinished"));
}

TEST_F(LiveHost, AnEndFinishesARecording) {
  Host host(rig, 16.138, sets());
  ASSERT_EQ(host.obey(Record{true}), "");
  Watcher watcher(host);
  watcher.until([&](const Json&) { return watcher.times.size() > 250; });
  host.finish(say);
  EXPECT_NE(said.back().find("(it ended: the program ended)"), std::string::npos) << said.back();
  EXPECT_EQ(input::read_dataset(scratch / "out").runs.size(), 1u);
}

TEST_F(LiveHost, WhatCannotBeWrittenIsSaidAndKept) {
  scratch.write("out", "a file is in the way");
  Host host(rig, 16.138, sets());
  record(host, true, 120);
  host.write_recordings(say);
  EXPECT_NE(said.back().find("The recording is kept"), std::string::npos) << said.back();
  fs::remove(scratch / "out");
  host.finish(say);
  EXPECT_EQ(input::read_dataset(scratch / "out").runs.size(), 1u);
}

}  // namespace
}  // namespace mckibben::live
