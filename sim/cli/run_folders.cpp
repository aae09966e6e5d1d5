// Run folders read and compared; see the header.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <sim/cli/run_folders.hpp>
#include <sim/domain/number.hpp>
#include <sim/input/cells.hpp>
#include <sim/input/json_file.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/source.hpp>
#include <sim/input/utf8.hpp>

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;
using input::Json;

struct RunFolder {
  fs::path path;
  Json document;
};

[[noreturn]] void refuse(const fs::path& file, input::Place place, const std::string& message) {
  throw input::BadInput({{input::Severity::error, file.string(), place, message, ""}});
}

RunFolder read_folder(const fs::path& path) {
  const fs::path file = path / "run.json";
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw input::MissingInput(path.string() + ": there is no such folder");
  if (!fs::is_directory(path, ignored))
    throw input::MissingInput(path.string() + ": is a file; a folder that run or replay wrote is compared");
  if (!fs::exists(file, ignored))
    throw input::MissingInput(path.string() +
                              ": is not a folder that run or replay wrote: no run.json in it");
  RunFolder folder{path, input::read_json(input::Source::load(file, input::most_json_bytes))};
  const Json& document = folder.document;
  const std::string schema =
      document.is_object() && document.contains("schema") && document.at("schema").is_string()
          ? document.at("schema").get<std::string>()
          : "";
  if (schema != "mckibben-run/1" && schema != "mckibben-replay/1")
    refuse(file, {},
           fmt::format("schema = {} is not what is compared: mckibben-run/1, mckibben-replay/1",
                       schema.empty() ? "nothing" : input::shortened(schema)));
  if (!document.contains("runs") || !document.at("runs").is_array())
    refuse(file, {}, "holds no list of runs");
  return folder;
}

/// What an element of a list is called, if it has a name.
std::string name_of(const Json& element) {
  for (const char* key : {"name", "id", "controller", "file"})
    if (element.is_object() && element.contains(key) && element.at(key).is_string())
      return element.at(key).get<std::string>();
  return "";
}

/// What is inside a value, each under what is to be added to the value's own way.
std::map<std::string, Json> inside(const Json& value) {
  std::map<std::string, Json> parts;
  if (value.is_object())
    for (const auto& [key, inner] : value.items()) parts["." + key] = inner;
  if (!value.is_array()) return parts;
  std::set<std::string> names;
  for (const Json& element : value) names.insert(name_of(element));
  const bool by_name = names.size() == value.size() && !names.contains("");
  for (std::size_t i = 0; i < value.size(); ++i)
    parts[fmt::format("[{}]", by_name ? name_of(value[i]) : std::to_string(i))] = value[i];
  return parts;
}

void compare_values(const Json& left, const Json& right, const std::string& way,
                    std::vector<Difference>& found) {
  if (left == right) return;
  if (left.type() != right.type() || !left.is_structured()) {
    found.push_back({way, left, right});
    return;
  }
  const auto a = inside(left), b = inside(right);
  for (const auto& [key, value] : a) {
    const auto other = b.find(key);
    compare_values(value, other == b.end() ? Json(nullptr) : other->second, way + key, found);
  }
  for (const auto& [key, value] : b)
    if (!a.contains(key)) found.push_back({way + key, nullptr, value});
}

std::vector<Difference> differences(const Json& left, const Json& right, const std::string& way) {
  std::vector<Difference> found;
  compare_values(left, right, way, found);
  if (way.empty())
    for (Difference& one : found) one.key.erase(0, 1);  // its point
  return found;
}

Json part(const Json& document, const char* key) {
  return document.contains(key) ? document.at(key) : Json(nullptr);
}

std::string run_name(const Json& run) {
  if (run.contains("id")) return run.at("id").get<std::string>();
  return fmt::format("{} kg {}", domain::write_kg(run.at("load_kg").get<double>()),
                     run.at("controller").get<std::string>());
}

std::vector<std::string> columns_of(const input::Source& source) {
  input::Problems problems;
  {
    input::TableProblems found(source, problems);
    const std::string_view head = source.line(1);
    const auto count = static_cast<std::size_t>(std::count(head.begin(), head.end(), ',')) + 1;
    if (input::check_text(source, found)) input::check_columns(count, {}, found);
  }
  problems.raise();
  std::vector<std::string> names;
  for (const input::Cell& cell : input::split_cells(source.line(1), ',')) names.emplace_back(cell.text);
  return names;
}

input::Table read_columns(const input::Source& source, const std::vector<std::string>& names) {
  const std::vector<std::string_view> wanted(names.begin(), names.end());
  input::Problems problems;
  input::Table table;
  {
    input::TableProblems found(source, problems);
    table = input::read_table(source, wanted, {}, found);
  }
  problems.raise();
  return table;
}

std::string add_note(const std::string& note, const std::string& more) {
  return note.empty() ? more : note + "; " + more;
}

