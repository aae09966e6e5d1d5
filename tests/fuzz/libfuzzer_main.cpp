// The targets under clang's fuzzer; the environment names the one that is wanted.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "targets.hpp"

// UDUNITS loses 16 bytes for each unit such as "+0deg-3-0g".
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libudunits2\n";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* const name = std::getenv("MCKIBBEN_FUZZ_TARGET");
  static const auto target = mckibben::fuzz::find_target(name == nullptr ? "" : name);
  if (target == nullptr) std::abort();
  target(std::string(data, data + size));
  return 0;
}
