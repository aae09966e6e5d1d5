// Keywords that a function does not know, refused by name: pybind11 answers them with its signatures.
#include <algorithm>
#include <optional>
#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/input/suggest.hpp>
#include <sim/python/module.hpp>

namespace mckibben::python {
namespace {

using Names = std::vector<std::string>;

/// Arguments of a method, by the signature that its words begin with; nothing where it takes any.
std::optional<Names> arguments_of(const std::string& name, const std::string& words) {
  const std::string signature = words.substr(0, words.find('\n'));
  if (!signature.starts_with(name + "(self: ") || signature.find("**") != std::string::npos) return {};
  Names names;
  const std::regex argument("(\\w+): ");
  for (std::sregex_iterator each(signature.begin(), signature.end(), argument), end; each != end; ++each)
    names.push_back((*each)[1]);
  names.erase(names.begin());  // self
  return names;
}

std::string refusal(const std::string& called, const std::string& keyword, const Names& known) {
  const std::string hint =
      input::did_you_mean(keyword, std::vector<std::string_view>(known.begin(), known.end()));
  return fmt::format("{}: {} is no argument{} {}", called, keyword,
                     hint.empty() ? "; there are" : hint + " There are",
                     known.empty() ? "none" : fmt::to_string(fmt::join(known, ", ")));
}

/// A function, and what it is called by; `def` refers to the texts.
struct Checked {
  py::object function;
  std::string name, words, called;
  Names known;
  PyMethodDef def{};
};

extern "C" PyObject* call_checked(PyObject* self, PyObject* arguments, PyObject* keywords) {
  const auto& checked = *static_cast<const Checked*>(PyCapsule_GetPointer(self, nullptr));
  PyObject *keyword = nullptr, *value = nullptr;
  for (Py_ssize_t at = 0; keywords != nullptr && PyDict_Next(keywords, &at, &keyword, &value) != 0;) {
    const char* const name = PyUnicode_AsUTF8(keyword);
    if (name == nullptr) return nullptr;
    if (std::ranges::find(checked.known, name) != checked.known.end()) continue;
    PyErr_SetString(PyExc_TypeError, refusal(checked.called, name, checked.known).c_str());
    return nullptr;
  }
  return PyObject_Call(checked.function.ptr(), arguments, keywords);
}

/// The same method, but for unknown keywords. In C: pybind11 would take the arguments apart twice.
py::object checked(const py::object& method, const std::string& name, const std::string& called,
                   Names known) {
  auto* const it =
      new Checked{py::reinterpret_borrow<py::object>(PyInstanceMethod_GET_FUNCTION(method.ptr())), name,
                  method.attr("__doc__").cast<std::string>(), called, std::move(known)};
  const py::capsule owner(it, [](void* old) { delete static_cast<Checked*>(old); });
  it->def = {it->name.c_str(), reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&call_checked)),
             METH_VARARGS | METH_KEYWORDS, it->words.c_str()};
  const auto function = py::reinterpret_steal<py::object>(
      PyCFunction_NewEx(&it->def, owner.ptr(), method.attr("__module__").ptr()));
  return py::reinterpret_steal<py::object>(PyInstanceMethod_New(function.ptr()));
}

}  // namespace

void add_keywords(py::module_& module) {
  for (const auto& [key, type] : module.attr("__dict__").cast<py::dict>()) {
    if (PyType_Check(type.ptr()) == 0) continue;
    const auto of = key.cast<std::string>();
    for (const auto& [member, raw] : py::dict(type.attr("__dict__"))) {
      const auto name = member.cast<std::string>();
      const py::object method = type.attr(name.c_str());
      if (PyInstanceMethod_Check(method.ptr()) == 0 || !py::isinstance<py::str>(method.attr("__doc__")))
        continue;
      const auto known = arguments_of(name, method.attr("__doc__").cast<std::string>());
      if (known)
        py::setattr(type, name.c_str(),
                    checked(method, name, name == "__init__" ? of : of + '.' + name, *known));
    }
  }
}

}  // namespace mckibben::python
