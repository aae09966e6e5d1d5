// Objections in words; see the header.
#include <algorithm>
#include <utility>

#include <sim/domain/objection.hpp>

namespace mckibben::domain {
namespace {

std::string lines_of(const std::filesystem::path& path, const std::vector<Objection>& objections) {
  std::string text;
  for (const Objection& one : objections) {
    if (!text.empty()) text += '\n';
    text.append(path.string()).append(one.certain ? ": error: " : ": warning: ").append(one.message);
  }
  return text;
}

}  // namespace

std::string text_of(const Dataset& data, const Objection& objection) {
  const std::size_t count = objection.runs.size();
  if (count == 0) return objection.message;
  if (count == data.runs.size() && count > 1) return "all runs: " + objection.message;
  constexpr std::size_t most_shown = 9;
  std::string text = count > 1 ? "runs " : "run ";
  for (std::size_t i = 0; i < std::min(count, most_shown); ++i)
    text.append(i > 0 ? ", " : "").append(data.runs[objection.runs[i]].id);
  if (count > most_shown) text.append(" and ").append(std::to_string(count - most_shown)).append(" more");
  return text.append(": ").append(objection.message);
}

std::vector<Objection> with_runs_named(const Dataset& data, std::vector<Objection> objections) {
  for (Objection& one : objections) one.message = text_of(data, one);
  return objections;
}

UnfitData::UnfitData(const Dataset& data, std::vector<Objection> objections)
    : UnfitData(data.path, with_runs_named(data, std::move(objections))) {}

UnfitData::UnfitData(std::filesystem::path path, std::vector<Objection> objections)
    : std::runtime_error(lines_of(path, objections)),
      path_(std::move(path)),
      objections_(std::move(objections)) {}

}  // namespace mckibben::domain
