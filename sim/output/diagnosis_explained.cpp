// What explains the data as well; see the header.
#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/output/diagnosis_words.hpp>

namespace mckibben::output {

namespace {

/// Of general terms, as a search calls them: "waves", all of a kind, or "2 of waves". Empty: it is an effect.
std::string law_in_words(const std::string& name) {
  if (name.ends_with("rubs")) return "friction that depends on the place";
  const auto at = name.find(" of ");
  const std::string count = at == std::string::npos ? "" : name.substr(0, at + 1),
                    ending = count == "1 " ? "" : "s";
  if (name.ends_with("smooth")) return fmt::format("a law of {}smooth term{}", count, ending);
  if (name.ends_with("waves")) return fmt::format("a law of {}wave{} along the stroke", count, ending);
  return "";
}

/// What an explanation is made of, a law of force among it.
std::vector<std::string> parts_of(const diagnose::Explanation& one) {
  if (one.kind != diagnose::Explanation::Kind::law) return one.effects;
  std::vector<std::string> parts;
  std::string of_law = "a law of force";
  for (const std::string& name : one.effects)
    if (std::string words = law_in_words(name); words.empty())
      parts.push_back(name);
    else
      of_law = std::move(words);
  parts.push_back(std::move(of_law));
  return parts;
}

}  // namespace

std::string explained_by(const diagnose::Explanation& explanation) {
  using enum diagnose::Explanation::Kind;
  switch (explanation.kind) {
    case nothing:
      return explanation.effects.empty()
                 ? "nothing: the rig as described"
                 : fmt::format("{} on the rig as described", fmt::join(explanation.effects, " with "));
    case numbers:
      return "other values of the rig's parameters" +
             (explanation.furthest_off.empty() ? "" : fmt::format(" ({})", explanation.furthest_off));
    case law:
      return fmt::format("{}", fmt::join(parts_of(explanation), " with "));
    case effects:
      break;
  }
  return fmt::format("{}", fmt::join(explanation.effects, " with "));
}

namespace {

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
