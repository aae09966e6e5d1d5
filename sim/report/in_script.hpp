// JSON inside a page.
#pragma once

#include <string>

#include <sim/input/json.hpp>

namespace mckibben::report {

/// As JSON that can stand inside <script>: no "</script>", no "<!--".
std::string in_script(const input::Json& data);

}  // namespace mckibben::report
