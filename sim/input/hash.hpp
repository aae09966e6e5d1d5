// SHA-256 of input files, so that a result can be traced to exactly what it was computed from (OpenSSL).
#pragma once

#include <string>
#include <string_view>

namespace mckibben::input {

/// The digest in 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace mckibben::input
