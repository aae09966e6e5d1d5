// A filter on what a controller commands: second order, in samples by the bilinear transform whose frequency
// is prewarped (Oppenheim & Schafer, Discrete-Time Signal Processing, 3rd ed. 2010, section 7.2).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include <controllers/current_range.hpp>

namespace mckibben::controllers {

enum class FilterKind { low_pass, notch };
constexpr auto names(FilterKind) {
  using enum FilterKind;
  return std::array{std::pair{low_pass, std::string_view{"low_pass"}},
                    std::pair{notch, std::string_view{"notch"}}};
}

/// w^2/(s^2 + 2 d w s + w^2), or (s^2 + w^2)/(s^2 + 2 d w s + w^2).
struct CommandFilter {
  FilterKind kind = FilterKind::low_pass;
  double frequency_Hz = 1.0;
  double damping = 0.7071;

  static void fields(auto& self, auto& visit) {
    visit.required("kind", self.kind, "low_pass: second order; notch: rejects one frequency");
    visit.required("frequency", self.frequency_Hz, "Hz", 1e-3, 1e4,
                   "f: below half the sampling rate, 1/(2 tick)");
    visit("damping", self.damping, "1", 0.01, 10.0, "d: 0.7071 is Butterworth's; a notch is 2 d f wide");
  }
};

/// y = b0 u + s0; s0' = b1 u - a1 y + s1; s1' = b2 u - a2 y. At rest y = u.
struct Biquad {
  double b0, b1, b2, a1, a2;
};
Biquad biquad_of(const CommandFilter& filter, double tick_s);

/// `inside` with its commands filtered from rest at its first one, each tick, and kept within `limits`.
std::unique_ptr<Controller> filtered(const CommandFilter& filter, const std::optional<CurrentRange>& limits,
                                     double tick_s, std::unique_ptr<Controller> inside);

/// What may become of commands on their way out; nothing unless given.
struct CommandTerms {
  std::optional<double> largest_current_speed_mA_per_s = std::nullopt;
  std::optional<CommandFilter> command_filter = std::nullopt;

  static void fields(auto& self, auto& visit) {
    visit("largest_command_speed", self.largest_current_speed_mA_per_s, "mA/s", 1e-3, 1e6,
          "how fast each command may change; at once if absent");
    visit("command_filter", self.command_filter, "filter on each command; none if absent");
  }
};

}  // namespace mckibben::controllers
