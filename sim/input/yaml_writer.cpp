// JSON values as YAML text; see the header. Text that YAML could take for something else is written in JSON's
// quotes, which are YAML's too.
#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include <sim/input/number.hpp>
#include <sim/input/yaml_writer.hpp>

namespace mckibben::input {
namespace {

bool is_plain(const std::string& text) {
  constexpr std::string_view other_words[] = {"true", "false", "null", "yes", "no", "on", "off"};
  constexpr std::string_view signs = " ._/()%^-";
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.empty() || text.back() == ' ' || parse_number(text)) return false;
  if (std::find(std::begin(other_words), std::end(other_words), text) != std::end(other_words)) return false;
  const bool is_negative_quantity = text.front() == '-' && text.size() > 1 && is_digit(text[1]);
  if (!is_letter(text.front()) && !is_digit(text.front()) && !is_negative_quantity) return false;
  return std::all_of(text.begin(), text.end(), [&](char c) {
    return is_letter(c) || is_digit(c) || signs.find(c) != std::string_view::npos;
  });
}

std::string scalar(const Json& value) {
  if (value.is_number_float()) return write_number(value.get<double>());
  if (value.is_string() && is_plain(value.get<std::string>())) return value.get<std::string>();
  return value.dump();
}

std::string in_brackets(const Json& list) {
  std::string text;
  for (const Json& each : list) {
    if (!text.empty()) text += ", ";
    text += scalar(each);
  }
  return '[' + text + ']';
}

/// Lines of `value` indented by `indent`; `first` is how the first line begins.
std::string lines(const Json& object, const std::string& indent, std::string first) {
  std::string text;
  for (const auto& [key, value] : object.items()) {
    text += std::exchange(first, indent) + key + ':';
    if (value.is_object() && !value.empty()) {
      text += '\n' + lines(value, indent + "  ", indent + "  ");
    } else if (value.is_array() && !value.empty() && value.front().is_object()) {
      text += '\n';
      for (const Json& each : value) text += lines(each, indent + "    ", indent + "  - ");
    } else {
      text += ' ' + (value.is_array() ? in_brackets(value) : scalar(value)) + '\n';
    }
  }
  return text;
}

}  // namespace

std::string to_yaml(const Json& object) {
  return lines(object, "", "");
}

}  // namespace mckibben::input
