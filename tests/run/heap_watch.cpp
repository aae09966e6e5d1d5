// Under sanitizers their own hooks are used; otherwise malloc and its relatives are replaced by ones that
// count and hand on to glibc's.
#include "heap_watch.hpp"

#include <cstddef>

namespace mckibben::run {
namespace {

thread_local bool watching = false;
thread_local long allocations = 0;

void note() {
  if (watching) ++allocations;
}

}  // namespace

void start_heap_watch() {
  allocations = 0;
  watching = true;
}

long stop_heap_watch() {
  watching = false;
  return allocations;
}

}  // namespace mckibben::run

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)

extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*, std::size_t),
                                                         void (*)(const volatile void*));
namespace {
[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t) { mckibben::run::note(); }, [](const volatile void*) {});
}  // namespace

#else

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);

void* malloc(std::size_t size) {
  mckibben::run::note();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  mckibben::run::note();
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  mckibben::run::note();
  return __libc_realloc(old, size);
}
}

#endif
