// SHA-256 of input files, so that a result can be traced to exactly what it was computed from (OpenSSL).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace mckibben::input {

/// Of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  void add(std::string_view bytes);
  /// Of all that was added; to be asked once.
  std::string hex();

 private:
  std::unique_ptr<void, void (*)(void*)> context_;
};

/// Bytes behind their digest, and what is in them if they are as they were written.
std::string sealed_bytes(std::string_view bytes);
std::optional<std::string> unsealed_bytes(std::string_view sealed);

/// The digest in 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace mckibben::input
