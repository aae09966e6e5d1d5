// Values of a .tdms that were saved as a card counts.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mckibben::formats {

/// What a file says of its channels, of a group or of itself.
struct Properties {
  std::map<std::string, double, std::less<>> numbers{};
  std::map<std::string, std::string, std::less<>> texts{};

  double number(std::string_view name, double otherwise = 0.0) const {
    const auto found = numbers.find(name);
    return found == numbers.end() ? otherwise : found->second;
  }
  std::string text(std::string_view name) const {
    const auto found = texts.find(name);
    return found == texts.end() ? "" : found->second;
  }
};

/// Brings them from counts to their unit: by the scale with the greatest number, of that before it which it
/// names, or of the counts (`NI_Scale[1]_...`, as DAQmx writes them). Throws BadFile for kinds other than
/// linear and polynomial. `said`: by the channel, its group or the file.
void apply_scales(const Properties& said, const std::string& channel, std::vector<double>& values);

}  // namespace mckibben::formats
