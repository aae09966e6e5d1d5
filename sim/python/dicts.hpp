// Python's dicts for the readers of files: as the text of a file with a value on each line, so that what is
// wrong has the same rules and words, and the path of its key in place of a line.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <sim/input/source.hpp>
#include <sim/python/module.hpp>

namespace mckibben::python {

/// What is wrong in a dict; problems of files that it names are among them.
class BadDict : public std::runtime_error {
 public:
  /// Of each problem the path of the key ("hose.length"), empty for the whole dict; none of those in files.
  using Paths = std::vector<std::optional<std::string>>;

  BadDict(std::vector<input::Problem> problems, Paths paths);
  const std::vector<input::Problem>& problems() const { return problems_; }
  const Paths& paths() const { return paths_; }

 private:
  std::vector<input::Problem> problems_;
  Paths paths_;
};

/// A dict's text, and the path of the key on each of its lines.
struct DictText {
  std::string name;
  std::string text{};
  std::vector<std::string> paths{};

  /// The path of what a problem is about; none of one in another file.
  std::optional<std::string> path_of(const input::Problem& problem) const;
  /// What a reader found in it.
  [[noreturn]] void refuse(const std::vector<input::Problem>& problems) const;
};

/// `name` is what messages call it; `schema` is put where the dict has none. Throws py::type_error for what
/// no file can hold.
DictText text_of(const py::dict& dict, const std::string& name, const std::string& schema);

/// The bytes of a path, or of whatever names one. Throws py::type_error, py::value_error for what no file can
/// be called.
std::string path_of(const py::object& from);
/// Throws py::type_error for what names no file, and is no dict.
void require_path(const py::object& from, const std::string& name);

/// A value as Python shows it, in a message.
std::string repr_of(const py::handle& value);

/// What `read` makes of a dict's text or of a file. `from`: a dict, or a path; `folder`: where a dict's
/// relative paths start.
template <class FromText, class FromPath>
auto read_either(const py::object& from, const std::filesystem::path& folder, const std::string& name,
                 const std::string& schema, const FromText& from_text, const FromPath& from_path) {
  if (!py::isinstance<py::dict>(from)) {
    require_path(from, name);
    return from_path(path_of(from));
  }
  const DictText dict = text_of(from.cast<py::dict>(), name, schema);
  try {
    return from_text(input::Source(dict.name, dict.text, folder));
  } catch (const input::BadInput& bad) {
    dict.refuse(bad.problems());
  }
}

}  // namespace mckibben::python
