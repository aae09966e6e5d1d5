// A heading that is not there, with the line of `columns` that says where its column stands.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <sim/input/column_units.hpp>

namespace mckibben::input {

/// To hang on the message that a column is not among the headings `found`: which line says where it stands.
std::string hint_of_missing(const WantedColumn& column, std::span<const std::string_view> found);

}  // namespace mckibben::input
