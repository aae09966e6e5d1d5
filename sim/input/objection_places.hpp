// Where in its file a data set says what is objected to.
#pragma once

#include <filesystem>
#include <vector>

#include <sim/domain/objection.hpp>
#include <sim/input/diagnostics.hpp>

namespace mckibben::input {

/// The objections at their places in the data set's file, which is read once more: errors if certain,
/// otherwise warnings. Without a place where there is no such file: the data set was made and not read.
std::vector<Problem> problems_of(const std::filesystem::path& path,
                                 const std::vector<domain::Objection>& objections);

}  // namespace mckibben::input
