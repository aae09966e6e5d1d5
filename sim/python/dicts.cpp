// Values as YAML in its plain part, which JSON is; see the header.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sim/input/limits.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/utf8.hpp>
#include <sim/python/dicts.hpp>

namespace mckibben::python {
namespace {

std::string told(const std::vector<input::Problem>& problems, const BadDict::Paths& paths) {
  std::string text;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    if (i > 0) text += '\n';
    if (!paths[i])
      text += input::to_text(problems[i]);
    else
      text += problems[i].file + ": " + (paths[i]->empty() ? "" : *paths[i] + ": ") + problems[i].message;
  }
  return text;
}

/// A str as UTF-8. Throws UnicodeEncodeError, a ValueError, where it is none.
std::string utf8_of(const py::handle& str) {
  py::ssize_t size = 0;
  const char* const text = PyUnicode_AsUTF8AndSize(str.ptr(), &size);
  if (text == nullptr) throw py::error_already_set();
  return {text, static_cast<std::size_t>(size)};
}

class Writer {
 public:
  explicit Writer(DictText& into) : into_(into) {}

  void map(const py::handle& dict, const std::string& path, const std::string& schema = {}) {
    const Level level(*this, path);
    into_.text += '{';
    bool first = true;
    const auto item = [&](const std::string& key, const py::handle& item_value) {
      const std::string below = path.empty() ? key : path + '.' + key;
      line(first, below);
      into_.text += input::Json(key).dump() + ": ";
      if (key == "points")
        points(item_value, below);
      else
        value(item_value, below);
    };
    if (!schema.empty()) item("schema", py::str(schema));
    for (const auto& [key, item_value] : py::reinterpret_borrow<py::dict>(dict)) {
      if (!py::isinstance<py::str>(key)) throw py::type_error("keys are words, not " + word(key));
      item(utf8_of(key), item_value);
    }
    into_.text += '}';
  }

 private:
  /// One more bracket around what follows. Its reader would refuse as many; a dict in itself has no end.
  class Level {
   public:
    Level(Writer& writer, const std::string& path) : writer_(writer) {
      if (++writer_.depth_ > input::deepest_yaml)
        throw BadDict({{input::Severity::error,
                        writer_.into_.name,
                        {},
                        fmt::format("nested deeper than {} levels", input::deepest_yaml),
                        ""}},
                      {path});
    }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    ~Level() { --writer_.depth_; }

   private:
    Writer& writer_;
  };

  void line(bool& first, const std::string& path) {
    into_.text += first ? "\n" : ",\n";
    into_.paths.push_back(path);
    first = false;
  }

  /// Of a target: an array of two columns, or pairs, are times [s] and values, of an angle in rad.
  void points(const py::handle& given, const std::string& path) {
    const py::object items = plain(given);
    if (!is_list(items)) return value(items, path);
    const std::string to_unit = path.ends_with("angle.points") ? " rad" : "";
    const auto with_unit = [](const py::object& number, const std::string& unit) -> py::object {
      const bool bare = py::isinstance<py::int_>(number) || py::isinstance<py::float_>(number);
      return bare && !unit.empty() ? py::str("{}{}").format(number, unit) : number;
    };
    list(items, path, [&](const py::handle& item, const std::string& below) {
      const py::object point = plain(item);
      if (!is_list(point) || py::len(point) != 2) return value(point, below);
      into_.text += "{\"at\": ";
      value(with_unit(plain(point[py::int_(0)]), " s"), below);
      into_.text += ", \"to\": ";
      value(with_unit(plain(point[py::int_(1)]), to_unit), below);
      into_.text += '}';
    });
  }

  void list(const py::handle& items, const std::string& path) {
    list(items, path, [this](const py::handle& item, const std::string& below) { value(item, below); });
  }
  void list(const py::handle& items, const std::string& path, const auto& write) {
    const Level level(*this, path);
    into_.text += '[';
    bool first = true;
    std::size_t index = 0;
    for (const auto& item : items) {
      const std::string below = path + '[' + std::to_string(index++) + ']';
      line(first, below);
      write(item, below);
    }
    into_.text += ']';
  }

