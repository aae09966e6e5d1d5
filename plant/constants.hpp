// Gravity, and what units of the lab are in SI.
#pragma once

#include <numbers>

namespace mckibben::plant {

inline constexpr double gravity_m_per_s2 = 9.80665;
inline constexpr double Pa_per_bar = 1e5;
inline constexpr double degree_rad = std::numbers::pi / 180.0;

}  // namespace mckibben::plant
