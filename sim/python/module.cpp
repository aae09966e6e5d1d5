// The module, and what its files share.
#include <utility>

#include <sim/python/module.hpp>

namespace mckibben::python {

py::object from_json(const std::string& document) {
  return py::module_::import("json").attr("loads")(document);
}

py::object of_package(const char* file, const char* function) {
  return py::module_::import((std::string("mckibben.") + file).c_str()).attr(function);
}

namespace {

/// Of the innermost frame outside this package, as warnings count them.
py::ssize_t level_of_caller() {
  py::ssize_t level = 1;
  py::object frame = py::module_::import("sys").attr("_getframe")();
  for (; !frame.is_none(); frame = frame.attr("f_back"), ++level) {
    const auto name = py::str(frame.attr("f_globals").attr("get")("__name__", "")).cast<std::string>();
    if (name != "mckibben" && !name.starts_with("mckibben.")) return level;
  }
  return 1;
}

}  // namespace

void warn(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return;
  const py::object category = of_package("errors", "InputWarning");
  const py::ssize_t level = level_of_caller();
  for (const std::string& text : warnings)
    if (PyErr_WarnEx(category.ptr(), text.c_str(), level) != 0) throw py::error_already_set();
}

py::array_t<double> view(const double* first, std::vector<py::ssize_t> shape,
                         std::vector<py::ssize_t> strides_in_bytes, const py::handle& owner) {
  py::array_t<double> array(std::move(shape), std::move(strides_in_bytes), first, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

}  // namespace mckibben::python

PYBIND11_MODULE(_core, module) {
  using namespace mckibben::python;
  module.doc() = "The compiled part of mckibben.";
  module.attr("version") = MCKIBBEN_VERSION;
  add_errors(module);
  add_inputs(module);
  add_recordings(module);
  add_jobs(module);
  add_findings(module);
  add_rides(module);
  add_batch(module);
  add_keywords(module);
}
