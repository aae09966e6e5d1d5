// Many rigs that Python steps, as its module's class: batch.hpp is what it does.
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <sim/python/batch.hpp>
#include <sim/python/dicts.hpp>

namespace mckibben::python {
namespace {

/// Indices of rigs. Throws py::type_error for what is none, as a mask, whose truths would be 0 and 1.
std::vector<std::size_t> places_of(const py::object& given) {
  const auto array = py::array::ensure(given);
  const bool whole =
      array && array.ndim() == 1 && (array.dtype().kind() == 'i' || array.dtype().kind() == 'u');
  if (!whole && !(array && array.size() == 0))
    throw py::type_error(fmt::format("which = {}: must be indices of rigs, such as [0, 3]", repr_of(given)));
  std::vector<std::size_t> places;
  for (const auto& place : array) {
    const auto index = place.cast<std::int64_t>();
    if (index < 0)
      throw py::index_error(fmt::format("which[{}] = {}: must be 0 or more", places.size(), index));
    places.push_back(static_cast<std::size_t>(index));
  }
  return places;
}

}  // namespace

void add_batch(py::module_& module) {
  using Any = const py::object&;
  const auto some = [](const Batch& batch, Any command, Any current_mA) {
    return either(numbers_of(command, "command", name_of(batch.command_unit())),
                  numbers_of(current_mA, "current_mA", "mA"), batch.command_unit());
  };
  const auto given = [some](const Batch& batch, Any command, Any current_mA) {
    const auto commands = some(batch, command, current_mA);
    if (!commands) throw py::type_error("command is missing");
    return *commands;
  };
  const auto loads_of = [](Any loads_kg) { return numbers_of(loads_kg, "loads_kg", "kg"); };
  const auto jitter_of = [](Any ratios) { return numbers_of(ratios, "jitter", "a contraction ratio"); };
  py::class_<Batch>(module, "Batch",
                    "Many rigs with a load each, stepped together, each under its own command.")
      .def(py::pickle([](const Batch& batch) { return batch.pickled(); }, &Batch::unpickled))
      .def(
          py::init([loads_of, jitter_of](Any rigs, Any loads_kg, Threads threads, Any jitter) {
            const auto loads = loads_of(loads_kg);
            if (!loads) throw py::type_error("loads_kg is missing");
            return std::make_unique<Batch>(rigs, *loads, threads.number, jitter_of(jitter));
          }),
          py::arg("rigs"), py::arg("loads_kg"), py::arg("threads") = Threads{1}, py::kw_only(),
          py::arg("jitter") = py::none(),
          "One Rig (or what makes one) with a load [kg] each, shape (n,), or a list of n rigs with one "
          "muscle "
          "and the same tick. Eight rigs go through the laws at once where they can; what becomes of one "
          "depends neither on the others nor on threads, to the bit. They stand settled at 0 s, the valves "
          "at "
          "the lower ends of their lines. Readings are without the noise of the rigs' sensors; see `jitter`.")
      .def(
          "start",
          [some](Batch& batch, Any command, Any current_mA) {
            batch.start(some(batch, command, current_mA));
          },
          py::arg("command") = py::none(), py::kw_only(), py::arg("current_mA") = py::none(),
          "Settled at 0 s under these commands, one or n, in what the rigs' valves take.")
      .def(
          "step",
          [given](Batch& batch, Any command, Any current_mA) {
            batch.step(given(batch, command, current_mA));
          },
          py::arg("command") = py::none(), py::kw_only(), py::arg("current_mA") = py::none(),
          "A tick with these commands, one or n. A rig that cannot go on stays where it came to and is "
          "in `failures`; the others go on.")
      .def(
          "restart",
          [some, loads_of, jitter_of](Batch& batch, Any which, Any rigs, Any loads_kg, Any command,
                                      Any jitter) {
            batch.restart(places_of(which), rigs, loads_of(loads_kg), some(batch, command, py::none()),
                          jitter_of(jitter));
          },
          py::arg("which"), py::arg("rigs") = py::none(), py::arg("loads_kg") = py::none(),
          py::arg("command") = py::none(), py::kw_only(), py::arg("jitter") = py::none(),
          "Those of these indices begin again and are settled now, the others go on as they were. `rigs`, "
          "`loads_kg`, `jitter`: in place of theirs, one for each; `command`: one or n, of all the batch.")
      .def(
          "follow",
          [given](Batch& batch, Any command, Any progress, Any current_mA) {
            return batch.follow(given(batch, command, current_mA), progress);
          },
          py::arg("command") = py::none(), py::arg("progress") = py::none(), py::kw_only(),
          py::arg("current_mA") = py::none(),
          "A tick for each row of commands, shape (ticks, n), in one call. Gives a dict of time_s "
          "(ticks,), state (ticks, n, 5) and contraction_ratio (ticks, n) as the encoder counts it, each as "
          "it was before the tick, without copies.")
      .def_property_readonly("contraction_ratio", &Batch::contraction_ratio,
                             "As the encoders count it [1], shape (n,).")
      .def_property(
          "jitter", &Batch::jitter,
          [jitter_of](Batch& batch, Any ratios) {
            if (const auto all = jitter_of(ratios)) batch.set_jitter(*all);
          },
          "Of each, as a single one has it; set by one number, or n.")
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