void compare_tables(const input::Source& left, const input::Source& right, RunDifference& run) {
  const std::vector<std::string> a = columns_of(left), b = columns_of(right);
  std::vector<std::string> common;
  for (const auto& name : a)
    if (std::find(b.begin(), b.end(), name) != b.end()) common.push_back(name);
  if (common.size() != a.size() || common.size() != b.size())
    run.note = add_note(run.note, "not all columns are in both");
  const input::Table one = read_columns(left, common), other = read_columns(right, common);
  const auto *time = one.find("time_s"), *other_time = other.find("time_s");
  if (time == nullptr || other_time == nullptr) {
    run.note = add_note(run.note, "there is no column time_s");
    return;
  }
  const std::size_t rows = std::min(time->values.size(), other_time->values.size());
  if (time->values.size() != other_time->values.size())
    run.note = add_note(run.note, fmt::format("{} and {} rows; the first {} are compared",
                                              time->values.size(), other_time->values.size(), rows));
  for (std::size_t k = 0; k < rows; ++k)
    if (std::abs(time->values[k] - other_time->values[k]) > 1e-6) {
      run.note = add_note(run.note, "the rows are not at the same times");
      return;
    }
  for (const auto& name : common) {
    if (name == "time_s") continue;
    ColumnDifference column{.name = name};
    double squares = 0.0;
    for (std::size_t k = 0; k < rows; ++k) {
      const double off = std::abs(other.find(name)->values[k] - one.find(name)->values[k]);
      squares += off * off;
      if (off > column.largest) {
        column.largest = off;
        column.at_s = time->values[k];
      }
    }
    column.rms = rows == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(rows));
    run.columns.push_back(column);
  }
}

RunDifference compare_run(const RunFolder& left, const Json& a, const RunFolder& right, const Json& b) {
  RunDifference run{.name = run_name(a), .metrics = differences(a, b, ""), .columns = {}, .note = {}};
  for (const auto& [of, folder] : {std::pair{&a, &left}, std::pair{&b, &right}})
    if (of->contains("failure")) run.note = add_note(run.note, "failed in " + folder->path.string());
  if (!a.contains("file") || !b.contains("file")) {
    if (a.contains("file") != b.contains("file")) run.note = add_note(run.note, "its table is in one only");
    return run;
  }
  const std::string file = a.at("file").get<std::string>(), other = b.at("file").get<std::string>();
  if (!file.ends_with(".csv") || !other.ends_with(".csv")) {
    run.note = add_note(run.note, "only tables in CSV are compared");
    return run;
  }
  compare_tables(input::Source::load(left.path / file, input::most_text_bytes),
                 input::Source::load(right.path / other, input::most_text_bytes), run);
  return run;
}

FolderDifference compare(const RunFolder& left, const RunFolder& right) {
  FolderDifference found;
  for (const char* key : {"scenario", "rig", "seed", "tolerance", "program", "input_files"})
    for (auto& one : differences(part(left.document, key), part(right.document, key), key))
      found.inputs.push_back(std::move(one));
  found.tuned = differences(part(left.document, "tuned"), part(right.document, "tuned"), "tuned");
  std::map<std::string, Json> others;
  for (const Json& run : right.document.at("runs")) others[run_name(run)] = run;
  std::set<std::string> met;
  for (const Json& run : left.document.at("runs")) {
    const std::string name = run_name(run);
    const auto other = others.find(name);
    if (other == others.end())
      found.only_left.push_back(name);
    else
      found.runs.push_back(compare_run(left, run, right, other->second));
    met.insert(name);
  }
  for (const Json& run : right.document.at("runs"))
    if (!met.contains(run_name(run))) found.only_right.push_back(run_name(run));
  return found;
}

}  // namespace

const ColumnDifference* RunDifference::find(std::string_view column) const {
  const auto at =
      std::find_if(columns.begin(), columns.end(), [&](const auto& one) { return one.name == column; });
  return at == columns.end() ? nullptr : &*at;
}

bool RunDifference::same() const {
  return note.empty() && metrics.empty() &&
         std::all_of(columns.begin(), columns.end(), [](const auto& one) { return one.largest == 0.0; });
}

bool FolderDifference::same_runs() const {
  return only_left.empty() && only_right.empty() &&
         std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.same(); });
}

bool FolderDifference::within(double tolerance) const {
  return only_left.empty() && only_right.empty() &&
         std::all_of(runs.begin(), runs.end(), [tolerance](const auto& run) {
           const ColumnDifference* ratio = run.find("contraction_ratio");
           return run.same() || (run.note.empty() && ratio != nullptr && ratio->largest <= tolerance);
         });
}

FolderDifference compare_run_folders(const fs::path& left, const fs::path& right) {
  const RunFolder a = read_folder(left), b = read_folder(right);
  const Json &kind = a.document.at("schema"), &other = b.document.at("schema");
  if (kind != other)
    refuse(right / "run.json", {},
           fmt::format("is a result of another kind, {}, than {}, {}", other.get<std::string>(),
                       (left / "run.json").string(), kind.get<std::string>()));
  try {
    return compare(a, b);
  } catch (const Json::exception& error) {
    refuse(left / "run.json", {},
           fmt::format("or that of {} is not as it was written: {}", right.string(), error.what()));
  }
}

}  // namespace mckibben::cli
