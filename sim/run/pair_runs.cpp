// Waveforms through the DAC, tick by tick; see the header.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include <plant/instruments.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/gaps.hpp>
#include <sim/run/pair_runs.hpp>
#include <sim/run/warnings.hpp>

namespace mckibben::run {
namespace {

/// What the DAC gives at a tick; a recording is what it gave.
double current_mA(const domain::CampaignWaveform& waveform, std::size_t tick, const plant::Rig& rig) {
  return std::visit(
      [&](const auto& one) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(one)>, controllers::RecordedCurrent>)
          return one.samples_mA[std::min(tick, one.samples_mA.size() - 1)];
        else
          return plant::dac_output_mA(rig.dac, one.at(static_cast<double>(tick) * rig.tick_s));
      },
      waveform);
}

template <class Value>
Span span_of(const std::vector<Sample>& rows, const Value& value) {
  const auto [low, high] = std::minmax_element(
      rows.begin(), rows.end(), [&](const auto& a, const auto& b) { return value(a) < value(b); });
  return {value(*low), value(*high)};
}

void run_pair(PairRun& run, const domain::TwoCurrents& currents, const domain::PairScenario& scenario) {
  const domain::RigFile& rig = scenario.rig;
  Course course;
  const auto ticks = static_cast<std::size_t>(std::llround(scenario.duration_s / rig.tick_s));
  for (std::size_t k = 0; k < ticks; ++k) {
    course.time_s.push_back(static_cast<double>(k) * rig.tick_s);
    ride::Drive& drive = course.drives.emplace_back();
    drive.current_mA = current_mA(currents.current_1, k, rig);
    drive.opposite.current_mA = current_mA(currents.current_2, k, rig);
    course.rows.push_back(k);
  }
  run.recording = follow(rig, 0.0, course);
  run.failure = run.recording.failure;
  const auto& rows = run.recording.samples;
  if (rows.empty()) return;
  run.angle_rad = span_of(rows, [&](const Sample& row) { return angle_rad(rig, row); });
  run.cord_force_N = span_of(rows, [](const Sample& row) { return row.cord_force_N; });
  run.opposite_cord_force_N = span_of(rows, [](const Sample& row) { return row.opposite.cord_force_N; });
}

}  // namespace

std::vector<PairRun> run_pairs(const domain::PairScenario& scenario, unsigned threads,
                               const ProgressHook& progress) {
  std::vector<PairRun> runs;
  for (const auto& currents : scenario.currents)
    runs.push_back({.name = currents.name, .failure = not_begun});
  for_each_result(runs.size(), threads, "simulating", progress,
                  [&](std::size_t i) { run_pair(runs[i], scenario.currents[i], scenario); });
  return runs;
}

std::vector<std::string> warnings_of(const std::vector<PairRun>& runs) {
  std::vector<std::string> all;
  for (const PairRun& run : runs)
    for (const std::string& doubt : doubts(run.recording)) all.push_back(warning_of_run(run.name, doubt));
  return grouped(all);
}

}  // namespace mckibben::run
