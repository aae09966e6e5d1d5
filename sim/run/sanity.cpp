// See the header.
#include <algorithm>

#include <sim/run/batch.hpp>
#include <sim/run/column_sanity.hpp>
#include <sim/run/load_sanity.hpp>
#include <sim/run/replay.hpp>
#include <sim/run/sanity.hpp>
#include <sim/run/sanity_thresholds.hpp>

namespace mckibben::run {
namespace {

domain::Run beginning_of(domain::Run run, std::size_t rows) {
  rows = std::min(rows, run.contraction_ratio.size());
  if (!run.current_mA.empty()) run.current_mA.resize(rows);
  run.contraction_ratio.resize(rows);
  if (run.muscle_pressure_Pa) run.muscle_pressure_Pa->resize(rows);
  if (run.measured) run.measured->rows.resize(rows);
  return run;
}

}  // namespace

std::vector<domain::Objection> sanity(const domain::Dataset& data, const std::vector<Expected>& expected) {
  std::vector<domain::Objection> objections;
  check_columns(data, expected, objections);
  // The wrong numbers would weigh wrong.
  if (objections.empty()) check_loads(data, expected, objections);
  return objections;
}

std::vector<Expected> expected_of(const std::vector<ReplayedRun>& replayed) {
  std::vector<Expected> list(replayed.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (const Sample& sample : replayed[i].recording.samples) {
      list[i].contraction_ratio.push_back(sample.state.joint.contraction_ratio);
      list[i].pressure_Pa.push_back(sample.state.side.muscle_pressure_Pa);
    }
  }
  return list;
}

Look look(const domain::Dataset& data) {
  const auto& [most_rows, most_rows_of_a_run] = sanity_thresholds.look;
  std::size_t rows = 0;
  for (const domain::Run& run : data.runs) rows += std::min(run.contraction_ratio.size(), most_rows_of_a_run);
  const std::size_t step = rows / most_rows + 1;
  domain::Dataset some;
  some.rig = data.rig;
  some.columns = data.columns;
  some.own_clock = data.own_clock;
  for (std::size_t i = 0; i < data.runs.size(); i += step)
    some.runs.push_back(beginning_of(data.runs[i], most_rows_of_a_run));
  const auto replayed = replay(some, 0, [](const auto&, auto, auto) {});
  if (interrupted()) throw Interrupted();
  Look result{sanity(some, expected_of(replayed)), some.runs.size()};
  for (domain::Objection& objection : result.objections)
    for (std::size_t& run : objection.runs) run *= step;
  return result;
}

void raise(const domain::Dataset& data, const std::vector<domain::Objection>& objections) {
  if (std::any_of(objections.begin(), objections.end(),
                  [](const domain::Objection& one) { return one.certain; }))
    throw domain::UnfitData(data, objections);
}

}  // namespace mckibben::run
