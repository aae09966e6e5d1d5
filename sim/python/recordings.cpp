// Rows of a recording as NumPy arrays: the names and units of its file.
#include <string_view>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/input/suggest.hpp>
#include <sim/python/dicts.hpp>
#include <sim/python/pickles.hpp>
#include <sim/python/recordings.hpp>

namespace mckibben::python {
namespace {

const plant::Channel& channel_of(const Simulated& run, const std::string& name) {
  for (const plant::Channel& channel : run.channels)
    if (channel.name() == name) return channel;
  if (name.starts_with("target"))
    throw py::key_error(name + ": is no column; it is run.target, a value for each row");
  std::vector<std::string> names;
  for (const plant::Channel& channel : run.channels) names.push_back(channel.name());
  const std::vector<std::string_view> known(names.begin(), names.end());
  const auto best = input::nearest(name, known);
  throw py::key_error(best ? fmt::format("{}: no such column; did you mean {}?", name, *best)
                           : fmt::format("{}: no such column; there are {}", name, fmt::join(names, ", ")));
}

py::dtype type_of(const plant::Channel& channel) {
  return channel.signal->whole ? py::dtype::of<std::int64_t>() : py::dtype::of<double>();
}

py::array column_of(const Simulated& run, const plant::Channel& channel) {
  const auto& samples = run.recording->samples;
  const auto filled = [&](auto column) {
    auto* into = column.mutable_data();
    for (const run::Sample& row : samples)
      *into++ = static_cast<std::decay_t<decltype(*into)>>(channel.value(row));
    return py::array(std::move(column));
  };
  const auto rows = static_cast<py::ssize_t>(samples.size());
  return channel.signal->whole ? filled(py::array_t<std::int64_t>(rows)) : filled(py::array_t<double>(rows));
}

py::array samples_of(const Simulated& run) {
  py::list fields;
  for (const plant::Channel& channel : run.channels)
    fields.append(py::make_tuple(channel.name(), type_of(channel)));
  py::array rows(py::dtype::from_args(fields), static_cast<py::ssize_t>(run.recording->samples.size()));
  for (const plant::Channel& channel : run.channels) rows[channel.name().c_str()] = column_of(run, channel);
  return rows;
}

template <class Value>
py::dict by_column(const Simulated& run, const Value& value) {
  py::dict all;
  for (const plant::Channel& channel : run.channels) all[channel.name().c_str()] = value(channel);
  return all;
}

py::object target_of(const py::object& self) {
  const auto& run = self.cast<const Simulated&>();
  if (!run.target) return py::none();
  const auto rows = static_cast<py::ssize_t>(run.recording->samples.size());  // fewer where it failed
  return view(run.target->data(), {rows}, {sizeof(double)}, self);
}

py::dict gaps_as_dict(const Simulated& run) {
  py::dict all;
  for (const run::Gap& gap : run.gaps) {
    py::dict one;
    one["unit"] = gap.unit;
    one["rmse"] = gap.rmse;
    one["largest"] = gap.largest;
    one["mean"] = gap.mean;
    one["rows"] = gap.rows;
    all[gap.reading.c_str()] = one;
  }
  return all;
}

py::dict solver_of(const Simulated& run) {
  const engine::Counters& did = run.recording->solver;
  py::dict all;
  all["steps"] = did.steps;
  all["rejected_steps"] = did.rejected_steps;
  all["right_hand_sides"] = did.right_hand_sides;
  all["jacobians"] = did.jacobians;
  all["events"] = did.events;
  all["stiff_from_tick"] = did.stiff_from_tick;
  return all;
}

using Pickled = std::tuple<std::string, std::string, std::string, double,
                           std::vector<std::pair<std::string, std::optional<double>>>, py::list, py::list,
                           std::vector<std::tuple<std::string, bool, std::size_t>>, py::bytes>;

/// A channel by its name, whether it is an input (the supply's pressure may be given, or a tank's), and its
/// muscle: where its signal stands among all may change.
plant::Channel channel_of(const std::string& name, bool is_input, std::size_t muscle) {
  for (const plant::Signal& signal : plant::signals) {
    const plant::Channel channel{&signal, muscle};
    const bool of_muscle = muscle == 0 || signal.part == plant::Part::muscle;
    if (of_muscle && is_input == (signal.kind == plant::Kind::input) && channel.name() == name)
      return channel;
  }
  throw py::value_error(name + ": this version has no such column");
}

/// What can be seen of a run.
Pickled pickled_run(const Simulated& run) {
  py::list gaps, findings;
  for (const run::Gap& gap : run.gaps)
    gaps.append(py::make_tuple(gap.reading, gap.unit, gap.rmse, gap.largest, gap.mean, gap.rows));
  for (const auto& finding : run.recording->findings)
    findings.append(py::make_tuple(finding.name, finding.unit, finding.value));
  std::vector<std::tuple<std::string, bool, std::size_t>> channels;
  for (const plant::Channel& channel : run.channels)
    channels.emplace_back(channel.name(), channel.signal->kind == plant::Kind::input, channel.muscle);
  const std::vector<double> target = run.target ? *run.target : std::vector<double>{};
  return {run.name,
          run.controller,
          run.failure,
          run.load_kg,
          run.metrics,
          gaps,
          findings,
          channels,
          bytes_of(run.recording->samples, run.recording->solver, target, run.target != nullptr)};
}

std::shared_ptr<Simulated> unpickled_run(const Pickled& state) {
  const auto& [name, controller, failure, load_kg, metrics, gaps, findings, channels, rows] = state;
  const auto recording = std::make_shared<run::Recording>();
  std::vector<double> target;
  bool has_target = false;
  read_bytes(rows, recording->samples, recording->solver, target, has_target);
  for (const auto& each : findings) {
    const auto [called, unit, value] = each.cast<std::tuple<std::string, std::string, double>>();
    recording->findings.push_back({called, unit, value});
  }
  const auto run = std::make_shared<Simulated>(Simulated{recording, {}, name, controller, failure, load_kg});
  for (const auto& [column, is_input, muscle] : channels)
    run->channels.push_back(channel_of(column, is_input, muscle));
  if (has_target) run->target = std::make_shared<const std::vector<double>>(std::move(target));
  run->metrics = metrics;
  for (const auto& each : gaps) {
    const auto [reading, unit, rmse, largest, mean, count] =
        each.cast<std::tuple<std::string, std::string, double, double, double, std::size_t>>();
    run->gaps.push_back({reading, unit, rmse, largest, mean, count});
  }
  return run;
}

std::string repr_of_run(const Simulated& run) {
  return "<mckibben.Run " + run.name + ": " + std::to_string(run.recording->samples.size()) + " rows" +
         (run.failure.empty() ? ">" : ", failed>");
}

}  // namespace

void add_recordings(py::module_& module) {
  py::class_<Simulated, std::shared_ptr<Simulated>> runs(module, "Run",
                                                         "One simulated run: a row at each tick.");
  never_changes(runs);
  runs.def(py::pickle(&pickled_run, &unpickled_run))
      .def_readonly("name", &Simulated::name, "As files of results call it.")
      .def_readonly("controller", &Simulated::controller, "Name of the controller; empty of a replay.")
      .def_readonly("load_kg", &Simulated::load_kg, "Mass of the load [kg]; 0 where none hangs.")
      .def_property_readonly(
          "failure",
          [](const Simulated& run) -> std::optional<std::string> {
            if (run.failure.empty()) return std::nullopt;
            return run.failure;
          },
          "Why it ends early; None if it does not.")
      .def_property_readonly("samples", &samples_of,
                             "All rows as a structured array, shape (rows,): a copy, with the columns of the "
                             "run's file and more "
                             "(`meanings`).")
      .def(
          "__getitem__",
          [](const Simulated& run, const py::object& name) {
            if (!py::isinstance<py::str>(name))
              throw py::type_error(fmt::format(
                  "run[{0}]: must be the name of a column, such as run['time_s']; run.samples[{0}] has rows",
                  repr_of(name)));
            return column_of(run, channel_of(run, name.cast<std::string>()));
          },
          py::arg("name"), "A column, shape (rows,), in its unit; a copy.")
      .def("__len__", [](const Simulated& run) { return run.recording->samples.size(); })
      .def_property_readonly(
          "units",
          [](const Simulated& run) {
            return by_column(run, [](const plant::Channel& c) { return std::string(c.signal->unit.name); });
          },
          "Unit of each column, as UDUNITS-2 spells it.")
      .def_property_readonly(
          "meanings",
          [](const Simulated& run) {
            return by_column(run, [](const plant::Channel& c) { return c.words(); });
          },
          "The meaning of each column.")
      .def_property_readonly(
          "target", &target_of,
          "What was wanted, shape (rows,): contraction ratio, of a lever or a pair angle [rad]; None "
          "where nothing was; without a copy.")
      .def_property_readonly(
          "metrics",
          [](const Simulated& run) {
            py::dict all;
            for (const auto& [name, value] : run.metrics) all[name.c_str()] = value;
            return all;
          },
          "How well the target was followed, as run.json calls it; None where there is no such number.")
      .def_property_readonly("gaps", &gaps_as_dict,
                             "Of a replay: simulated less measured, for each reading a dict of unit, rmse, "
                             "largest, mean and rows.")
      .def_property_readonly(
          "findings",
          [](const Simulated& run) {
            py::dict all;
            for (const auto& finding : run.recording->findings)
              all[finding.name.c_str()] = py::make_tuple(finding.value, finding.unit);
            return all;
          },
          "What the controller found out: (value, unit) by name.")
      .def_property_readonly("solver", &solver_of, "What the solver did: steps and more, counted.")
      .def(
          "frame", [](const py::object& self) { return of_package("frames", "frame_of")(self); },
          "A pandas DataFrame with a row at each tick, time_s as its index, units in attrs['units'] and "
          "words "
          "in attrs['meanings']. Raises ImportError where pandas is not installed.")
      .def("__repr__", &repr_of_run);
}

}  // namespace mckibben::python
