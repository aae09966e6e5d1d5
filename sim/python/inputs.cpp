// Rigs, scenarios and data sets: from files or dicts, by the readers of the command line.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <pybind11/stl/filesystem.h>

#include <plant/geometry.hpp>
#include <plant/instruments.hpp>
#include <sim/domain/rig_number.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/input/yaml_writer.hpp>
#include <sim/python/dicts.hpp>
#include <sim/python/inputs.hpp>
#include <sim/python/pickles.hpp>
#include <sim/run/drawn_noise.hpp>
#include <sim/run/simulate.hpp>
#include <sim/run/track.hpp>

namespace mckibben::python {

Rig rig_of(const py::object& from, const std::filesystem::path& folder) {
  if (py::isinstance<Rig>(from)) return from.cast<Rig>();
  std::vector<domain::InputFile> inputs;
  return {read_either(
      from, folder, "rig", std::string(input::rig_schema),
      [&](input::Source source) { return input::read_rig(std::move(source), inputs); },
      [&](const std::string& name_or_path) { return input::read_rig(name_or_path, inputs); })};
}

double within(double value, double lowest, double highest, const std::string& name, const std::string& unit) {
  if (value >= lowest && value <= highest) return value;
  throw py::value_error(
      fmt::format("{} = {:g}: must be from {:g} to {:g} {}", name, value, lowest, highest, unit));
}

double command_within(double value, const plant::Rig& rig, const std::string& name) {
  return within(value, rig.dac.lowest_command, rig.dac.largest_command, name,
                std::string(name_of(rig.command_unit())));
}

std::optional<double> number_of(const py::object& given, const char* name, std::string_view unit) {
  if (given.is_none()) return {};
  const double number = PyFloat_AsDouble(given.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();
  throw py::type_error(fmt::format("{} = {}: must be a number, in {}", name, repr_of(given), unit));
}

std::optional<Numbers> numbers_of(const py::object& given, const char* name, std::string_view unit) {
  if (given.is_none()) return {};
  if (Numbers::check_(given)) return given.cast<Numbers>();  // most
  const auto array = py::array::ensure(given);
  if (array && std::string_view("fiu").find(array.dtype().kind()) != std::string_view::npos)
    if (auto numbers = Numbers::ensure(array)) return numbers;
  throw py::type_error(fmt::format("{} = {}: must be numbers, in {}", name, repr_of(given), unit));
}

double load_within(double load_kg, const plant::Rig& rig, const std::string& name) {
  within(load_kg, 0.0, 500.0, name, "kg");
  const std::string why = rig.can_hang(load_kg) ? domain::too_heavy(load_kg, rig) : input::no_mass(rig);
  if (!why.empty()) throw py::value_error(fmt::format("{} = {:g} kg: {}", name, load_kg, why));
  return load_kg;
}

std::string fields_of(const plant::Rig& rig) {
  input::Json json = input::rig_json(rig);
  json.erase("schema");
  return json.dump();
}

namespace {

std::string in_words(const plant::Rig& rig) {
  return fmt::format("{}, rest length {:.6f} m", rig.pair() != nullptr ? "two muscles" : "one muscle",
                     rig.muscle.rest_length_m);
}
std::string repr_of_rig(const Rig& rig) {
  return fmt::format("<mckibben.Rig: {}>", in_words(rig.file));
}

std::string repr_of_scenario(const Scenario& scenario) {
  const domain::Scenario& it = scenario.what;
  std::string text = fmt::format("<mckibben.Scenario {}: {}", it.name, in_words(it.rig));
  const auto add = [&](std::string_view one, const auto& names, std::string_view unit = "") {
    if (!names.empty())
      text += fmt::format("; {}{} {}{}", one, names.size() > 1 ? "s" : "", fmt::join(names, ", "), unit);
  };
  const auto names = [](const auto& all) {
    std::vector<std::string> found;
    for (const auto& one : all) found.push_back(one.name);
    return found;
  };
  add("load", it.loads_kg, " kg");
  add("target", names(it.targets));
  add("current", names(it.currents));
  std::vector<std::string> controllers;
  for (const auto& one : it.controllers) controllers.push_back(controllers::name_of(one));
  add("controller", controllers);
  return fmt::format("{}; {:g} s>", text, it.duration_s);
}

/// The schema of a dict that does not say it.
std::string schema_for(const py::object& from) {
  const bool pair = py::isinstance<py::dict>(from) && from.cast<py::dict>().contains("currents");
  return std::string(pair ? input::pair_schema : input::scenario_schema);
}

Scenario scenario_of(const py::object& from, const std::filesystem::path& folder) {
  std::vector<input::Problem> problems;
  std::filesystem::path start = folder;
  domain::Scenario read = read_either(
      from, folder, "scenario", schema_for(from),
      [&](input::Source source) { return input::read_scenario(std::move(source), problems); },
      [&](const std::filesystem::path& path) {
        start = path.parent_path();
        return input::read_scenario(path, problems);
      });
  Scenario scenario{std::move(read), std::filesystem::absolute(start), {}};
  const DictText dict = py::isinstance<py::dict>(from)
                            ? text_of(from.cast<py::dict>(), "scenario", schema_for(from))
                            : DictText{};
  for (const auto& problem : problems)
    scenario.warnings.push_back(dict.path_of(problem).value_or(input::where(problem)) + ": " +
                                problem.message);
  warn(scenario.warnings);
  return scenario;
}

py::object sampled_target(const Scenario& scenario) {
  const std::vector<run::Wanted> all = run::wanted_of(scenario.what);
  if (all.size() != 1) return py::none();
  const auto& target = all.front().values;
  return py::array_t<double>(static_cast<py::ssize_t>(target.size()), target.data());
}

domain::Dataset read_dataset(const py::object& from, const std::filesystem::path& folder) {
  return read_either(
      from, folder, (folder / "dataset").lexically_normal().string(), std::string(input::dataset_schema),
      [](input::Source source) { return input::read_dataset(std::move(source)); },
      [](const std::filesystem::path& path) { return input::read_dataset(path); });
}

/// Where in the arrays a problem of the file is that was written of them: `written` is the run's place in the
/// list, and the names of its columns.
std::string place_in_arrays(const input::Problem& problem, const py::tuple& written) {
  const std::string data = "runs[" + py::str(written[0]).cast<std::string>() + "].data";
  if (problem.place.line < 2) return data;
  const std::string row = "[" + std::to_string(problem.place.line - 2) + "]";
  const std::string before = problem.source_line.substr(0, problem.place.column - 1);
  const auto column = static_cast<std::size_t>(std::ranges::count(before, ','));
  const py::list names = written[1];
  if (problem.source_line.empty() || problem.place.column == 0 || column >= names.size()) return data + row;
  return data + "[" + py::repr(names[column]).cast<std::string>() + "]" + row;
}

/// The same problems, those of files that were written of arrays with their place in these.
BadDict of_arrays(const BadDict& bad, const py::dict& written) {
  std::vector<input::Problem> problems = bad.problems();
  BadDict::Paths paths = bad.paths();
  for (std::size_t i = 0; i < problems.size(); ++i) {
    if (!written.contains(problems[i].file)) continue;
    paths[i] = place_in_arrays(problems[i], written[problems[i].file.c_str()]);
    problems[i].file = "dataset";
    problems[i].source_line.clear();
  }
  return {std::move(problems), std::move(paths)};
}

/// Tables at hand go the way of files, so that they are checked as these are.
domain::Dataset dataset_of(const py::object& from, const std::filesystem::path& folder) {
  if (!py::isinstance<py::dict>(from)) return read_dataset(from, folder);
  const py::tuple made =
      of_package("tables", "with_files")(from);  // the folder of the files, what is in them
  try {
    domain::Dataset data = read_dataset(made[0], folder);
    made[1].attr("cleanup")();
    return data;
  } catch (const BadDict& bad) {
    made[1].attr("cleanup")();
    throw of_arrays(bad, made[2]);
  } catch (...) {
    made[1].attr("cleanup")();
    throw;
  }
}

/// What a pickle of a scenario has: its fields, and what is not among them. Files that it names are read
/// again.
py::tuple pickled_scenario(const Scenario& scenario) {
  py::list inputs;
  for (const domain::InputFile& input : scenario.what.inputs)
    inputs.append(py::make_tuple(input.name, input.sha256));
  return py::make_tuple(input::scenario_json(scenario.what).dump(), scenario.folder.string(),
                        scenario.what.name, inputs, scenario.warnings);
}

Scenario unpickled_scenario(const py::tuple& state) {
  std::vector<input::Problem> warned;
  Scenario scenario{{}, state[1].cast<std::string>(), state[4].cast<std::vector<std::string>>()};
  scenario.what =
      input::read_scenario(input::Source("scenario", state[0].cast<std::string>(), scenario.folder), warned);
  scenario.what.name = state[2].cast<std::string>();
  scenario.what.inputs.clear();
  for (const auto& input : state[3].cast<py::list>()) {
    const auto pair = input.cast<py::tuple>();
    scenario.what.inputs.push_back({pair[0].cast<std::string>(), pair[1].cast<std::string>()});
  }
  return scenario;
}

}  // namespace

void add_inputs(py::module_& module) {
  py::class_<Rig> rigs(module, "Rig", "A rig and how its equations are solved, as a rig file describes it.");
  never_changes(rigs);
  rigs.def(py::pickle([](const Rig& it) { return py::make_tuple(fields_of(it.file)); },
                      [](const py::tuple& state) { return rig_of(from_json(state[0].cast<std::string>())); }))
      .def(py::init(&rig_of), py::arg("source") = "thesis", py::arg("folder") = ".",
           "A shipped rig by its name, a rig file by its path, or a dict of what would stand in one. "
           "Relative paths in a dict start at `folder`. Raises InputError, MissingInput.")
      .def(
          "to_dict", [](const Rig& rig) { return from_json(fields_of(rig.file)); },
          "Every field, as a rig file has it: quantities with their units. Reads back to the same bits.")
      .def(
          "to_yaml", [](const Rig& rig) { return input::to_yaml(input::rig_json(rig.file)); },
          "The same as the text of a rig file.")
      .def(
          "dac_output",
          [](const Rig& rig, double wanted) { return plant::dac_output_mA(rig.file.dac, wanted); },
          py::arg("wanted"), "The command as the rig's DAC gives it.")
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
          "usual_load_kg", [](const Rig& rig) { return domain::usual_load_kg(rig.file); },
          "A load that full pressure lifts about halfway [kg].")
      .def_property_readonly(
          "command_range",
          [](const Rig& rig) {
            return std::make_pair(rig.file.valve.zero_command, rig.file.valve.span_command);
          },
          "Ends of the valve's line: no pressure, and most of it.")
      .def_property_readonly(
          "opposite_command_range",
          [](const Rig& rig) -> std::optional<std::pair<double, double>> {
            const plant::Pair* const pair = rig.file.pair();
            if (pair == nullptr) return {};
            return std::pair(pair->opposite.valve.zero_command, pair->opposite.valve.span_command);
          },
          "The same of muscle 2; None of one muscle.")
      .def_property_readonly(
          "current_range_mA",
          [](const Rig& rig) {
            const auto& valve = rig.file.valve;
            return std::make_pair(*either<double>({}, valve.zero_command, valve.command_unit),
                                  valve.span_command);
          },
          "The same of a valve that takes mA.")
      .def_property_readonly("_position_noise", [](const Rig& rig) { return run::position_noise(rig.file); })
      .def(
          "_beyond_e_max",
          [](const Rig& rig, double ratio) {
            const plant::Pair* const pair = rig.file.pair();
            const auto impossible = [](const plant::Muscle& muscle, double at) {
              return plant::danger_of(muscle, at) == plant::Danger::impossible;
            };
            if (impossible(rig.file.muscle, ratio)) return true;
            if (pair == nullptr) return false;
            const plant::Muscle& two = pair->opposite.muscle;  // pays out what the first pulls in
            const double way_m = (ratio - pair->contraction_ratio) * rig.file.muscle.rest_length_m;
            return impossible(two, pair->opposite_contraction_ratio - way_m / two.rest_length_m);
          },
          py::arg("contraction_ratio"))
      .def(
          "_load_within",
          [](const Rig& rig, double load_kg, const std::string& name) {
            return load_within(load_kg, rig.file, name);
          },
          py::arg("load_kg"), py::arg("name"),
          "A load that can hang on it. Raises ValueError with this name.")
      .def(
          "__eq__",
          [](const Rig& a, const py::object& b) {
            return py::isinstance<Rig>(b) && fields_of(a.file) == fields_of(b.cast<const Rig&>().file);
          },
          py::is_operator())
      .def("__repr__", &repr_of_rig);

  py::class_<Scenario> scenarios(
      module, "Scenario", "Which rig lifts which loads along which target, or two currents of a pair.");
  never_changes(scenarios);
  scenarios.def(py::pickle(&pickled_scenario, &unpickled_scenario))
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
          "rig", [](const Scenario& s) { return Rig{s.what.rig}; }, "Its rig.")
      .def_property_readonly(
          "target", &sampled_target,
          "Contraction ratio that is wanted at each tick [1], shape (ticks,); of a lever or a pair the angle "
          "[rad]; None where it has not one target.")
      .def_readonly("warnings", &Scenario::warnings, "What its reader warned of.")
      .def("__repr__", &repr_of_scenario);

  py::class_<domain::Dataset, std::shared_ptr<domain::Dataset>> datasets(
      module, "Dataset", "Measured runs, and the rig they are of.");
  never_changes(datasets);
  datasets
      .def(py::init([](const py::object& from, const std::filesystem::path& folder) {
             return std::make_shared<domain::Dataset>(dataset_of(from, folder));
           }),
           py::arg("source"), py::arg("folder") = ".",
           "A data set by its folder or its file, or a dict of what would stand in that (docs/datasets.md), "
           "in "
           "which a run may have `data` in place of `file`: its columns as arrays, in a dict, a structured "
           "array or a DataFrame. Raises InputError, MissingInput.")
      .def_property_readonly(
          "rig", [](const domain::Dataset& data) { return Rig{data.rig}; }, "The nominal rig.")
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
