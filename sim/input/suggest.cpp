// Nearest known word; see the header.
#include <algorithm>
#include <numeric>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/input/suggest.hpp>
#include <sim/input/synonyms.hpp>
#include <sim/input/utf8.hpp>

namespace mckibben::input {

namespace {

constexpr std::size_t longest_word = 100;  // nothing we know is longer; keeps garbage cheap

/// Known words of which it is a part: `length` of rest_length. None of a part that many share.
std::vector<std::string_view> with_part(std::string_view word, std::span<const std::string_view> known) {
  constexpr std::size_t few = 3;
  std::vector<std::string_view> found;
  const std::string part = fmt::format("_{}_", spelled_alike(word));
  for (const std::string_view candidate : known)
    if (candidate != word && fmt::format("_{}_", candidate).find(part) != std::string::npos)
      found.push_back(candidate);
  return found.size() <= few ? found : std::vector<std::string_view>{};
}

/// Known words that end as it does: rest_radius for inner_radius.
std::vector<std::string_view> with_ending(std::string_view word, std::span<const std::string_view> known) {
  const std::size_t at = word.rfind('_');
  return at == std::string_view::npos ? std::vector<std::string_view>{}
                                      : with_part(word.substr(at + 1), known);
}

}  // namespace

std::size_t edit_distance(std::string_view left, std::string_view right) {
  std::vector<std::size_t> two_back(right.size() + 1), back(right.size() + 1), row(right.size() + 1);
  std::iota(back.begin(), back.end(), std::size_t{0});
  for (std::size_t i = 1; i <= left.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= right.size(); ++j) {
      const std::size_t replaced = back[j - 1] + (left[i - 1] == right[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, back[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && left[i - 1] == right[j - 2] && left[i - 2] == right[j - 1])
        row[j] = std::min(row[j], two_back[j - 2] + 1);
    }
    two_back.swap(back);
    back.swap(row);
  }
  return back[right.size()];
}

std::optional<std::string_view> nearest(std::string_view word, std::span<const std::string_view> known) {
  if (word.empty() || word.size() > longest_word) return std::nullopt;
  const std::string wanted = spelled_alike(word);
  std::optional<std::string_view> best;
  std::size_t least = std::max<std::size_t>(1, (word.size() + 2) / 3) + 1;
  for (const std::string_view candidate : known) {
    if (candidate.size() > longest_word) continue;
    const std::size_t distance = std::min(edit_distance(word, candidate), edit_distance(wanted, candidate));
    if (distance < least && distance < candidate.size()) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known) {
  std::vector<std::string_view> meant;
  const Synonym* const term = word.size() > longest_word ? nullptr : synonym(word);
  if (term != nullptr) meant.assign(term->names.begin(), term->names.end());
  std::string verb;  // does in one what here is no key or kind
  for (const std::string_view name : meant)
    if (name.find(" --") != std::string_view::npos) verb = fmt::format(" See also mckibben {}", name);
  std::erase_if(meant, [&](std::string_view name) { return std::ranges::find(known, name) == known.end(); });
  if (meant.empty() && word.size() <= longest_word) meant = with_part(word, known);
  if (!meant.empty()) return fmt::format("; did you mean {}?{}", fmt::join(meant, " or "), verb);
  if (const auto best = nearest(word, known)) return fmt::format("; did you mean {}?", *best);
  if (word.size() <= longest_word) meant = with_ending(word, known);
  if (!meant.empty()) return fmt::format("; did you mean {}?", fmt::join(meant, " or "));
  return term == nullptr ? std::string{} : fmt::format("; that is {}", term->here);
}

std::string join(std::span<const std::string_view> words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string join_few(std::span<const std::string_view> words) {
  constexpr std::size_t most_shown = 20;
  std::vector<std::string> shown;
  for (const std::string_view word : words.first(std::min(words.size(), most_shown)))
    shown.push_back(shortened(word));
  return fmt::format("{}{}", fmt::join(shown, ", "), words.size() > most_shown ? ", ..." : "");
}

}  // namespace mckibben::input
