// What is read of the load is late: a sensor that averages or filters, a camera, a recorder's channel that
// begins later than that of the command. A gauge is read at once.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct ReadingDelayOf {
  static constexpr std::string_view
      name = "reading_delay",
      law = "reads x(t - tau)",
      sentence = "the encoder shows late where the load was, always by the same time",
      source =
          "dead time of a control loop: Astrom & Murray, Feedback Systems, Princeton 2008; the delay of a "
          "sensor's filter";
  static constexpr std::array hooks{Hook::reading_delay};
  static constexpr bool in_motion = true;
  static constexpr std::array variants{Variant{"", "time", 0.0, 0.03, Sign::positive, 1e-3}};

  P time_s = 0.0;

  static void fields(auto& self, auto& visit) { visit("time", self.time_s, "s", 0.0, 1.0, "tau; 0: absent"); }
  auto absent() const { return time_s == 0.0; }
  P reading_delay_s() const { return time_s; }
};
using ReadingDelay = ReadingDelayOf<double>;

}  // namespace mckibben::plant
