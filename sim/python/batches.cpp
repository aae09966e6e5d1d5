// Many rigs that Python steps, as its module's class: batch.hpp is what it does.
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <sim/python/batch.hpp>
#include <sim/python/inputs.hpp>

namespace mckibben::python {

void add_batch(py::module_& module) {
  using Some = std::optional<Batch::Numbers>;
  const auto given = [](const Batch& batch, Some command, Some current_mA) {
    command = either(command, current_mA, batch.command_unit());
    if (!command) throw py::type_error("command is missing");
    return *command;
  };
  py::class_<Batch>(module, "Batch",
                    "Many rigs with a load each, stepped together, each under its own command.")
      .def(py::pickle([](const Batch& batch) { return batch.pickled(); }, &Batch::unpickled))
      .def(py::init([](const py::object& rigs, const py::object& loads_kg, int threads) {
             if (threads < 0)
               throw py::value_error(
                   fmt::format("threads = {}: must be 0, as many as the machine has, or more", threads));
             return std::make_unique<Batch>(rigs, loads_of(loads_kg), static_cast<unsigned>(threads));
           }),
           py::arg("rigs"), py::arg("loads_kg"), py::arg("threads") = 1,
           "One Rig (or what makes one) with a load [kg] each, shape (n,), or a list of n rigs with one "
           "muscle "
           "and the same tick. Eight rigs go through the laws at once where they can; what becomes of one "
           "depends neither on the others nor on threads, to the bit. They stand settled at 0 s, the valves "
           "at "
           "the lower ends of their lines.")
      .def(
          "start",
          [](Batch& batch, Some command, Some current_mA) {
            batch.start(either(command, current_mA, batch.command_unit()));
          },
          py::arg("command") = py::none(), py::kw_only(), py::arg("current_mA") = py::none(),
          "Settled at 0 s under these commands, one or n, in what the rigs' valves take.")
      .def(
          "step",
          [given](Batch& batch, Some command, Some current_mA) {
            batch.step(given(batch, command, current_mA));
          },
          py::arg("command") = py::none(), py::kw_only(), py::arg("current_mA") = py::none(),
          "A tick with these commands, one or n. A rig that cannot go on stays where it came to and is "
          "in `failures`; the others go on.")
      .def(
          "restart",
          [](Batch& batch, const std::vector<std::size_t>& which, const py::object& rigs,
             const py::object& loads_kg, const Some& command) {
            batch.restart(which, rigs, loads_kg.is_none() ? Some() : loads_of(loads_kg), command);
          },
          py::arg("which"), py::arg("rigs") = py::none(), py::arg("loads_kg") = py::none(),
          py::arg("command") = py::none(),
          "Those of these indices begin again and are settled now, the others go on as they were. `rigs`, "
          "`loads_kg`: in place of theirs, one for each; `command`: one or n, of all the batch.")
      .def(
          "follow",
          [given](Batch& batch, Some command, const py::object& progress, Some current_mA) {
            return batch.follow(given(batch, command, current_mA), progress);
          },
          py::arg("command") = py::none(), py::arg("progress") = py::none(), py::kw_only(),
          py::arg("current_mA") = py::none(),
          "A tick for each row of commands, shape (ticks, n), in one call. Gives a dict of time_s "
          "(ticks,), state (ticks, n, 5) and contraction_ratio (ticks, n) as the encoder counts it, each as "
          "it was before the tick, without copies.")
      .def_property_readonly("contraction_ratio", &Batch::contraction_ratio,
                             "As the encoders count it [1], shape (n,).")
      .def_property_readonly(
          "state", &Batch::state,
          "True states, shape (n, 5): contraction ratio [1] and its speed [1/s], valve and "
          "muscle pressure [Pa], bristles [m].")
      .def_property_readonly("failures", &Batch::failures, "Why rigs could not go on, by their index.")
      .def_property_readonly("time_s", &Batch::now_s, "Now [s].")
      .def("__repr__",
           [](const Batch& batch) {
             return fmt::format("<mckibben.Batch at {:.6f} s: {} rigs>", batch.now_s(), batch.rigs());
           })
      .def("__len__", &Batch::rigs);
}

}  // namespace mckibben::python
