// Each command's keys, in full: one that is missing, unknown or of another kind is an error.
#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include <sim/input/fields_json.hpp>
#include <sim/live/commands.hpp>

namespace mckibben::live {
namespace {

using input::Json;

[[noreturn]] void refuse(const std::string& why) {
  throw std::invalid_argument(why);
}

/// Words of the page as they are shown: what is no text in them, and not all of it.
std::string shown(const Json& value) {
  const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= 40 ? text : text.substr(0, 40) + "...";
}

/// The keys of one command.
class Keys {
 public:
  explicit Keys(const Json& json) : json_(json) {}

  double number(const char* key) { return of(key, &Json::is_number, "a number").get<double>(); }
  /// A whole number; 1 if it is left out.
  std::int64_t which(const char* key) {
    if (!json_.contains(key)) return 1;
    return of(key, &Json::is_number_integer, "a whole number").get<std::int64_t>();
  }
  bool yes(const char* key) { return of(key, &Json::is_boolean, "true or false").get<bool>(); }
  std::string text(const char* key) { return of(key, &Json::is_string, "a text").get<std::string>(); }

  /// No key may be left over.
  void end() const {
    for (const auto& [key, value] : json_.items())
      if (std::ranges::find(seen_, key) == seen_.end())
        refuse(fmt::format("{}: is no key of this command", shown(key)));
  }

 private:
  const Json& of(const char* key, bool (Json::*is)() const, const char* kind) {
    seen_.emplace_back(key);
    const auto found = json_.find(key);
    if (found == json_.end()) refuse(fmt::format("{}: is missing", key));
    if (!((*found).*is)()) refuse(fmt::format("{} = {}: must be {}", key, shown(*found), kind));
    return *found;
  }

  const Json& json_;
  std::vector<std::string> seen_;
};

Sweep sweep_of(Keys& keys) {
  constexpr std::array shapes{std::pair{Sweep::Shape::sine, "sine"},
                              std::pair{Sweep::Shape::triangle, "triangle"},
                              std::pair{Sweep::Shape::stairs, "stairs"}};
  const std::string name = keys.text("shape");
  for (const auto& [shape, word] : shapes)
    if (name == word) return {shape, keys.number("low"), keys.number("high"), keys.number("period")};
  refuse(fmt::format("shape = {}: must be sine, triangle or stairs", shown(name)));
}

Command command_of(const std::string& what, Keys& keys) {
  if (what == "command") return SetCommand{keys.number("to"), keys.which("muscle")};
  if (what == "sweep") return sweep_of(keys);
  if (what == "load") return SetLoad{keys.number("kg")};
  if (what == "effect")
    return SetEffect{keys.text("name"), keys.yes("on"), keys.number("size"), keys.number("shape")};
  if (what == "hide") return HideEffect{keys.text("name"), keys.number("size"), keys.number("shape")};
  if (what == "show") return ShowEffect{};
  if (what == "again") return StartOver{};
  if (what == "run") return SetRunning{keys.yes("on")};
  if (what == "record") return Record{keys.yes("from_rest")};
  if (what == "stop") return StopRecording{};
  refuse(fmt::format("do = {}: must be command, sweep, load, effect, hide, show, again, run, record or stop",
                     shown(what)));
}

}  // namespace

Command read_command(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) refuse("a command is a JSON object, such as {\"do\": \"command\", \"to\": 9.5}");
  Keys keys(json);
  const std::string what = keys.text("do");
  Command command = command_of(what, keys);
  keys.end();
  return command;
}

}  // namespace mckibben::live
