// Rows of a recording as one structured NumPy array in the memory where they are.
#include <sim/python/recordings.hpp>

namespace mckibben::python {
namespace {

using run::Sample;

struct Column {
  const char *name, *unit, *meaning;
  std::ptrdiff_t offset;
  bool whole = false;  ///< an integer
};

template <class T>
Column column(const char* name, const char* unit, const char* meaning, const Sample& row, const T& member) {
  return {name, unit, meaning, reinterpret_cast<const char*>(&member) - reinterpret_cast<const char*>(&row),
          std::is_integral_v<T>};
}

/// Of one muscle; of a pair what is added to that.
std::vector<Column> columns_of(bool pair) {
  static const Sample row{};
  const auto& joint = row.state.joint;
  const auto &side = row.state.side, &other = row.state.opposite;
  std::vector<Column> columns{
      column("time_s", "s", "time", row, row.time_s),
      column("current_mA", "mA", "to the valve, from this row to the next", row, row.current_mA),
      column("contraction_ratio", "1", "e, true", row, joint.contraction_ratio),
      column("contraction_speed_per_s", "s-1", "de/dt, true", row, joint.contraction_speed_per_s),
      column("valve_pressure_Pa", "Pa", "gauge pressure at the valve, true", row, side.valve_pressure_Pa),
      column("muscle_pressure_Pa", "Pa", "gauge pressure in the muscle, true", row, side.muscle_pressure_Pa),
      column("bristle_m", "m", "deflection of the bristles of thread friction, true", row, side.bristle_m),
      column("counts", "1", "as the encoder counts", row, row.counts),
      column("gauge_pressure_Pa", "Pa", "as a gauge shows the muscle's pressure", row, row.gauge_Pa),
      column("braid_force_N", "N", "of the braid, upwards", row, row.braid_force_N),
      column("friction_force_N", "N", "of the threads on the load, upwards", row, row.friction_force_N),
      column("effects_pull_N", "N", "of effects on the load, upwards", row, row.effects_pull_N),
      column("cord_force_N", "N", "what the cord carries", row, row.cord_force_N),
      column("cell_force_N", "N", "as a load cell shows it, if one is fitted", row, row.cell_N)};
  if (!pair) return columns;
  const auto& second = row.opposite;
  const std::vector<Column> more{
      column("current_2_mA", "mA", "to the valve of muscle 2", row, second.current_mA),
      column("contraction_ratio_2", "1", "of muscle 2, true", row, second.contraction_ratio),
      column("valve_pressure_2_Pa", "Pa", "gauge pressure at valve 2, true", row, other.valve_pressure_Pa),
      column("muscle_pressure_2_Pa", "Pa", "gauge pressure in muscle 2, true", row, other.muscle_pressure_Pa),
      column("bristle_2_m", "m", "of muscle 2, true", row, other.bristle_m),
      column("braid_force_2_N", "N", "of braid 2, as it shortens muscle 2", row, second.braid_force_N),
      column("friction_force_2_N", "N", "of threads 2", row, second.friction_force_N),
      column("effects_pull_2_N", "N", "of effects on muscle 2", row, second.effects_pull_N),
      column("cord_force_2_N", "N", "what cord 2 carries", row, second.cord_force_N)};
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

py::dtype dtype_of(const std::vector<Column>& columns) {
  py::list names, formats, offsets;
  for (const Column& column : columns) {
    names.append(column.name);
    formats.append(column.whole ? "i8" : "f8");
    offsets.append(column.offset);
  }
  py::dict fields;
  fields["names"] = names;
  fields["formats"] = formats;
  fields["offsets"] = offsets;
  fields["itemsize"] = sizeof(Sample);
  return py::dtype::from_args(fields);
}

py::array samples_of(const py::object& self) {
  const auto& run = self.cast<const Simulated&>();
  const auto& samples = run.recording->samples;
  py::array rows(dtype_of(columns_of(run.recording->driven.pair)), {static_cast<py::ssize_t>(samples.size())},
                 {static_cast<py::ssize_t>(sizeof(Sample))}, samples.data(), self);
  rows.attr("setflags")(py::arg("write") = false);
  return rows;
}

template <class Value>
py::dict by_column(const Simulated& run, const Value& value) {
  py::dict all;
  for (const Column& column : columns_of(run.recording->driven.pair)) all[column.name] = value(column);
  return all;
}

py::object target_of(const py::object& self) {
  const auto& target = self.cast<const Simulated&>().target;
  if (!target) return py::none();
  return view(target->data(), {static_cast<py::ssize_t>(target->size())}, {sizeof(double)}, self);
}

py::dict gaps_of(const Simulated& run) {
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

std::string repr_of_run(const Simulated& run) {
  return "<mckibben.Run " + run.name + ": " + std::to_string(run.recording->samples.size()) + " rows" +
         (run.failure.empty() ? ">" : ", failed>");
}

}  // namespace

void add_recordings(py::module_& module) {
  py::class_<Simulated, std::shared_ptr<Simulated>>(module, "Run", "One simulated run: a row at each tick.")
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
      .def_property_readonly(
          "samples", &samples_of,
          "All rows as a structured array, shape (rows,), in SI units: the simulator's own "
          "memory, without a copy; it cannot be written. run['muscle_pressure_Pa'] is a "
          "column of it, shape (rows,).")
      .def(
          "__getitem__",
          [](const py::object& self, const std::string& name) {
            const auto& run = self.cast<const Simulated&>();
            for (const Column& known : columns_of(run.recording->driven.pair))
              if (known.name == name) return py::object(samples_of(self)[name.c_str()]);
            throw py::key_error(name);
          },
          py::arg("name"), "A column, shape (rows,), without a copy.")
      .def("__len__", [](const Simulated& run) { return run.recording->samples.size(); })
      .def_property_readonly(
          "units",
          [](const Simulated& run) { return by_column(run, [](const Column& c) { return c.unit; }); },
          "Unit of each column, as UDUNITS-2 spells it.")
      .def_property_readonly(
          "meanings",
          [](const Simulated& run) { return by_column(run, [](const Column& c) { return c.meaning; }); },
          "What each column is, in words.")
      .def_property_readonly("target", &target_of,
                             "Contraction ratio that was wanted, shape (rows,), or None; without a copy.")
      .def_property_readonly(
          "encoder_contraction_ratio",
          [](const py::object& self) {
            const py::object counts = self["counts"];
            return py::object(counts * py::float_(self.cast<const Simulated&>().contraction_per_count));
          },
          "Contraction ratio as the encoder counts it, shape (rows,).")
      .def_property_readonly(
          "metrics",
          [](const Simulated& run) {
            py::dict all;
            for (const auto& [name, value] : run.metrics) all[name.c_str()] = value;
            return all;
          },
          "How well the target was followed, as run.json calls it; None where there is no such number.")
      .def_property_readonly("gaps", &gaps_of,
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
