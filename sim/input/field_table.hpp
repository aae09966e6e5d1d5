// Field lists as Markdown tables for the documentation: key, unit, default, range, meaning; a section for
// each struct inside.
#pragma once

#include <string>
#include <vector>

#include <sim/input/field_list.hpp>

namespace mckibben::input {

/// A section titled `title` with the table of `fields`, then the sections of the structs inside, each titled
/// by its path of keys. A table that has been there before is referred to, and so is that of a rig.
std::string field_table(const std::string& title, const std::vector<FieldInfo>& fields);

}  // namespace mckibben::input
