// The targets under clang's fuzzer; the environment names the one that is wanted.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <pthread.h>
#include <sanitizer/common_interface_defs.h>

#include "targets.hpp"

// UDUNITS loses 16 bytes for each unit such as "+0deg-3-0g".
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libudunits2\n";
}

// A library's crash in the process of its own that formats::isolated gives it is what that is for, no
// finding.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  return pthread_atfork(nullptr, nullptr, [] { __sanitizer_set_death_callback(nullptr); });
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* const name = std::getenv("MCKIBBEN_FUZZ_TARGET");
  static const auto target = mckibben::fuzz::find_target(name == nullptr ? "" : name);
  if (target == nullptr) std::abort();
  target(std::string(data, data + size));
  return 0;
}
