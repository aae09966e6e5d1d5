// run and replay: what the verbs of the same names calculate, without their files.
#include <cstdint>
#include <optional>
#include <utility>

#include <plant/geometry.hpp>
#include <sim/output/replay_results.hpp>
#include <sim/output/run_results.hpp>
#include <sim/python/dicts.hpp>
#include <sim/python/inputs.hpp>
#include <sim/python/jobs.hpp>
#include <sim/python/long_work.hpp>
#include <sim/python/pickles.hpp>
#include <sim/report/report.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/replay.hpp>
#include <sim/run/simulate.hpp>
#include <sim/tasks/tasks.hpp>

namespace mckibben::python {
namespace {

/// The recording of a run that is a part of something kept as a whole.
template <class Whole>
std::shared_ptr<const run::Recording> part_of(const std::shared_ptr<Whole>& whole,
                                              const run::Recording& recording) {
  return {whole, &recording};
}

/// Errors of a joint are in rad, and their keys say so.
std::vector<std::pair<std::string, std::optional<double>>> metrics_of(const run::TrackedRun& run,
                                                                      plant::CommandUnit commands) {
  const run::Metrics& m = run.metrics;
  if (!run.failure.empty() || !run.followed()) return {};
  const std::string unit = run.joint ? "_rad" : "";
  return {{"rmse" + unit, m.rmse},
          {"mae" + unit, m.mae},
          {"largest_error" + unit, m.largest_error},
          {"final_error" + unit, m.final_error},
          {"time_lag_s", m.time_lag_s},
          {"overshoot", m.overshoot},
          {"settling_time_s", m.settling_time_s},
          {in_unit(commands, "current_travel_mA"), m.current_travel_mA},
          {"air_kg", m.air_kg},
          {in_unit(commands, "at_lowest_current"), m.at_lowest_current},
          {in_unit(commands, "at_highest_current"), m.at_highest_current}};
}

/// As the table has it: a run that went where no real muscle can.
void add_impossible(std::vector<std::string>& warnings, const plant::Rig& rig,
                    const run::Recording& recording, const std::string& who) {
  const double reached = recording.largest_contraction_ratio;
  if (plant::danger_of(rig.muscle, reached) != plant::Danger::impossible) return;
  const std::string line = output::contraction_note(rig, reached, who);
  warnings.push_back(line.substr(2, line.size() - 3));  // without its indent and its end
}

Result run_scenario(const Scenario& asked, Threads threads, std::optional<std::uint64_t> seed,
                    const py::object& progress) {
  struct Whole {
    domain::Scenario scenario;
    run::Comparison comparison{};
  };
  const auto whole = std::make_shared<Whole>(Whole{asked.what});
  if (seed) whole->scenario.seed = *seed;
  whole->comparison = long_work(
      progress, [&](const auto& hook) { return run::compare(whole->scenario, threads.number, hook); });
  Result result{{},
                whole->comparison.warnings,
                whole->comparison.unmet,
                [whole] { return output::table_of(whole->scenario, whole->comparison); },
                [whole] { return output::json_of(whole->scenario, whole->comparison); },
                [whole] { return report::report_html(whole->scenario, whole->comparison); }};
  for (const run::TrackedRun& run : whole->comparison.runs) {
    add_impossible(result.warnings, whole->scenario.rig, run.recording, run.name);
    std::shared_ptr<const std::vector<double>> target;
    if (run.followed()) target = {whole, &whole->comparison.targets[run.target].values};
    const auto channels = plant::channels_of(whole->scenario.rig, run.recording.driven);
    result.runs.push_back(std::make_shared<Simulated>(
        Simulated{part_of(whole, run.recording), channels, run.name, run.controller, run.failure, run.load_kg,
                  target, metrics_of(run, whole->scenario.rig.command_unit())}));
  }
  return result;
}

Result replay(const domain::Dataset& dataset, const py::object& rig, Threads threads,
              const py::object& progress) {
  struct Whole {
    domain::Dataset data;
    std::vector<run::ReplayedRun> runs{};
    std::vector<std::string> warnings{};
  };
  const auto whole = std::make_shared<Whole>(Whole{dataset});
  if (!rig.is_none()) tasks::replace_rig(whole->data, "rig", rig_of(rig).file);
  do_long(progress, [&](const auto& hook) {
    whole->runs = run::replay(whole->data, threads.number, hook);
    whole->warnings = tasks::warnings_of(whole->data, whole->runs);
  });
  Result result{{},
                whole->warnings,
                {},
                [whole] { return output::table_of(whole->data, whole->runs, whole->warnings); },
                [whole] { return output::json_of(whole->data, whole->runs, whole->warnings); },
                [whole] { return report::report_html(whole->data, whole->runs, whole->warnings); }};
  for (const run::ReplayedRun& run : whole->runs) {
    add_impossible(result.warnings, whole->data.rig, run.recording, run.id);
    const auto one = std::make_shared<Simulated>(Simulated{
        part_of(whole, run.recording), plant::channels_of(whole->data.rig, run.recording.driven), run.id});
    one->failure = run.failure;
    one->load_kg = run.load_kg;
    one->gaps = run.gaps;
    result.runs.push_back(one);
  }
  return result;
}

py::object run_at(const Result& result, const py::object& place) {
  if (PySlice_Check(place.ptr())) return py::tuple(py::cast(result.runs))[place];
  if (PyIndex_Check(place.ptr()) == 0)
    throw py::type_error("result[" + repr_of(place) +
                         "]: must be a run's place, from 0 on; for its name see run.name");
  const auto count = static_cast<py::ssize_t>(result.runs.size()), index = place.cast<py::ssize_t>();
  if (index < -count || index >= count) throw py::index_error("there are " + std::to_string(count) + " runs");
  return py::cast(result.runs[static_cast<std::size_t>(index < 0 ? index + count : index)]);
}

}  // namespace

void add_jobs(py::module_& module) {
  py::class_<Result> result_class(module, "Result", "Runs, and what is to be said of them.");
  never_changes(result_class);
  result_class
      .def(py::pickle(
          [](const Result& result) {
            return py::make_tuple(result.runs, result.warnings, result.unmet, result.table(),
                                  result.document(), result.report());
          },
          [](const py::tuple& state) {
            const auto made = [&](std::size_t i) {
              return [text = state[i].cast<std::string>()] { return text; };
            };
            return Result{state[0].cast<std::vector<std::shared_ptr<Simulated>>>(),
                          state[1].cast<std::vector<std::string>>(),
                          state[2].cast<std::vector<std::string>>(),
                          made(3),
                          made(4),
                          made(5)};
          }))
      .def_property_readonly(
          "runs", [](const Result& result) { return py::tuple(py::cast(result.runs)); }, "All runs.")
      .def("__len__", [](const Result& result) { return result.runs.size(); })
      .def("__getitem__", &run_at, py::arg("index"))
      .def_readonly("warnings", &Result::warnings, "Warnings, as texts.")
      .def_readonly("unmet", &Result::unmet, "Criteria of the scenario that are not met, as texts.")
      .def(
          "to_dict", [](const Result& result) { return from_json(result.document()); },
          "What the command line writes as run.json.")
      .def(
          "report_html", [](const Result& result) { return result.report(); },
          "The text of report.html: all of it as linked plots, to be opened in a browser.")
      .def("__str__", [](const Result& result) { return result.table(); })
      .def("__repr__", [](const Result& result) {
        return "<mckibben.Result: " + std::to_string(result.runs.size()) + " runs>";
      });

  py::reinterpret_borrow<py::class_<Rig>>(py::object(module.attr("Rig")))
      .def(
          "run",
          [](const py::object& self, Threads threads, const py::object& progress, const py::kwargs& keys) {
            py::dict source(**keys);
            source["rig"] = self;
            return run_scenario(py::object(py::type::of<Scenario>())(source).cast<const Scenario&>(), threads,
                                std::nullopt, progress);
          },
          py::kw_only(), py::arg("threads") = Threads{}, py::arg("progress") = py::none(),
          "The Scenario of this rig with these keys of scenario files (loads=, target=, duration=, "
          "controllers=, ...), run as Scenario.run does.");
  const py::object scenario = module.attr("Scenario"), dataset = module.attr("Dataset");
  py::reinterpret_borrow<py::class_<Scenario>>(scenario).def(
      "run", &run_scenario, py::arg("threads") = Threads{}, py::arg("seed") = py::none(),
      py::arg("progress") = py::none(),
      "Simulates every load under every controller, on so many threads (0: all the machine has); the result "
      "does not depend on their number. `progress(what, done, total)` is called on the way. Ctrl-C ends it, "
      "as does an exception of `progress`. A run that fails says so in `failure`; the others go on.");
  py::reinterpret_borrow<py::class_<domain::Dataset, std::shared_ptr<domain::Dataset>>>(dataset).def(
      "replay", &replay, py::arg("rig") = py::none(), py::arg("threads") = Threads{},
      py::arg("progress") = py::none(),
      "Simulates every measured run with what drove it, on the data set's rig or another one, and compares. "
      "Raises UnfitData where a comparison would mean nothing. `threads`, `progress`, Ctrl-C as in "
      "Scenario.run.");
}

}  // namespace mckibben::python
