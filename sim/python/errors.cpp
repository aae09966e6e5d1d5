// What C++ throws as Python's exceptions, which stand in mckibben/errors.py.
#include <exception>
#include <utility>

#include <sim/data/finding.hpp>
#include <sim/engine/failure.hpp>
#include <sim/input/quantity.hpp>
#include <sim/python/dicts.hpp>
#include <sim/python/module.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::python {
namespace {

void raise(const py::object& exception) {
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
}

py::object problem_of(const input::Problem& problem, const std::optional<std::string>& path) {
  const char* severity = problem.severity == input::Severity::warning ? "warning" : "error";
  const bool placed = problem.place.line > 0 && !path;
  const auto number = [&](std::size_t value) -> py::object {
    return placed ? py::cast(value) : py::object(py::none());
  };
  return of_package("errors", "Problem")(problem.file, number(problem.place.line),
                                         number(problem.place.column), path, problem.message, severity,
                                         problem.source_line);
}

void raise_input(const std::string& text, const std::vector<input::Problem>& problems,
                 const BadDict::Paths& paths = {}) {
  py::list list;
  bool only_missing = !problems.empty();
  for (std::size_t i = 0; i < problems.size(); ++i) {
    list.append(problem_of(problems[i], paths.empty() ? std::nullopt : paths[i]));
    only_missing = only_missing && problems[i].severity == input::Severity::missing_file;
  }
  raise(of_package("errors", only_missing ? "MissingInput" : "InputError")(text, py::tuple(list)));
}

void raise_unfit(const data::UnfitData& unfit) {
  py::list list;
  for (const auto& finding : unfit.findings())
    list.append(of_package("errors", "Problem")(unfit.path().string(), py::none(), py::none(),
                                                finding.quantity, finding.message, "error", ""));
  raise(of_package("errors", "UnfitData")(unfit.what(), py::tuple(list)));
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const BadDict& bad) {
    raise_input(bad.what(), bad.problems(), bad.paths());
  } catch (const input::BadInput& bad) {
    raise_input(bad.what(), bad.problems());
  } catch (const input::MissingInput& missing) {
    raise(of_package("errors", "MissingInput")(missing.what(), py::tuple()));
  } catch (const input::BadQuantity& bad) {
    raise(of_package("errors", "InputError")(bad.what(), py::tuple()));
  } catch (const data::UnfitData& unfit) {
    raise_unfit(unfit);
  } catch (const engine::NumericalFailure& failure) {
    raise(of_package("errors", "NumericalFailure")(failure.what()));
  } catch (const run::Interrupted&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  }
}

}  // namespace

void add_errors(py::module_&) {
  py::register_local_exception_translator(translate);
}

}  // namespace mckibben::python
