// Grouping by kind: the text with every number taken out.
#include <algorithm>
#include <cstddef>
#include <regex>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/data/warnings.hpp>

namespace mckibben::data {
namespace {

constexpr std::string_view beginning = "run ";
constexpr std::size_t most_named = 4;
constexpr std::size_t few = 3;  // each may tell its own numbers

struct Kind {
  std::string without_numbers;
  std::vector<std::string> runs;   ///< empty: of no run
  std::vector<std::string> texts;  ///< of each run, or the one of none

  bool same_numbers() const {
    return std::all_of(texts.begin(), texts.end(), [&](const auto& text) { return text == texts.front(); });
  }
};

std::string without_numbers(const std::string& text) {
  static const std::regex number("-?[0-9][0-9.]*(e[-+]?[0-9]+)?");
  return std::regex_replace(text, number, "#");
}

std::vector<std::string> lines_of(const Kind& kind) {
  if (kind.runs.empty()) return kind.texts;
  std::vector<std::string> names;  // a run may have more than one
  for (const std::string& run : kind.runs)
    if (std::find(names.begin(), names.end(), run) == names.end()) names.push_back(run);
  const bool same = kind.same_numbers();
  if (names.size() == 1 || (!same && kind.texts.size() <= few)) {
    std::vector<std::string> lines;
    lines.reserve(kind.texts.size());
    for (std::size_t i = 0; i < kind.texts.size(); ++i)
      lines.push_back(warning_of_run(kind.runs[i], kind.texts[i]));
    return lines;
  }
  const std::size_t count = names.size();
  const std::string more = count > most_named ? fmt::format(" and {} more", count - most_named) : "";
  names.resize(std::min(count, most_named));
  return {fmt::format("{} runs ({}{}): {}{}", count, fmt::join(names, ", "), more,
                      same ? "" : "for example " + names.front() + ": ", kind.texts.front())};
}

}  // namespace

std::string warning_of_run(std::string_view id, std::string_view text) {
  return fmt::format("{}{}: {}", beginning, id, text);
}

std::vector<std::string> grouped(const std::vector<std::string>& warnings) {
  std::vector<Kind> kinds;
  for (const std::string& warning : warnings) {
    const std::size_t colon = warning.find(": ");
    const bool of_run = warning.starts_with(beginning) && colon != std::string::npos;
    const std::string text = of_run ? warning.substr(colon + 2) : warning;
    const std::string kind = of_run ? without_numbers(text) : text;
    auto same = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& one) {
      return one.runs.empty() != of_run && one.without_numbers == kind;
    });
    if (same == kinds.end()) same = kinds.insert(kinds.end(), Kind{kind, {}, {}});
    const std::string id = of_run ? warning.substr(beginning.size(), colon - beginning.size()) : "";
    bool told = false;
    for (std::size_t i = 0; i < same->texts.size(); ++i)
      told = told || (same->texts[i] == text && (!of_run || same->runs[i] == id));
    if (told) continue;
    if (of_run) same->runs.push_back(id);
    same->texts.push_back(text);
  }
  std::vector<std::string> result;
  for (const Kind& kind : kinds)
    for (const std::string& line : lines_of(kind)) result.push_back(line);
  return result;
}

}  // namespace mckibben::data
