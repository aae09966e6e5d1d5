// The rig of a page in words: what there is of it, how large, and what it has besides the nominal laws.
#pragma once

#include <string>

#include <sim/report/contents.hpp>

namespace mckibben::report {

/// HTML: a list.
std::string rig_html(const Contents& contents);

}  // namespace mckibben::report
