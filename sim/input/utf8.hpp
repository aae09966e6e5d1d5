// What of other people's text can be shown; the text of controllers is the first that needs it.
#pragma once

#include <controllers/utf8.hpp>

namespace mckibben::input {

using controllers::printable;
using controllers::shortened;
using controllers::utf8_length;

}  // namespace mckibben::input
