// Python's module `mckibben._core`: what each file of this room adds to it, and what they share. People
// import the package `mckibben` (the folder beside), which is made of it; docs/python.md is its page.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <plant/rig.hpp>
#include <sim/input/diagnostics.hpp>

namespace mckibben::python {

namespace py = pybind11;

// In this order: signatures name the classes of those before.
void add_errors(py::module_& module);
void add_inputs(py::module_& module);
void add_recordings(py::module_& module);
void add_jobs(py::module_& module);
void add_findings(py::module_& module);
void add_rides(py::module_& module);
void add_batch(py::module_& module);
/// Last: methods of all before that answer unknown keywords.
void add_keywords(py::module_& module);

/// A rig as it was read.
struct Rig {
  plant::Rig file;
};

/// How many threads may work: 0 is as many as the machine has.
struct Threads {
  unsigned number = 0;
};

/// The document of a result as Python's dicts and lists.
py::object from_json(const std::string& document);

/// A function of the package's own Python files.
py::object of_package(const char* file, const char* function);

/// Tells Python's user, as warnings do.
void warn(const std::vector<std::string>& warnings);

/// Numbers that C++ owns, as a NumPy array without a copy; it keeps `owner` alive and cannot be written.
py::array_t<double> view(const double* first, std::vector<py::ssize_t> shape,
                         std::vector<py::ssize_t> strides_in_bytes, const py::handle& owner);

}  // namespace mckibben::python

/// From an int that is 0 or more; throws py::value_error for others.
template <>
struct pybind11::detail::type_caster<mckibben::python::Threads> {
  PYBIND11_TYPE_CASTER(mckibben::python::Threads, const_name("int"));

  bool load(handle given, bool convert) {
    make_caster<long> whole;
    if (!whole.load(given, convert)) return false;
    const long number = cast_op<long>(whole);
    if (number < 0 || number > std::numeric_limits<int>::max())
      throw value_error("threads = " + std::to_string(number) +
                        ": must be 0, as many as the machine has, or more");
    value.number = static_cast<unsigned>(number);
    return true;
  }
  static handle cast(const mckibben::python::Threads& threads, return_value_policy, handle) {
    return PyLong_FromUnsignedLong(threads.number);
  }
};
