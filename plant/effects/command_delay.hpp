// Commands are felt late: a bus, a converter or a regulator's own processor takes its time.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct CommandDelayOf {
  static constexpr std::string_view
      name = "command_delay",
      law = "the valve has the command i(t - tau)",
      sentence = "commands reach the valve late, each by the same time",
      source =
          "dead time of a control loop: Astrom & Murray, Feedback Systems, Princeton 2008; also where a "
          "recorder's channels do not begin together";
  static constexpr std::array hooks{Hook::command_delay};
  static constexpr std::array variants{Variant{"", "time", 0.0, 0.03, Sign::positive, 1e-3}};

  P time_s = 0.0;

  static void fields(auto& self, auto& visit) { visit("time", self.time_s, "s", 0.0, 1.0, "tau; 0: absent"); }
  auto absent() const { return time_s == 0.0; }
  P command_delay_s() const { return time_s; }
};
using CommandDelay = CommandDelayOf<double>;

}  // namespace mckibben::plant
