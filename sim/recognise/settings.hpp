// Lines above a table that say something of the recording.
#pragma once

#include <optional>
#include <string_view>

#include <sim/recognise/unknown_table.hpp>

namespace mckibben::recognise {

/// `KP 0.72`, `Fs = 1000 Hz`, `Sample rate;500,000000`; none where a line says no value.
std::optional<Remark> setting_in(std::string_view line);

}  // namespace mckibben::recognise
