// The page itself: one HTML file that asks for nothing outside itself and says all it can without scripts.
#pragma once

#include <string>
#include <vector>

#include <sim/report/contents.hpp>

namespace mckibben::report {

std::string html_of(const Contents& contents);

/// Pictures with captions, side by side, or each as wide as the page.
std::string figures_html(const std::vector<Picture>& pictures, bool wide = false);

/// The rig of a page in words: what there is of it, how large, and what it has besides the nominal laws.
std::string rig_html(const Contents& contents);

}  // namespace mckibben::report
