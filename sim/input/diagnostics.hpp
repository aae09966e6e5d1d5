// What is wrong in an input file, and where: each problem carries its file, line, column and source line and
// prints as compilers do (file, line, excerpt, caret; the idea is Cantera's and GCC's). Problems are
// collected, so that one run shows all of a file's errors;
// warnings are collected beside them and never thrown.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <sim/domain/input_file.hpp>
#include <sim/input/source.hpp>

namespace mckibben::input {

using domain::InputFile;

enum class Severity { error, missing_file, warning };

/// One finding. Line and column count from 1; the column counts characters, not bytes.
struct Problem {
  Severity severity = Severity::error;
  std::string file;
  Place place;
  std::string message;
  std::string source_line;  ///< empty if too long to show
  bool of_column = false;   ///< of a column as a whole, so that other files of its kind have it as well
  std::string unknown{};    ///< a key that is not known here
};

/// `FILE:LINE:COL`, or `FILE` where there is no place.
std::string where(const Problem& problem);

/// `FILE:LINE:COL: error: MESSAGE`, the source line if there is one, and a caret under the column. No
/// newline at the end.
std::string to_text(const Problem& problem);

/// All problems joined, one after the other.
std::string to_text(const std::vector<Problem>& problems);

/// A file that can be read but not used (exit status 65). `what()` is the whole text to show.
class BadInput : public std::runtime_error {
 public:
  explicit BadInput(std::vector<Problem> problems)
      : std::runtime_error(to_text(problems)), problems_(std::move(problems)) {}
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// Collects the findings of one reading, over all files it touches, and which files those are. What is found
/// twice, such as for each of many runs, is kept once.
class Problems {
 public:
  void opened(const Source& source) { inputs_.push_back({source.name(), source.sha256()}); }
  const std::vector<InputFile>& inputs() const { return inputs_; }

  void error(const Source& source, Place place, std::string message, bool of_column = false);
  void unknown_key(const Source& source, Place place, const std::string& key, std::string message);
  /// Of keys that were unknown elsewhere in `source` it is said that they go at its top.
  void known_at_top(const Source& source, std::span<const std::string_view> keys);
  /// A file named in `source` that is not there.
  void missing_file(const Source& source, Place place, std::string message);
  void warning(const Source& source, Place place, std::string message);
  /// Of columns that are wrong alike in several files, the first problem says in which.
  void join_columns();
  /// Takes over what was found while another file was read.
  void adopt(const std::vector<Problem>& found);

  /// How many errors so far, warnings not counted.
  std::size_t errors() const { return errors_; }
  /// Errors and warnings in the order of their place, file by file; of very many, the first hundred found,
  /// and of those of a file that differ in numbers alone the first twenty.
  std::vector<Problem> sorted() const;
  std::vector<Problem> warnings() const;
  /// Throws BadInput with all errors and warnings if there is an error;
  /// MissingInput if only files are missing.
  void raise() const;
  /// The same; else adds the files that were opened and, where asked, the warnings.
  void raise(std::vector<InputFile>& inputs, std::vector<Problem>* warnings = nullptr) const;

 private:
  void add(Severity severity, const Source& source, Place place, std::string message, bool of_column = false,
           std::string unknown = {});
  void add(Problem problem);

  std::vector<Problem> list_;
  std::vector<InputFile> inputs_;
  std::size_t errors_ = 0;
  std::size_t not_kept_ = 0;
  std::unordered_set<std::size_t> seen_;                   ///< by their hashes, for files of nothing else
  std::unordered_map<std::size_t, std::size_t> how_many_;  ///< of those that are alike
  std::size_t missing_ = 0;
};

/// Reads several inputs, each called as messages call it, and throws what is wrong with all of them at once.
void read_together(std::initializer_list<std::pair<std::string_view, std::function<void()>>> inputs);

}  // namespace mckibben::input
