// What the page carries: script and style, which are files of this room (cmake/embed.cmake).
#pragma once

#include <string_view>

namespace mckibben::live {

extern const std::string_view live_css, scroll_js, panel_js, live_js;

}  // namespace mckibben::live
