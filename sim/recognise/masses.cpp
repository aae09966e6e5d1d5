// Masses in names and lines; see headings.hpp.
#include <algorithm>
#include <cctype>
#include <regex>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/domain/fill_in.hpp>
#include <sim/input/column_hints.hpp>
#include <sim/recognise/headings.hpp>

namespace mckibben::recognise {
namespace {

using input::Words;

bool is_any_of(const std::string& word, const Words& all) {
  return std::ranges::find(all, word) != all.end();
}

bool begins_a_number(const std::string& word) {
  return word.front() >= '0' && word.front() <= '9';
}

/// A mass beside which such a word stands hangs nowhere: the most that may, the next one, the muscle's own.
bool is_of_another(const std::string& before, const std::string& behind) {
  static const Words others{"max",         "maximum",      "maximal", "maximale", "up",       "limit",
                            "rated",       "capacity",     "next",    "cal",      "calib",    "calibrated",
                            "calibration", "kalibrierung", "tare",    "tara",     "muscle",   "muskel",
                            "grease",      "lub",          "tank",    "person",   "operator", "own",
                            "eigen",       "sensor",       "cell"};
  const auto is_other = [](const std::string& word) { return is_any_of(word, others); };
  const std::size_t comma = before.find_last_of(",;");  // what stands before it is about something else
  const Words words = input::words_of(comma == std::string::npos ? before : before.substr(comma + 1)),
              after = input::words_of(behind);
  return std::ranges::any_of(words, is_other) || (!after.empty() && is_other(after[0]));
}

/// 5 in "5 to 20 kg", 20 there, 0.138 in "11 + 0.138 kg".
bool is_a_part(const std::string& before, const std::string& behind) {
  static const std::regex goes_before(R"([0-9] ?(kg|g|lb)? ?(\+|-|\xE2\x80\x93|to|bis|\.\.\.?) ?$)",
                                      std::regex::icase),
      goes_behind(R"(^ ?(\+|-|\xE2\x80\x93|to|bis|\.\.\.?) ?[0-9][0-9.,]* ?(kg|g|lb))", std::regex::icase);
  return std::regex_search(before, goes_before) || std::regex_search(behind, goes_behind);
}

/// What stands around a mass calls it a load, a mass, or nothing.
enum class Called { load, mass, nothing };
Called called(const std::string& before, const std::string& behind) {
  static const Words loads{"load", "loads", "loaded",  "loading", "payload", "last",     "nutzlast",
                           "hung", "hangs", "hanging", "weight",  "weights", "gewicht",  "gewichte",
                           "lift", "lifts", "lifted",  "lifting", "charge",  "suspended"};
  static const Words masses{"m", "mass", "masse"}, between{"is", "of", "von", "mit", "with", "about"};
  Words words = input::words_of(before);
  const Words after = input::words_of(behind);
  if (!words.empty() && is_any_of(words.back(), between)) words.pop_back();
  if (!words.empty() && is_any_of(words.back(), loads)) return Called::load;
  if (!after.empty() && is_any_of(after[0], loads) &&
      (after.size() < 2 || (after[1] != "cell" && !begins_a_number(after[1]))))
    return Called::load;
  const bool mass = !words.empty() && is_any_of(words.back(), masses);
  if (mass && words.size() > 1 && is_any_of(words[words.size() - 2], loads)) return Called::load;
  return words.empty() || (mass && words.size() == 1) ? Called::mass : Called::nothing;
}

void add(std::vector<std::string>& list, const std::string& one) {
  if (std::ranges::find(list, one) == list.end()) list.push_back(one);
}

}  // namespace

Masses masses_in(const std::string& text, bool is_name) {
  static const std::regex number_and_unit(
      R"((^|[^0-9.,])([0-9]{1,6})([.,p]([0-9]{1,6}))?[ _-]?(kg|g|lb)(?![a-zA-Z0-9])(?! ?[/*^]))",
      std::regex::icase);
  Masses found, plain;  // those that a word calls a load, and those that none does
  constexpr std::size_t longest = 500;
  if (text.size() > longest) return found;
  for (std::sregex_iterator at(text.begin(), text.end(), number_and_unit), end; at != end; ++at) {
    const std::smatch& match = *at;
    std::string unit = match[5];
    std::ranges::transform(unit, unit.begin(),
                           [](char c) { return c < 'a' ? static_cast<char>(c + 'a' - 'A') : c; });
    const std::string whole = std::to_string(std::stol(match[2])), fraction = match[4];
    const std::string digits = fraction.substr(0, fraction.find_last_not_of('0') + 1);  // 10.0 kg is 10 kg
    const std::string mass = fmt::format("{}{}{} {}", whole, digits.empty() ? "" : ".", digits, unit);
    constexpr std::size_t of_thousands = 3;
    const bool either = unit == "g" && fraction.size() == of_thousands && match.str(3).front() == ',';
    const auto number_at = static_cast<std::size_t>(match.position(2));
    const std::string before = text.substr(0, number_at), behind = match.suffix();
    // Of a few grams only what stands by itself: run_50g_2, not exp2g nor 10g_shock; 520g_tri is a load.
    constexpr std::size_t of_hundreds = 3;
    const Words after = input::words_of(behind);
    const Words words = input::words_of(before);
    const bool apart = whole.size() >= of_hundreds ||
                       (std::ranges::all_of(words,
                                            [](const std::string& word) {
                                              return begins_a_number(word) || word == "m" || word == "mass" ||
                                                     names_a_run(word);
                                            }) &&
                        (after.empty() || begins_a_number(after[0]) ||
                         names_a_run(after[0].substr(0, after[0].find_first_of("0123456789")))));
    const Called by = called(before, behind);
    const bool doubtful = either || is_of_another(before, behind) || is_a_part(before, behind);
    if (by == Called::load && !doubtful)
      add(found.loads, mass);
    else
      add(!doubtful && (is_name ? unit != "g" || apart : by == Called::mass) ? plain.loads : plain.others,
          mass);
  }
  if (found.loads.empty()) return plain;
  plain.others.insert(plain.others.begin(), plain.loads.begin(), plain.loads.end());
  found.others = std::move(plain.others);
  return found;
}

std::optional<std::string> load_in(const std::string& text) {
  const Masses found = masses_in(text, true);
  if (found.loads.size() != 1) return std::nullopt;
  return found.loads.front();
}

std::optional<LoadGuess> load_of(const UnknownTable& table) {
  if (table.load) return table.load;
  std::vector<std::string> loads, others;
  std::string reason;
  const auto look = [&](const std::string& text, bool is_name, const char* why) {
    const Masses found = masses_in(text, is_name);
    for (const std::string& mass : found.loads) add(loads, mass);
    for (const std::string& mass : found.others) add(others, mass);
    if (!found.loads.empty() && reason.empty()) reason = why;
  };
  look(table.sheet, true, "its sheet's name says so");
  look(table.path.stem().string(), true, "the file's name says so");
  for (const std::string& line : table.remarks) look(line, false, "a line above its headings says so");
  if (loads.empty()) look(table.path.parent_path().filename().string(), true, "the folder's name says so");
  if (loads.size() == 1) return LoadGuess{loads.front(), reason};
  const std::vector<std::string>& several = loads.empty() ? others : loads;
  if (several.empty()) return std::nullopt;
  return LoadGuess{
      std::string(domain::fill_in),
      fmt::format("its name or the lines above it say {}: {} the load?", fmt::join(several, " and "),
                  several.size() == 1 ? "is it" : "which of them is")};
}

}  // namespace mckibben::recognise
