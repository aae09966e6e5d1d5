// The lines that go to and fro between us and a controller in a process of its own: a JSON object out, a JSON
// number back. Numbers are written with as few digits as read back the same, so that nothing is lost.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mckibben::controllers {

/// What is not finite is null.
void append(std::string& text, double value);
void append(std::string& text, std::int64_t value);

/// One object of plain values in one line.
class LineWriter {
 public:
  /// Begins anew; what was written before is gone, its memory is kept.
  void begin() { text_.assign(1, '{'); }
  template <class Value>
  void add(std::string_view key, Value value) {
    open(key);
    if constexpr (std::same_as<Value, bool>)
      text_ += value ? "true" : "false";
    else
      append(text_, value);
  }
  /// Of letters that need no escape.
  void add_text(std::string_view key, std::string_view value) {
    open(key);
    text_.append(1, '"').append(value).append(1, '"');
  }
  /// Any range of numbers.
  void add_list(std::string_view key, const auto& values) {
    open(key);
    text_ += '[';
    for (bool first = true; const double value : values) {
      if (!first) text_ += ',';
      first = false;
      append(text_, value);
    }
    text_ += ']';
  }
  /// Valid until the next `begin`.
  std::string_view end() { return text_ += "}\n"; }

 private:
  void open(std::string_view key);

  std::string text_;
};

/// A line that is a number and nothing else, but for blanks around it.
std::optional<double> number_in(std::string_view line);

/// For a message: quoted, without what is no text or a terminal would not show, cut where it is long.
std::string in_quotes(std::string_view text);

}  // namespace mckibben::controllers
