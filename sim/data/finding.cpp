// Findings in words; see the header.
#include <algorithm>
#include <utility>

#include <sim/data/finding.hpp>

namespace mckibben::data {
namespace {

bool is_refused(const Finding& finding) {
  return finding.severity == Severity::refused;
}

std::string lines_of(const std::filesystem::path& path, const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& one : findings) {
    if (!text.empty()) text += '\n';
    text.append(path.string()).append(is_error(one) ? ": error: " : ": warning: ").append(one.message);
  }
  return text;
}

}  // namespace

bool is_error(const Finding& finding) {
  return is_refused(finding) || finding.severity == Severity::unusable;
}

void add(std::vector<Finding>& findings, const std::string& quantity, const std::vector<std::size_t>& runs,
         const std::string& seen, const std::string& so, Severity severity) {
  const auto found = std::ranges::find_if(
      findings, [&](const Finding& one) { return one.severity == severity && one.message.ends_with(so); });
  if (found == findings.end())
    findings.push_back({.quantity = quantity, .runs = runs, .message = seen + so, .severity = severity});
  else
    found->runs.insert(found->runs.end(), runs.begin(), runs.end());
}

std::string text_of(const domain::Dataset& data, const Finding& finding) {
  const std::size_t count = finding.runs.size();
  if (count == 0) return finding.message;
  if (count == data.runs.size() && count > 1) return "all runs: " + finding.message;
  constexpr std::size_t most_shown = 9;
  std::string text = count > 1 ? "runs " : "run ";
  for (std::size_t i = 0; i < std::min(count, most_shown); ++i)
    text.append(i > 0 ? ", " : "").append(data.runs[finding.runs[i]].id);
  if (count > most_shown) text.append(" and ").append(std::to_string(count - most_shown)).append(" more");
  return text.append(": ").append(finding.message);
}

std::string_view consequence_of(const Finding& finding) {
  switch (finding.severity) {
    case Severity::left_out:
      return "; left out";
    case Severity::masked:
      return "; these readings are not used";
    case Severity::ignored:
      return ": the gauge is ignored";
    case Severity::taken_out:
      return "; it was taken out";
    default:
      return "";
  }
}

bool only_limits_diagnosis(const Finding& finding) {
  return finding.told || finding.severity == Severity::unusable ||
         finding.severity == Severity::undecidable || finding.severity == Severity::limited;
}

std::vector<Finding> with_runs_named(const domain::Dataset& data, std::vector<Finding> findings) {
  for (Finding& one : findings) one.message = text_of(data, one);
  return findings;
}

void raise(const domain::Dataset& data, const std::vector<Finding>& findings) {
  if (std::ranges::any_of(findings, is_refused)) throw UnfitData(data, findings);
}
void raise_for_diagnosis(const domain::Dataset& data, const std::vector<Finding>& findings) {
  if (std::ranges::any_of(findings, is_error)) throw UnfitData(data, findings);
}

UnfitData::UnfitData(const domain::Dataset& data, std::vector<Finding> findings)
    : std::runtime_error(lines_of(data.path, with_runs_named(data, findings))),
      path_(data.path),
      findings_(with_runs_named(data, std::move(findings))) {}

}  // namespace mckibben::data
