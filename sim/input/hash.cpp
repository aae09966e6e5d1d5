// SHA-256 through OpenSSL; see the header.
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <openssl/evp.h>

#include <sim/input/hash.hpp>

namespace mckibben::input {

namespace {

void must(int status) {
  if (status != 1) throw std::runtime_error("SHA-256 is not available in OpenSSL's libcrypto");
}

EVP_MD_CTX* context_of(void* context) {
  return static_cast<EVP_MD_CTX*>(context);
}

}  // namespace

Sha256::Sha256() : context_(EVP_MD_CTX_new(), [](void* context) { EVP_MD_CTX_free(context_of(context)); }) {
  must(context_ ? EVP_DigestInit_ex(context_of(context_.get()), EVP_sha256(), nullptr) : 0);
}

void Sha256::add(std::string_view bytes) {
  must(EVP_DigestUpdate(context_of(context_.get()), bytes.data(), bytes.size()));
}

std::string Sha256::hex() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  must(EVP_DigestFinal_ex(context_of(context_.get()), digest.data(), &length));
  std::string text;
  for (unsigned i = 0; i < length; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string sealed_bytes(std::string_view bytes) {
  return sha256_hex(bytes).append(bytes);
}

std::optional<std::string> unsealed_bytes(std::string_view sealed) {
  constexpr std::size_t digest_size = 64;
  if (sealed.size() < digest_size) return std::nullopt;
  const std::string_view bytes = sealed.substr(digest_size);
  return sha256_hex(bytes) == sealed.substr(0, digest_size) ? std::optional(std::string(bytes))
                                                            : std::nullopt;
}

std::string sha256_hex(std::string_view bytes) {
  Sha256 digest;
  digest.add(bytes);
  return digest.hex();
}

}  // namespace mckibben::input
