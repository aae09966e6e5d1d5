// Reads the page of terms; see the header.
#include <algorithm>
#include <cctype>
#include <ranges>
#include <regex>

#include <sim/input/synonyms.hpp>

namespace mckibben::input {
namespace {

std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_token_iterator(text.begin(), text.end(), pattern, 1), std::sregex_token_iterator()};
}

std::vector<Synonym> read(std::string_view page) {
  static const std::regex row(R"(\| (.+) \| (.+) \|)"), link(R"(\[([^\]]*)\]\([^)]*\))"),
      term(" *([^,:]+)[,:]?"), name("`(?:[a-z_]+: )?([^`]+)`");
  std::vector<Synonym> list;
  for (const auto part : std::views::split(page, '\n')) {
    const std::string line(part.begin(), part.end());
    std::smatch cells;
    if (!std::regex_match(line, cells, row) || cells[2] == "here") continue;  // a heading
    const std::string here = std::regex_replace(cells[2].str(), link, "$1");
    for (const std::string& word : matches(cells[1], term))
      list.push_back({spelled_alike(word), here, matches(here, name)});
  }
  return list;
}

}  // namespace

const std::vector<Synonym>& synonyms() {
  static const std::vector<Synonym> list = read(your_words);
  return list;
}

std::string spelled_alike(std::string_view word) {
  std::string text(word);
  for (char& c : text)
    c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

const Synonym* synonym(std::string_view term) {
  const auto& list = synonyms();
  const auto found = std::ranges::find(list, spelled_alike(term), &Synonym::term);
  return found == list.end() ? nullptr : &*found;
}

}  // namespace mckibben::input
