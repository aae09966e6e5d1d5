// A rig that Python steps, as its module's class: ride.hpp is what it does.
#include <memory>
#include <string>

#include <fmt/format.h>
#include <pybind11/eigen.h>

#include <sim/python/inputs.hpp>
#include <sim/python/pickles.hpp>
#include <sim/python/ride.hpp>

namespace mckibben::python {
namespace {

py::dict moment_of(const Ride& ride) {
  const auto now = ride.moment();
  py::dict all;
  const auto add = [&](const plant::SideMoment<double>& side, const std::string& suffix) {
    const auto put = [&](const std::string& name, const char* unit, double value) {
      all[(name + suffix + "_" + unit).c_str()] = value;
    };
    put("braid_force", "N", side.braid_force_N);
    put("stop_force", "N", side.stop_force_N);
    put("friction_force", "N", side.friction_force_N);
    put("friction_level", "N", side.friction_level_N);
    put("effects_pull", "N", side.effects_pull_N);
    put(ride.pair() ? "tension" : "force", "N", side.cord_force_N());
    put("supply_flow", "kg_per_s", side.supply_flow);
    put("vent_flow", "kg_per_s", side.vent_flow);
    put("hose_flow", "kg_per_s", side.hose_flow);
    put("leak_flow", "kg_per_s", side.leak_flow);
    put("volume", "m3", side.volume_m3);
  };
  add(now, ride.pair() ? "_1" : "");
  if (ride.pair()) add(now.opposite, "_2");
  all["guide_force_N"] = now.guide_force_N;
  all["acceleration_m_per_s2"] = now.acceleration_m_per_s2;
  return all;
}

template <class Signals>
py::tuple names_of(const Signals& signals) {
  py::list names;
  for (const auto& signal : signals) names.append(py::make_tuple(signal.name, signal.unit));
  return py::tuple(names);
}

void add_linear(py::module_& module) {
  using engine::Linear;
  py::class_<Linear>(module, "Linear",
                     "A rig near a point: dx/dt = rate + A (x - state) + B (u - input), "
                     "y = output + C (x - state) + D (u - input).")
      .def_property_readonly(
          "states", [](const Linear& l) { return names_of(l.states); }, "(name, unit) of each state.")
      .def_property_readonly(
          "inputs", [](const Linear& l) { return names_of(l.inputs); }, "(name, unit) of each input.")
      .def_property_readonly(
          "outputs", [](const Linear& l) { return names_of(l.outputs); }, "(name, unit) of each output.")
      .def_readonly("state", &Linear::state, "x at the point, shape (states,).")
      .def_readonly("rate", &Linear::rate, "dx/dt at the point, shape (states,).")
      .def_readonly("input", &Linear::input, "u at the point, shape (inputs,).")
      .def_readonly("output", &Linear::output, "y at the point, shape (outputs,).")
      .def_readonly("A", &Linear::A, "d(dx/dt)/dx, shape (states, states).")
      .def_readonly("B", &Linear::B, "d(dx/dt)/du, shape (states, inputs).")
      .def_readonly("C", &Linear::C, "dy/dx, shape (outputs, states).")
      .def_readonly("D", &Linear::D, "dy/du, shape (outputs, inputs).");
}

py::tuple pickled_ride(const Ride::Saved& saved) {
  return py::make_tuple(Rig{*saved.rig},
                        bytes_of(saved.ride.rider, saved.ride.pace, saved.counter, saved.drive, saved.begin_s,
                                 saved.ticks, saved.counts, saved.jitter));
}

Ride::Saved unpickled_ride(const py::tuple& state) {
  Ride::Saved saved{std::make_shared<const plant::Rig>(state[0].cast<const Rig&>().file),
                    {},
                    plant::PositionReader(state[0].cast<const Rig&>().file),
                    {},
                    0.0,
                    0,
                    0,
                    0.0};
  read_bytes(state[1], saved.ride.rider, saved.ride.pace, saved.counter, saved.drive, saved.begin_s,
             saved.ticks, saved.counts, saved.jitter);
  return saved;
}

}  // namespace

void add_rides(py::module_& module) {
  add_linear(module);
  py::class_<Shown> reading(module, "Reading", "What instruments show at an instant.");
  never_changes(reading);
  reading
      .def(py::pickle([](const Shown& shown) { return bytes_of(shown); },
                      [](const py::bytes& state) {
                        Shown shown{};
                        read_bytes(state, shown);
                        return shown;
                      }))
      .def_readonly("time_s", &Shown::time_s, "The instant [s].")
      .def_readonly("counts", &Shown::counts, "As the encoder counts.")
      .def_readonly("contraction_ratio", &Shown::contraction_ratio, "By these counts [1]; NaN of a pair.")
      .def_readonly("angle_rad", &Shown::angle_rad, "By these counts [rad]; NaN of one muscle.")
      .def_readonly("gauge_pressure_Pa", &Shown::gauge_pressure_Pa, "As a gauge shows it, or would [Pa].")
      .def_readonly("opposite_gauge_pressure_Pa", &Shown::opposite_gauge_pressure_Pa,
                    "The same of muscle 2; NaN of one muscle.")
      .def("__repr__", [](const Shown& shown) {
        return fmt::format("<mckibben.Reading at {:.6f} s: {} counts>", shown.time_s, shown.counts);
      });
  py::class_<Ride::Saved> saved(module, "SavedRide",
                                "The whole state of a `Ride`; `Ride.restore` continues from it.");
  never_changes(saved);
  saved.def(py::pickle(&pickled_ride, &unpickled_ride));

  using Any = const py::object&;
  const auto given = [](const Ride& ride, Any command, Any opposite_command, Any muscle_pressure_Pa,
                        Any opposite_muscle_pressure_Pa, Any contraction_ratio, Any current_mA,
                        Any opposite_current_mA) {
    const plant::CommandUnit unit = ride.command_unit();
    return Given{
        either(number_of(command, "command", name_of(unit)), number_of(current_mA, "current_mA", "mA"), unit),
        either(number_of(opposite_command, "opposite_command", name_of(unit)),
               number_of(opposite_current_mA, "opposite_current_mA", "mA"), unit),
        number_of(muscle_pressure_Pa, "muscle_pressure_Pa", "Pa"),
        number_of(opposite_muscle_pressure_Pa, "opposite_muscle_pressure_Pa", "Pa"),
        number_of(contraction_ratio, "contraction_ratio", "1")};
  };
  const auto copy = [](const Ride& ride) { return std::make_unique<Ride>(ride); };
  py::class_<Ride>(module, "Ride", "A rig that is stepped from outside.")
      .def(
          py::pickle([](const Ride& ride) { return py::make_tuple(ride.rig(), ride.load_kg(), ride.save()); },
                     [](const py::tuple& state) {
                       auto ride = std::make_unique<Ride>(state[0], state[1].cast<std::optional<double>>());
                       ride->restore(state[2].cast<const Ride::Saved&>());
                       return ride;
                     }))
      .def("__copy__", copy)
      .def(
          "__deepcopy__", [copy](const Ride& ride, const py::dict&) { return copy(ride); }, py::arg("memo"))
      .def(py::init([](const py::object& rig, const py::object& load_kg, double jitter) {
             return std::make_unique<Ride>(rig, number_of(load_kg, "load_kg", "kg"), jitter);
           }),
           py::arg("rig") = "thesis", py::arg("load_kg") = py::none(), py::kw_only(), py::arg("jitter") = 0.0,
           "A Rig, or what makes one, with a load [kg] on it; none on two muscles. It stands settled at 0 s, "
           "its valves at the lower ends of their lines. Its readings are without the noise of the rig's "
           "sensors: that of the position is yours to draw, see `jitter`.")
      .def(
          "start",
          [given](Ride& ride, Any command, Any opposite_command, Any muscle_pressure_Pa,
                  Any opposite_muscle_pressure_Pa, Any contraction_ratio, double at_s, bool settle,
                  Any current_mA, Any opposite_current_mA) {
            ride.start(given(ride, command, opposite_command, muscle_pressure_Pa, opposite_muscle_pressure_Pa,
                             contraction_ratio, current_mA, opposite_current_mA),
                       at_s, settle);
          },
          py::arg("command") = py::none(), py::kw_only(), py::arg("opposite_command") = py::none(),
          py::arg("muscle_pressure_Pa") = py::none(), py::arg("opposite_muscle_pressure_Pa") = py::none(),
          py::arg("contraction_ratio") = py::none(), py::arg("at_s") = 0.0, py::arg("settle") = true,
          py::arg("current_mA") = py::none(), py::arg("opposite_current_mA") = py::none(),
          "At rest, pressures as commanded, the encoder at zero; `settle`: after the rig's settling "
          "time under this input, which ends at `at_s` [s].")
      .def(
          "step",
          [given](Ride& ride, Any command, Any dt_s, Any opposite_command, Any muscle_pressure_Pa,
                  Any opposite_muscle_pressure_Pa, Any contraction_ratio, Any current_mA,
                  Any opposite_current_mA) {
            return ride.step(
                given(ride, command, opposite_command, muscle_pressure_Pa, opposite_muscle_pressure_Pa,
                      contraction_ratio, current_mA, opposite_current_mA),
                number_of(dt_s, "dt_s", "s"));
          },
          py::arg("command") = py::none(), py::arg("dt_s") = py::none(), py::kw_only(),
          py::arg("opposite_command") = py::none(), py::arg("muscle_pressure_Pa") = py::none(),
          py::arg("opposite_muscle_pressure_Pa") = py::none(), py::arg("contraction_ratio") = py::none(),
          py::arg("current_mA") = py::none(), py::arg("opposite_current_mA") = py::none(),
          "Holds a command, in what the rig's valve takes (`Rig.command_unit`), until dt_s [s] later (a tick "
          "if "
          "left out), and gives the Reading there. What is not given stays. A muscle pressure [Pa, gauge] or "
          "a "
          "contraction ratio [1] that is given is reached, straight, at the end of the step; without a valve "
          "then, or on a bench. `current_mA`: the command of a valve that takes mA. Raises NumericalFailure; "
          "the `Ride` is then where it stopped.")
      .def(
          "follow",
          [](Ride& ride, Any command, Any opposite_command, Any current_mA, Any opposite_current_mA) {
            const plant::CommandUnit unit = ride.command_unit();
            const auto one = either(numbers_of(command, "command", name_of(unit)),
                                    numbers_of(current_mA, "current_mA", "mA"), unit);
            if (!one) throw py::type_error("command is missing");
            return ride.follow(*one,
                               either(numbers_of(opposite_command, "opposite_command", name_of(unit)),
                                      numbers_of(opposite_current_mA, "opposite_current_mA", "mA"), unit));
          },
          py::arg("command") = py::none(), py::arg("opposite_command") = py::none(), py::kw_only(),
          py::arg("current_mA") = py::none(), py::arg("opposite_current_mA") = py::none(),
          "A tick for each command, shape (ticks,), in one call: a Run whose rows are what was there before "
          "each tick. Ctrl-C ends it; the `Ride` is then where it stopped.")
      .def("save", &Ride::save, "The whole state.")
      .def("restore", &Ride::restore, py::arg("saved"),
           "Goes on from what was saved, to the same bits. Raises ValueError for what was saved of another "
           "rig.")
      .def("copy", copy, "An independent copy that continues from here.")
      .def(
          "linearise", &Ride::linearise,
          "A, B, C, D at this instant, under what is held: exact, by dual numbers. States: "
          "contraction_ratio, "
          "contraction_speed_per_s, then valve_pressure_Pa, muscle_pressure_Pa, bristle_m of each muscle, "
          "then "
          "what effects remember. Inputs: the command (current_mA, command_V, ...) and its speed of each "
          "muscle, last a force that lifts "
          "the load [N], or a torque [N m]. Outputs: contraction_ratio or angle_rad, then muscle_pressure_Pa "
          "and force_N of the cord, of a pair tension_1_N, tension_2_N. Raises ValueError where there are no "
          "slopes.")
      .def_readwrite("jitter", &Ride::jitter,
                     "Shakes the position before it is counted, as a contraction ratio [1]; for noise set it "
                     "before each step.")
      .def_property_readonly("reading", &Ride::shown, "What instruments show now.")
      .def_property_readonly(
          "time_s", [](const Ride& ride) { return ride.shown().time_s; }, "Now [s].")
      .def_property_readonly(
          "state",
          [](const py::object& self) {
            const auto& ride = self.cast<const Ride&>();
            return view(ride.state(), {ride.pair() ? 8 : 5}, {sizeof(double)}, self);
          },
          "True state, shape (5,), of a pair (8,): contraction ratio [1] and its speed [1/s], then valve "
          "pressure [Pa], muscle pressure [Pa] and bristles [m] of each muscle. The simulator's own memory: "
          "it "
          "changes with every step, copy what you keep.")
      .def_property_readonly("moment", &moment_of, "Forces [N], flows [kg/s] and more at this instant.")
      .def_property_readonly("rig", &Ride::rig, "Its rig.")
      .def("__repr__", [](const Ride& ride) {
        return fmt::format("{} at {:.6f} s: {}>", "<mckibben.Ride", ride.shown().time_s,
                           ride.load_kg() ? fmt::format("{:g} kg", *ride.load_kg()) : "two muscles");
      });
}

}  // namespace mckibben::python
