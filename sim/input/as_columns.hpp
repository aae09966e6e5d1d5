// Logs whose numbers stand in no columns, as columns: the serial monitor's stamp before each row, a label
// before each number (p:1.2 x=3, JSON), brackets round a row, seconds and nanoseconds apart, ROS messages.
#pragma once

#include <optional>

#include <sim/input/source.hpp>

namespace mckibben::input {

/// None where it is no such log. Lines stay in their places, but for a line of headings before the first row.
std::optional<Source> as_columns(const Source& source);

}  // namespace mckibben::input
