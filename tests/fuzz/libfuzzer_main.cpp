// The targets under clang's fuzzer; the environment names the one that is wanted.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* const name = std::getenv("MCKIBBEN_FUZZ_TARGET");
  static const auto target = mckibben::fuzz::find_target(name == nullptr ? "" : name);
  if (target == nullptr) std::abort();
  target(std::string(data, data + size));
  return 0;
}
