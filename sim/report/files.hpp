// What every report carries: uPlot (third_party/uplot) and our own script and style, which are files of this
// room. They are built into the program by cmake/embed.cmake.
#pragma once

#include <string_view>

namespace mckibben::report {

extern const std::string_view uplot_js, uplot_css, uplot_licence;
extern const std::string_view picture_css, page_css;
extern const std::string_view data_js, plots_js, loops_js, rig_js, pair_js, lever_js, page_js;

}  // namespace mckibben::report
