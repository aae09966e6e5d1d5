// Field lists as Markdown tables for the documentation: key, unit, default, range, meaning; a section for
// each struct inside.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <sim/input/field_list.hpp>

namespace mckibben::input {

/// A section titled `title` with the table of `fields`, then the sections of the structs inside, each titled
/// by its path of keys. `level` is the number of # of the title.
std::string field_table(std::string_view title, const std::vector<FieldInfo>& fields, int level = 2);

}  // namespace mckibben::input
