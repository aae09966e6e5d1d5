// See the header.
#include <algorithm>
#include <cctype>
#include <filesystem>

#include <sim/input/format.hpp>

namespace mckibben::input {

std::optional<Format> format_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".csv" || ending == ".tsv") return Format::csv;
  if (ending == ".lvm") return Format::lvm;
  if (ending == ".mat") return Format::mat;
  if (ending == ".txt" || ending == ".dat" || ending == ".asc") return Format::ascii;
  return std::nullopt;
}

}  // namespace mckibben::input
