// A figure of the calibration as a picture and as a table:
// axes with round numbers, dots for data, lines for models.
#pragma once

#include <string>

#include <sim/thesis/figures.hpp>

namespace mckibben::output {

std::string chart_svg(const thesis::Figure& figure);
/// Header on line 1, shortest digits that read back exactly.
std::string csv_of(const thesis::Figure& figure);

}  // namespace mckibben::output
