// Formatting, ordering and throwing of input problems; see the header.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <ranges>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include <sim/input/diagnostics.hpp>
#include <sim/input/utf8.hpp>

namespace mckibben::input {
namespace {

// A file of garbage must not drown the reader, nor memory.
constexpr std::size_t most_shown = 100, most_alike = 20;  // as of a table
constexpr std::size_t longest_line_shown = 400, longest_message = 1000;

/// Blanks as wide as the characters before `column`; tabs stay tabs, so the caret meets its character.
std::string padding(const std::string& line, std::size_t column) {
  std::string spaces;
  std::size_t characters = 0;
  for (const char c : line) {
    if (is_utf8_continuation(c)) continue;
    if (++characters >= column) return spaces;
    spaces += c == '\t' ? '\t' : ' ';
  }
  while (++characters < column) spaces += ' ';
  return spaces;
}

std::string without_numbers(std::string text) {
  constexpr std::string_view of_numbers = "0123456789.-+e";
  std::erase_if(text, [&](char c) { return of_numbers.find(c) != std::string_view::npos; });
  return text;
}

/// What is wrong, whatever the numbers.
std::size_t kind_of(const Problem& problem) {
  const auto severity = static_cast<int>(problem.severity);
  return std::hash<std::string>{}(
      fmt::format("{}\n{}\n{}", problem.file, severity, without_numbers(problem.message)));
}

}  // namespace

std::string where(const Problem& problem) {
  if (problem.place.line == 0) return problem.file;
  return fmt::format("{}:{}:{}", problem.file, problem.place.line, problem.place.column);
}

std::string to_text(const Problem& problem) {
  const char* kind = problem.severity == Severity::warning ? "warning" : "error";
  std::string text = fmt::format("{}: {}: {}", where(problem), kind, problem.message);
  if (problem.place.line == 0 || problem.source_line.empty()) return text;
  return text + '\n' + problem.source_line + '\n' + padding(problem.source_line, problem.place.column) + '^';
}

std::string to_text(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_text(problem);
  }
  return text;
}

void Problems::error(const Source& source, Place place, std::string message, bool of_column) {
  add(Severity::error, source, place, std::move(message), of_column);
}

void Problems::unknown_key(const Source& source, Place place, const std::string& key, std::string message) {
  add(Severity::error, source, place, std::move(message), false, key);
}

void Problems::known_at_top(const Source& source, std::span<const std::string_view> keys) {
  for (Problem& problem : list_)
    if (problem.file == source.name() && std::ranges::find(keys, problem.unknown) != keys.end())
      problem.message += fmt::format("; {} goes at the top of the file, not here", problem.unknown);
}

void Problems::missing_file(const Source& source, Place place, std::string message) {
  add(Severity::missing_file, source, place, std::move(message));
}

void Problems::warning(const Source& source, Place place, std::string message) {
  add(Severity::warning, source, place, std::move(message));
}

void Problems::join_columns() {
  struct Alike {
    std::size_t first;
    std::vector<std::string> more;
  };
  std::map<std::string, Alike> columns;
  std::vector<Problem> kept;
  for (Problem& problem : list_) {
    const auto [found, is_new] = columns.try_emplace(
        problem.of_column ? without_numbers(problem.message) : "", Alike{kept.size(), {}});
    if (problem.of_column && !is_new)
      found->second.more.push_back(std::filesystem::path(problem.file).filename().string());
    else
      kept.push_back(std::move(problem));
  }
  for (const auto& [message, alike] : columns)
    if (const auto& more = alike.more; !more.empty())
      kept[alike.first].message += fmt::format("; the same in {} more: {}{}", more.size(), more.front(),
                                               more.size() > 1 ? " to " + more.back() : "");
  list_ = std::move(kept);
}

void Problems::adopt(const std::vector<Problem>& found) {
  for (const Problem& problem : found) add(problem);
}

void Problems::add(Severity severity, const Source& source, Place place, std::string message, bool of_column,
                   std::string unknown) {
  std::string_view line = source.line(place.line);
  if (line.size() > longest_line_shown || printable(line) != line) line = {};
  place.line = source.line_in_file(place.line);
  message = printable(shortened(message, longest_message));
  add({severity, source.name(), place, std::move(message), std::string(line), of_column, std::move(unknown)});
}

void Problems::add(Problem problem) {
  if (problem.severity != Severity::warning) ++errors_;
  if (problem.severity == Severity::missing_file) ++missing_;
  const std::size_t kind = kind_of(problem);
  const auto whole =
      fmt::format("{} {} {} {}", problem.place.line, problem.place.column, kind, problem.message);
  if (!seen_.insert(std::hash<std::string>{}(whole)).second || ++how_many_[kind] > most_alike) return;
  if (list_.size() < most_shown)
    list_.push_back(std::move(problem));
  else
    ++not_kept_;
}

std::vector<Problem> Problems::sorted() const {
  // Files keep the order in which their first problem was found.
  std::vector<std::string> files;
  for (const Problem& problem : list_)
    if (std::find(files.begin(), files.end(), problem.file) == files.end()) files.push_back(problem.file);
  const auto rank = [&](const Problem& problem) {
    return std::tuple(std::find(files.begin(), files.end(), problem.file), problem.place.line,
                      problem.place.column);
  };
  std::vector<Problem> result = list_;
  std::stable_sort(result.begin(), result.end(),
                   [&](const Problem& left, const Problem& right) { return rank(left) < rank(right); });
  std::unordered_set<std::size_t> last;
  for (Problem& problem : std::views::reverse(result)) {
    const std::size_t kind = kind_of(problem);
    const auto many = how_many_.find(kind);
    if (many != how_many_.end() && many->second > most_alike && last.insert(kind).second)
      problem.message += fmt::format("; and {} more like it", many->second - most_alike);
  }
  if (not_kept_ > 0) {
    Problem rest = result.back();
    rest.message = fmt::format("and {} more problems", not_kept_);
    result.push_back(std::move(rest));
  }
  return result;
}

std::vector<Problem> Problems::warnings() const {
  std::vector<Problem> result = sorted();
  std::erase_if(result, [](const Problem& problem) { return problem.severity != Severity::warning; });
  return result;
}

void Problems::raise() const {
  if (errors_ == 0) return;
  if (errors_ == missing_) throw MissingInput(to_text(sorted()));
  throw BadInput(sorted());
}

void Problems::raise(std::vector<InputFile>& inputs, std::vector<Problem>* warnings) const {
  raise();
  std::ranges::copy(inputs_, std::back_inserter(inputs));
  if (warnings != nullptr) std::ranges::move(this->warnings(), std::back_inserter(*warnings));
}

void read_together(std::initializer_list<std::pair<std::string_view, std::function<void()>>> inputs) {
  Problems problems;
  std::vector<Problem> missing;
  for (const auto& [called, read] : inputs) try {
      read();
    } catch (const BadInput& bad) {
      problems.adopt(bad.problems());
    } catch (const MissingInput& error) {
      missing.push_back({Severity::missing_file, std::string(called), nowhere, error.what(), ""});
    }
  if (missing.size() == 1 && problems.errors() == 0) throw MissingInput(missing.front().message);
  problems.adopt(missing);
  problems.raise();
}

}  // namespace mckibben::input
