// The page itself: one HTML file that asks for nothing outside itself and says all it can without scripts.
#pragma once

#include <string>

#include <sim/report/contents.hpp>

namespace mckibben::report {

std::string html_of(const Contents& contents);

}  // namespace mckibben::report
