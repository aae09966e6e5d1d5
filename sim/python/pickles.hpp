// What pickling needs: states as bytes that only this version of the module reads, and copies of what never
// changes, which are the thing itself.
#pragma once

#include <stdexcept>
#include <string>

#include <sim/python/module.hpp>
#include <sim/ride/bytes.hpp>

namespace mckibben::python {

py::bytes bytes_of(const auto&... values) {
  ride::BytesWriter write;
  write(std::string(MCKIBBEN_VERSION), values...);
  return write.closed();
}

/// Throws py::value_error for bytes of another version.
void read_bytes(const py::handle& bytes, auto&... values) {
  const auto text = bytes.cast<std::string>();
  try {
    ride::BytesReader read(text);
    std::string version;
    read(version);
    if (version != MCKIBBEN_VERSION) throw std::runtime_error("pickled by version " + version);
    read(values...);
    read.end();
  } catch (const std::runtime_error& bad) {
    throw py::value_error(bad.what());
  }
}

template <class Class>
void never_changes(Class& of) {
  of.def("__copy__", [](const py::object& self) { return self; });
  of.def(
      "__deepcopy__", [](const py::object& self, const py::dict&) { return self; }, py::arg("memo"));
}

}  // namespace mckibben::python
