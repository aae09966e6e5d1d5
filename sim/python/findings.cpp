// calibrate and diagnose: what measured runs tell.
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include <sim/input/calibration_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/field_kinds.hpp>
#include <sim/output/calibration_report.hpp>
#include <sim/output/diagnosis_results.hpp>
#include <sim/python/inputs.hpp>
#include <sim/python/long_work.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>
#include <sim/tasks/tasks.hpp>
#include <sim/thesis/figures.hpp>

namespace mckibben::python {
namespace {

using DatasetClass = py::class_<domain::Dataset, std::shared_ptr<domain::Dataset>>;

struct Calibration {
  std::shared_ptr<const domain::Dataset> data;
  thesis::Options options;
  thesis::CalibrationResult result;
};

/// One of two words.
template <class Enum>
Enum either(const std::string& said, const char* what, std::pair<const char*, Enum> one,
            std::pair<const char*, Enum> other) {
  if (said == one.first) return one.second;
  if (said == other.first) return other.second;
  throw py::value_error(std::string(what) + " is '" + one.first + "' or '" + other.first + "', not '" + said +
                        "'");
}

int order(int value, int most, const char* what) {
  if (value < 0 || value > most)
    throw py::value_error(std::string(what) + " is 0 to " + std::to_string(most));
  return value;
}

Calibration calibrate(const domain::Dataset& dataset, const std::string& pressure,
                      const std::string& acceleration, const std::string& fit, int load_order,
                      int speed_order, const py::object& progress) {
  using namespace thesis;
  Options options;
  options.processing.pressure = either<PressureSource>(
      pressure, "pressure", {"current", PressureSource::current}, {"gauge", PressureSource::gauge});
  options.processing.acceleration =
      either<Acceleration>(acceleration, "acceleration", {"counted", Acceleration::counted},
                           {"neglected", Acceleration::neglected});
  options.fitting = either<PressureFitting>(fit, "fit", {"joint", PressureFitting::joint},
                                            {"sequence", PressureFitting::sequence});
  options.orders.load = order(load_order, 3, "load_order");
  options.orders.speed = order(speed_order, 2, "speed_order");
  return long_work(progress, [&](const run::ProgressHook& hook) {
    hook("calibrating", 0, 1);
    const auto data =
        std::make_shared<const domain::Dataset>(tasks::ticked(dataset, options.orders, [](const auto&) {}));
    Calibration made{data, options, thesis::calibrate(*data, options)};
    if (run::interrupted()) throw run::Interrupted();
    hook("calibrating", 1, 1);
    return made;
  });
}

py::dict coefficients_of(const Calibration& c) {
  py::dict all;
  for (const auto& one : c.result.calibration.details)
    all[one.name.c_str()] = py::make_tuple(one.value, one.standard_error);
  return all;
}

py::dict used_rows_of(const Calibration& c) {
  py::dict all;
  for (const domain::Run& run : c.data->runs) {
    const thesis::ProcessedRun used = thesis::process(run, *c.data, c.options.processing);
    if (!used.unusable.empty()) continue;
    py::dict by_direction;
    for (const thesis::Direction direction : thesis::directions) {
      const auto& places = used.rows[static_cast<std::size_t>(direction)];
      const std::vector<std::int64_t> rows(places.begin(), places.end());  // differences may be negative
      by_direction[std::string(thesis::name_of(direction)).c_str()] =
          py::array_t<std::int64_t>(static_cast<py::ssize_t>(rows.size()), rows.data());
    }
    all[run.id.c_str()] = by_direction;
  }
  return all;
}

struct Diagnosis {
  std::shared_ptr<const domain::Dataset> data;
  std::shared_ptr<const tasks::Found> found;
};

Diagnosis diagnose(const domain::Dataset& dataset, const py::object& rig,
                   const std::vector<std::string>& hypotheses, std::optional<double> time_limit_s,
                   std::uint64_t seed, Threads threads, const py::object& progress) {
  if (time_limit_s && !(*time_limit_s > 0.0)) throw py::value_error("time_limit_s is a time above 0 s");
  const auto data = std::make_shared<domain::Dataset>(dataset);
  if (!rig.is_none()) input::take_rig(*data, "rig", rig_of(rig).file);
  return long_work(progress, [&](const run::ProgressHook& hook) {
    tasks::Prepared prepared = tasks::prepare(*data, hypotheses, [](const std::vector<std::string>&) {});
    tasks::Diagnosing how{.threads = threads.number, .seed = seed, .prepared = std::move(prepared)};
    if (time_limit_s) how.time_limit_s = *time_limit_s;
    return Diagnosis{data, std::make_shared<const tasks::Found>(tasks::find(*data, how, hook))};
  });
}

void add_calibration(py::module_& module) {
  py::class_<Calibration>(module, "Calibration", "The thesis's friction and pressure models of a data set.")
      .def(
          "to_dict",
          [](const Calibration& c) { return from_json(output::json_of(*c.data, c.result, c.options)); },
          "What the command line writes as calibration.json.")
      .def(
          "to_yaml", [](const Calibration& c) { return input::calibration_yaml(c.result.calibration); },
          "The text of a calibration file, which controllers of scenarios name.")
      .def(
          "report_html",
          [](const Calibration& c) {
            return report::report_html(*c.data, c.result, c.options, false, thesis::figures(c.result, false));
          },
          "The text of report.html, with all figures.")
      .def(
          "used_rows", &used_rows_of,
          "Places of the rows that the fits use: an array for 'contraction' and one for 'relaxation', by the "
          "id of the run.")
      .def_property_readonly("coefficients", &coefficients_of,
                             "(value, standard error) of each coefficient of the calibration file, by name.")
      .def_property_readonly(
          "warnings", [](const Calibration& c) { return output::warnings_of(c.result, c.options); },
          "Fits that cannot be used, and what may help.")
      .def("__str__",
           [](const Calibration& c) { return output::report_of(*c.data, c.result, c.options, false); });
}

void add_diagnosis(py::module_& module) {
  py::class_<Diagnosis>(module, "Diagnosis", "What measured runs have and the rig lacks.")
      .def_property_readonly(
          "verdict",
          [](const Diagnosis& d) { return std::string(plant::name_of(d.found->diagnosis.verdict)); },
          "nothing_missing, recalibrate, missing_effect, unknown_effect or cannot_tell.")
      .def_property_readonly(
          "because", [](const Diagnosis& d) { return d.found->diagnosis.because; },
          "The verdict in a sentence.")
      .def_property_readonly(
          "rig", [](const Diagnosis& d) { return Rig{d.found->diagnosis.corrected}; },
          "The corrected rig, to run or replay.")
      .def(
          "rig_yaml", [](const Diagnosis& d) { return output::rig_yaml(*d.data, d.found->diagnosis); },
          "The text of its file, with the interval of each fitted number.")
      .def(
          "plan_yaml",
          [](const Diagnosis& d) -> std::optional<std::string> {
            if (!d.found->diagnosis.next_experiment) return std::nullopt;
            return output::plan_yaml(*d.data, d.found->diagnosis);
          },
          "The most useful next measurement, as a campaign file; None if none would help.")
      .def(
          "to_dict",
          [](const Diagnosis& d) { return from_json(output::json_of(*d.data, d.found->diagnosis)); },
          "What the command line writes as diagnosis.json.")
      .def(
          "report_html",
          [](const Diagnosis& d) {
            return report::report_html(*d.data, d.found->diagnosis, d.found->nominal, d.found->corrected);
          },
          "The text of report.html.")
      .def("__str__", [](const Diagnosis& d) { return output::table_of(*d.data, d.found->diagnosis); })
      .def("__repr__", [](const Diagnosis& d) {
        return "<mckibben.Diagnosis: " + std::string(plant::name_of(d.found->diagnosis.verdict)) + ">";
      });
}

}  // namespace

void add_findings(py::module_& module) {
  add_calibration(module);
  add_diagnosis(module);
  DatasetClass dataset = py::reinterpret_borrow<DatasetClass>(py::object(module.attr("Dataset")));
  dataset
      .def("calibrate", &calibrate, py::arg("pressure") = "current", py::arg("acceleration") = "counted",
           py::arg("fit") = "joint", py::arg("load_order") = 3, py::arg("speed_order") = 2,
           py::arg("progress") = py::none(),
           "Fits the thesis's models (docs/calibration.md): pressure from the 'current' or the 'gauge', "
           "acceleration 'counted' or 'neglected', coefficients from one 'joint' fit or the thesis's "
           "'sequence', orders in load (0 to 3) and in the current's speed (0 to 2). Raises UnfitData.")
      .def(
          "diagnose", &diagnose, py::arg("rig") = py::none(),
          py::arg("hypotheses") = std::vector<std::string>{}, py::arg("time_limit_s") = py::none(),
          py::arg("seed") = 1, py::arg("threads") = Threads{}, py::arg("progress") = py::none(),
          "Finds where the runs and the rig disagree, names what the rig lacks, adds it (docs/diagnosis.md). "
          "`rig`: in place of the data set's; `hypotheses`: files of laws that join the catalogue; "
          "`time_limit_s` [s] ends the search with the best so far. Of `progress` the total may be 0: "
          "not known. Raises UnfitData, NumericalFailure. Ctrl-C ends it, without a result.");
}

}  // namespace mckibben::python
