// What the page asks for, as JSON texts: {"do": "command", "to": 9.5}. A text that is none of these, or that
// asks for what cannot be, is refused with what is wrong with it, and changes nothing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include <sim/live/session.hpp>

namespace mckibben::live {

struct SetCommand {
  double to;
  std::int64_t muscle = 1;  ///< of a pair, 1 or 2
};
struct SetLoad {
  double kg;
};
struct SetEffect {
  std::string name;
  bool on;
  double size, shape;  ///< SI
};
struct HideEffect {  ///< of all effects only this one acts, unseen
  std::string name;
  double size, shape;  ///< SI
};
struct ShowEffect {};
struct StartOver {};
struct SetRunning {
  bool on;  ///< false: time stands still
};
struct Record {
  bool from_rest;  ///< it starts over first
};
struct StopRecording {};

using Command = std::variant<SetCommand, Sweep, SetLoad, SetEffect, HideEffect, ShowEffect, StartOver,
                             SetRunning, Record, StopRecording>;

/// Throws std::invalid_argument, whose text says what is wrong.
Command read_command(std::string_view text);

}  // namespace mckibben::live
