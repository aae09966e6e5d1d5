// What the page carries: script, style and what stands still, which are files of this room
// (cmake/embed.cmake).
#pragma once

#include <string_view>

namespace mckibben::live {

extern const std::string_view live_css, scroll_js, panel_js, live_js, time_html, stage_html;

}  // namespace mckibben::live
