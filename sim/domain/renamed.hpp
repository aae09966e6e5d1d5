// Keys of files that had another name while every valve took a current. They are still read.
#pragma once

#include <array>
#include <string_view>

namespace mckibben::domain {

struct Renamed {
  std::string_view before, now;
};
inline constexpr std::array renamed{Renamed{"zero_current", "zero_command"},
                                    Renamed{"span_current", "span_command"},
                                    Renamed{"lowest_current", "lowest_command"},
                                    Renamed{"highest_current", "highest_command"},
                                    Renamed{"rest_current", "rest_command"},
                                    Renamed{"largest_current", "largest_command"},
                                    Renamed{"largest_current_speed", "largest_command_speed"}};

/// The key that is written today.
constexpr std::string_view name_today(std::string_view key) {
  for (const Renamed& one : renamed)
    if (one.before == key) return one.now;
  return key;
}

}  // namespace mckibben::domain
