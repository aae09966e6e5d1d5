// Rigs, scenarios and data sets: from files or dicts, by the readers of the command line.

#include <nlohmann/json.hpp>
#include <pybind11/stl/filesystem.h>

#include <plant/geometry.hpp>
#include <plant/instruments.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/python/dicts.hpp>
#include <sim/python/inputs.hpp>
#include <sim/run/simulate.hpp>
#include <sim/run/track.hpp>

namespace mckibben::python {

Rig rig_of(const py::object& from, const std::filesystem::path& folder) {
  if (py::isinstance<Rig>(from)) return from.cast<Rig>();
  Rig rig;
  rig.file = read_either(
      from, folder, "rig", std::string(input::rig_schema),
      [&](input::Source source) { return input::read_rig(std::move(source), rig.inputs); },
      [&](const std::string& name_or_path) { return input::read_rig(name_or_path, rig.inputs); });
  return rig;
}

namespace {

std::string json_of(const plant::Rig& rig) {
  input::Json json = input::rig_json(rig);
  json.erase("schema");
  return json.dump();
}

std::string repr_of_rig(const Rig& rig) {
  return std::string("<mckibben.Rig: ") + (rig.file.pair() != nullptr ? "two muscles" : "one muscle") +
         ", rest length " + std::to_string(rig.file.muscle.rest_length_m) + " m>";
}

/// The schema of a dict that does not say it.
std::string schema_for(const py::object& from) {
  const bool pair = py::isinstance<py::dict>(from) && from.cast<py::dict>().contains("currents");
  return std::string(pair ? input::pair_schema : input::scenario_schema);
}

Scenario scenario_of(const py::object& from, const std::filesystem::path& folder) {
  std::vector<input::Problem> problems;
  Scenario scenario{
      read_either(
          from, folder, "scenario", schema_for(from),
          [&](input::Source source) { return input::read_scenario(std::move(source), problems); },
          [&](const std::string& path) {
            return input::read_scenario(std::filesystem::path(path), problems);
          }),
      {}};
  for (const auto& problem : problems)
    scenario.warnings.push_back(input::where(problem) + ": " + problem.message);
  warn(scenario.warnings);
  return scenario;
}

py::object sampled_target(const Scenario& scenario) {
  if (scenario.what.rig.pair() != nullptr) return py::none();
  const std::vector<double> target = run::wanted_of(scenario.what).front().ratios;
  return py::array_t<double>(static_cast<py::ssize_t>(target.size()), target.data());
}

domain::Dataset read_dataset(const py::object& from, const std::filesystem::path& folder) {
  return read_either(
      from, folder, (folder / "dataset").lexically_normal().string(), std::string(input::dataset_schema),
      [](input::Source source) { return input::read_dataset(std::move(source)); },
      [](const std::string& path) { return input::read_dataset(std::filesystem::path(path)); });
}

/// Tables at hand go the way of files, so that they are checked as these are.
domain::Dataset dataset_of(const py::object& from, const std::filesystem::path& folder) {
  if (!py::isinstance<py::dict>(from)) return read_dataset(from, folder);
  const py::tuple made = of_package("tables", "with_files")(from);  // and the folder of the files
  try {
    domain::Dataset data = read_dataset(made[0], folder);
    made[1].attr("cleanup")();
    return data;
  } catch (...) {
    made[1].attr("cleanup")();
    throw;
  }
}

}  // namespace

void add_inputs(py::module_& module) {
  py::class_<Rig>(module, "Rig", "A rig and how its equations are solved, as a rig file describes it.")
      .def(py::init(&rig_of), py::arg("source") = "thesis", py::arg("folder") = ".",
           "A shipped rig by its name, a rig file by its path, or a dict of what would stand in one. "
           "Relative paths in a dict start at `folder`. Raises InputError, MissingInput.")
      .def(
          "to_dict", [](const Rig& rig) { return from_json(json_of(rig.file)); },
          "Every field, as a rig file has it: quantities with their units. Reads back to the same bits.")
      .def(
          "dac_output",
          [](const Rig& rig, double wanted) { return plant::dac_output_mA(rig.file.dac, wanted); },
          py::arg("wanted"), "The command that the rig's DAC gives where it is asked for one.")
      .def(
          "dac_output_mA",
          [](const Rig& rig, double wanted_mA) {
            return plant::dac_output_mA(rig.file.dac,
                                        *either<double>({}, wanted_mA, rig.file.command_unit()));
          },
          py::arg("wanted_mA"), "The same of a valve that takes mA.")
      .def_property_readonly(
          "command_unit", [](const Rig& rig) { return name_of(rig.file.command_unit()); },
          "What the rig's valves are commanded in, and all commands here: mA, V or bar.")
      .def_property_readonly(
          "tick_s", [](const Rig& rig) { return rig.file.tick_s; }, "Period of controllers and tables [s].")
      .def_property_readonly(
          "pair", [](const Rig& rig) { return rig.file.pair() != nullptr; },
          "Whether two muscles pull on one wheel.")
      .def_property_readonly(
          "rest_length_m", [](const Rig& rig) { return rig.file.muscle.rest_length_m; },
          "Length of the muscle at rest [m]; a contraction ratio times this is a rise.")
      .def_property_readonly(
          "contraction_per_count", [](const Rig& rig) { return run::contraction_per_count(rig.file); },
          "Contraction ratio of one count of the encoder [1].")
      .def_property_readonly(
          "largest_contraction_ratio",
          [](const Rig& rig) { return plant::Braid(rig.file.muscle).largest_contraction_ratio(); },
          "Where the muscle pulls no more (T 2.10) [1].")
      .def_property_readonly(
          "command_range",
          [](const Rig& rig) {
            return std::make_pair(rig.file.valve.zero_command, rig.file.valve.span_command);
          },
          "Ends of the valve's line: no pressure, and most of it.")
      .def_property_readonly(
          "current_range_mA",
          [](const Rig& rig) {
            const auto& valve = rig.file.valve;
            return std::make_pair(*either<double>({}, valve.zero_command, valve.command_unit),
                                  valve.span_command);
          },
          "The same of a valve that takes mA.")
      .def(
          "__eq__",
          [](const Rig& a, const py::object& b) {
            return py::isinstance<Rig>(b) && json_of(a.file) == json_of(b.cast<const Rig&>().file);
          },
          py::is_operator())
      .def("__repr__", &repr_of_rig);

  py::class_<Scenario>(module, "Scenario",
                       "Which rig lifts which loads along which target, or two currents of a pair.")
      .def(py::init(&scenario_of), py::arg("source"), py::arg("folder") = ".",
           "A scenario file by its path, or a dict of what would stand in one (docs/scenarios.md). Where the "
           "dict has `currents` and no `schema`, it is one of a pair of muscles. `rig` may be a Rig. Raises "
           "InputError, MissingInput; warns of what is odd.")
      .def(
          "to_dict",
          [](const Scenario& scenario) { return from_json(input::scenario_json(scenario.what).dump()); },
          "Every field, as a scenario file has it.")
      .def_property_readonly(
          "name", [](const Scenario& s) { return s.what.name; }, "What folders of its results are called.")
      .def_property_readonly(
          "rig",
          [](const Scenario& s) {
            return Rig{s.what.rig, {}};
          },
          "Its rig.")
      .def_property_readonly(
          "target", &sampled_target,
          "Contraction ratio that is wanted at each tick [1], shape (ticks,); None for a pair.")
      .def_readonly("warnings", &Scenario::warnings, "What its reader warned of.");

  py::class_<domain::Dataset, std::shared_ptr<domain::Dataset>>(module, "Dataset",
                                                                "Measured runs, and the rig they are of.")
      .def(py::init([](const py::object& from, const std::filesystem::path& folder) {
             return std::make_shared<domain::Dataset>(dataset_of(from, folder));
           }),
           py::arg("source"), py::arg("folder") = ".",
           "A data set by its folder or its file, or a dict of what would stand in that (docs/datasets.md), "
           "in "
           "which a run may have `data` in place of `file`: its columns as arrays, in a dict, a structured "
           "array or a DataFrame. Raises InputError, MissingInput.")
      .def_property_readonly(
          "rig",
          [](const domain::Dataset& data) {
            return Rig{data.rig, data.inputs};
          },
          "The nominal rig.")
      .def_property_readonly(
          "ids",
          [](const domain::Dataset& data) {
            std::vector<std::string> ids;
            for (const auto& run : data.runs) ids.push_back(run.id);
            return ids;
          },
          "Names of its runs.");
}

}  // namespace mckibben::python
