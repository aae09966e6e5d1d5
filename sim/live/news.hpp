// What the page is told, as JSON.
#pragma once

#include <string>

#include <sim/input/json.hpp>
#include <sim/live/session.hpp>

namespace mckibben::live {

/// Appends a sample as a list of numbers, in the order of `columns` in scroll.js; what is no number is null.
void append(std::string& text, const Sample& sample, bool of_pair);

input::Json effect_json(const Switch& one);
input::Json sweep_json(const Sweep& sweep);

}  // namespace mckibben::live
