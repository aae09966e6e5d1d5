// SHA-256 through OpenSSL's one-call interface; see the header.
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <openssl/evp.h>

#include <sim/input/hash.hpp>

namespace mckibben::input {

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("SHA-256 is not available in OpenSSL's libcrypto");
  std::string text;
  for (unsigned i = 0; i < length; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

}  // namespace mckibben::input
