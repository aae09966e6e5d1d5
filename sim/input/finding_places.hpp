// Where in its file a data set says what was found wrong.
#pragma once

#include <filesystem>
#include <vector>

#include <sim/data/finding.hpp>
#include <sim/input/diagnostics.hpp>

namespace mckibben::input {

/// The findings at their places in the data set's file, which is read once more: errors where refused,
/// otherwise warnings. Without a place where there is no such file: the data set was made and not read.
std::vector<Problem> problems_of(const std::filesystem::path& path,
                                 const std::vector<data::Finding>& findings);

}  // namespace mckibben::input