  void value(const py::handle& value_of, const std::string& path) {
    if (py::isinstance<Rig>(value_of)) {
      input::Json rig = input::rig_json(value_of.cast<const Rig&>().file);
      rig.erase("schema");
      map(from_json(rig.dump()), path);
    } else if (py::isinstance<py::dict>(value_of)) {
      map(value_of, path);
    } else if (value_of.is_none()) {
      into_.text += "null";
    } else if (py::isinstance<py::bool_>(value_of)) {
      into_.text += value_of.cast<bool>() ? "true" : "false";
    } else if (py::isinstance<py::str>(value_of)) {
      into_.text += input::Json(utf8_of(value_of)).dump();
    } else if (py::isinstance<py::int_>(value_of)) {
      into_.text += number(value_of, PyLong_Type);
    } else if (py::isinstance<py::float_>(value_of)) {
      into_.text += number(value_of, PyFloat_Type);
    } else if (is_list(value_of)) {
      list(value_of, path);
    } else if (py::hasattr(value_of, "tolist")) {  // NumPy's arrays and numbers
      const Level level(*this, path);
      value(plain(value_of), path);
    } else if (py::hasattr(value_of, "__fspath__")) {
      value(py::str(py::module_::import("os").attr("fspath")(value_of)), path);
    } else {
      throw py::type_error(path + ": no file can hold a " +
                           py::str(py::type::of(value_of).attr("__name__")).cast<std::string>());
    }
  }

  static bool is_list(const py::handle& value) {
    return py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value);
  }
  static py::object plain(const py::handle& value) {
    return py::hasattr(value, "tolist") ? py::object(value.attr("tolist")())
                                        : py::reinterpret_borrow<py::object>(value);
  }

  static std::string word(const py::handle& value) { return py::repr(value).cast<std::string>(); }

  /// As int or float has it, whatever a class that is one of them prints.
  static std::string number(const py::handle& value, const PyTypeObject& type) {
    const auto digits = py::reinterpret_steal<py::object>(type.tp_repr(value.ptr()));
    if (!digits) throw py::error_already_set();
    return utf8_of(digits);
  }

  DictText& into_;
  std::size_t depth_ = 0;
};

}  // namespace

BadDict::BadDict(std::vector<input::Problem> problems, Paths paths)
    : std::runtime_error(told(problems, paths)), problems_(std::move(problems)), paths_(std::move(paths)) {}

void DictText::refuse(const std::vector<input::Problem>& problems) const {
  BadDict::Paths at;
  for (const auto& problem : problems) at.push_back(path_of(problem));
  throw BadDict(problems, at);
}

std::optional<std::string> DictText::path_of(const input::Problem& problem) const {
  const std::size_t line = problem.file == name ? problem.place.line : 0;
  return line > 0 && line <= paths.size() ? std::optional(paths[line - 1]) : std::nullopt;
}

std::string path_of(const py::object& from) {
  std::string path = py::module_::import("os").attr("fsencode")(from).cast<std::string>();
  if (path.find('\0') != std::string::npos) throw py::value_error("a path has no null characters");
  return path;
}

void require_path(const py::object& from, const std::string& name) {
  if (py::isinstance<py::str>(from) && from.contains("\n"))
    throw py::value_error(
        fmt::format("{}: this looks like the text of a file: give the file's path, or its text as a dict "
                    "(yaml.safe_load)",
                    name));
  if (py::isinstance<py::str>(from) || py::isinstance<py::bytes>(from) || py::hasattr(from, "__fspath__"))
    return;
  throw py::type_error(fmt::format("{} = {}: must be a name, a path or a dict", name, repr_of(from)));
}

std::string repr_of(const py::handle& value) {
  return input::shortened(py::repr(value).cast<std::string>());
}

DictText text_of(const py::dict& dict, const std::string& name, const std::string& schema) {
  DictText made{name};
  made.paths.emplace_back();  // the line with the first bracket
  Writer(made).map(dict, "", dict.contains("schema") ? "" : schema);
  made.text += '\n';
  return made;
}

}  // namespace mckibben::python
