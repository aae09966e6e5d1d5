// UTF-8 by RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace mckibben::controllers {

/// Length of the UTF-8 character at the start of `text`, 0 if it is none (or NUL).
std::size_t utf8_length(std::string_view text);

/// `text` as it can be shown: a ? for each byte that is not UTF-8 and for each control character but tab and
/// line end, with which a file could make a terminal do things.
std::string printable(std::string_view text);

/// `text`, or its beginning and "..." where it has more than `longest` bytes: what a message quotes.
std::string shortened(std::string_view text, std::size_t longest = 60);

}  // namespace mckibben::controllers
