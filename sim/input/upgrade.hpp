// Files that were written for another version of the program: what in them is to be changed by hand. A file
// says its version in its schema (mckibben-scenario/1); keys may go without a new one, and are told here.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

/// What is to be changed, each as a warning with its place; none if the file is as this version wants it.
/// `schemas`: those that it reads.
std::vector<Problem> to_upgrade(const YamlFile& file, std::span<const std::string_view> schemas);

}  // namespace mckibben::input
