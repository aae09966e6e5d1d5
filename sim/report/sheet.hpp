// Pictures of a page as a file of their own, for other people's reports.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sim/report/contents.hpp>

namespace mckibben::report {

/// Two side by side, each with its caption above, below a line that tells the lines apart and another of
/// words; empty if there are none. `keys`: class and words of each line. Lengths are in mm.
std::string sheet_svg(const std::vector<Picture>& pictures, double wide_px, double high_px,
                      const std::vector<std::pair<std::string, std::string>>& keys, std::string_view words);

/// Class and words of each line of a group: its runs, as measured before them.
std::vector<std::pair<std::string, std::string>> keys_of(const Group& group, bool measured = true);

}  // namespace mckibben::report
