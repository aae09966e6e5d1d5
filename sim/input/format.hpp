// Formats of measured tables: the ending of a file's name tells which.
#pragma once

#include <optional>
#include <string>

namespace mckibben::input {

enum class Format { csv, lvm, mat, ascii };

/// None if the ending tells no format.
std::optional<Format> format_of(const std::string& file);

/// What is said then.
inline constexpr const char* format_rule =
    "its ending must tell its format: .csv, .lvm, .mat, or .txt, .dat, .asc for numbers without headings";

}  // namespace mckibben::input
