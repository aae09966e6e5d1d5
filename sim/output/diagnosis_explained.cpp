// What explains the data as well; see the header.
#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/output/diagnosis_words.hpp>

namespace mckibben::output {

std::string explained_by(const diagnose::Explanation& explanation) {
  using enum diagnose::Explanation::Kind;
  switch (explanation.kind) {
    case nothing:
      return explanation.effects.empty()
                 ? "nothing: the rig as described"
                 : fmt::format("{} on the rig as described", fmt::join(explanation.effects, " with "));
    case numbers:
      return "other numbers, as far off as is stated";
    case further_numbers:
      return "numbers further off than is stated";
    case law:
      return "a law of force";
    case effects:
      break;
  }
  return fmt::format("{}", fmt::join(explanation.effects, " with "));
}

namespace {

/// What an explanation is made of, a law of force among it.
std::vector<std::string> parts_of(const diagnose::Explanation& one) {
  std::vector<std::string> parts = one.effects;
  if (one.kind == diagnose::Explanation::Kind::law) parts.emplace_back("a law of force");
  return parts;
}

/// Those that `others` lacks.
std::vector<std::string> only_in(const std::vector<std::string>& parts,
                                 const std::vector<std::string>& others) {
  std::vector<std::string> only;
  std::ranges::copy_if(parts, std::back_inserter(only), [&](const std::string& part) {
    return std::ranges::find(others, part) == others.end();
  });
  return only;
}

}  // namespace

std::string explained_as_well_by(const diagnose::Diagnosis& diagnosis,
                                 const diagnose::Explanation& explanation) {
  using enum diagnose::Explanation::Kind;
  const auto chosen = std::ranges::find_if(diagnosis.explanations, &diagnose::Explanation::chosen);
  if (chosen == diagnosis.explanations.end() || diagnosis.verdict == diagnose::Verdict::cannot_tell)
    return explained_by(explanation);
  const auto found = parts_of(*chosen), parts = parts_of(explanation);
  const auto more = only_in(parts, found), less = only_in(found, parts);
  if (less.size() == found.size()) return explained_by(explanation);  // nothing in common
  if (!more.empty() && !less.empty())
    return fmt::format("the same with {} in place of {}", listed(more), listed(less));
  if (!more.empty()) return fmt::format("the same with {}", listed(more));
  if (!less.empty()) return fmt::format("the same without {}", listed(less));
  if (explanation.kind == nothing) return "the same on the rig as described";
  return chosen->kind == nothing ? "the same with other values of the rig's parameters"
                                 : explained_by(explanation);
}

}  // namespace mckibben::output
