// See the header.
#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include <sim/input/column_hints.hpp>
#include <sim/input/column_units.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/suggest.hpp>

namespace mckibben::input {

using domain::Quantity;

bool is_hump(std::string_view text, std::size_t at) {
  const auto lower = [&](std::size_t k) {
    return k < text.size() && std::islower(static_cast<unsigned char>(text[k])) != 0;
  };
  return at > 1 && std::isupper(static_cast<unsigned char>(text[at])) != 0 && lower(at - 1) &&
         lower(at - 2) && lower(at + 1);
}

Words words_of(std::string_view text) {
  Words words{""};
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    const auto byte = static_cast<unsigned char>(c);
    if (is_hump(text, at) && !words.back().empty()) words.emplace_back();
    if (byte >= 0x80 || std::isalnum(byte) != 0)
      words.back() += byte >= 0x80 ? c : static_cast<char>(std::tolower(byte));
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

const Words time_words{"t",        "time",    "zeit",    "temps", "timestamp", "stamp",  "date",
                       "datetime", "datum",   "uhrzeit", "clock", "elapsed",   "millis", "micros",
                       "sec",      "seconds", "msec",    "usec",  "nsec",      "dt",     "interval"};

bool names_time(std::string_view heading) {
  return std::ranges::any_of(words_of(heading), [](const std::string& word) {
    return std::ranges::find(time_words, word) != time_words.end();
  });
}

const Words duty_words{"duty", "dutycycle", "pwm"}, duty_stems{"tastgrad", "tastverhältnis"};

bool names_duty(std::string_view heading) {
  return std::ranges::any_of(words_of(heading), [](const std::string& word) {
    return std::ranges::find(duty_words, word) != duty_words.end() ||
           std::ranges::any_of(duty_stems, [&](const std::string& stem) {
             return word.starts_with(stem) || word.ends_with(stem);
           });
  });
}

std::string hint_of_missing(const WantedColumn& column, std::span<const std::string_view> found) {
  for (const auto& [commands, name] : names(plant::CommandUnit{}))
    for (const Quantity& quantity : domain::quantities(commands)) {
      if (quantity.column != column.in_file) continue;
      const auto meant = nearest(column.in_file, found);
      const ColumnPlace place{std::string(meant.value_or("NAME")),
                              meant ? fitting_unit(*meant, quantity) : std::string(quantity.unit())};
      return fmt::format("; where it stands under another name, write columns: {{{}}}",
                         line_of(quantity.key, place));
    }
  return "";  // a map has named it
}

}  // namespace mckibben::input
