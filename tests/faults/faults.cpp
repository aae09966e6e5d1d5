// A library for LD_PRELOAD that lets one file operation of a program go wrong. Counted are the operations
// that change something below the folder FAULT_BELOW: open to write, write, close, fsync, truncate, rename,
// mkdir, unlink, rmdir. At the FAULT_AT-th
//
//   FAULT_DO=kill        the program is killed before it
//   FAULT_DO=run         the shell runs FAULT_RUN first, without this library, and the program waits
//   FAULT_DO=28          it fails with that errno; every renameat2 fails so if FAULT_AT is 0
//   FAULT_ON=1           and so does whatever takes room after it, as on a disk that is full
//
// A letter for each operation is appended to FAULT_LOG; the file's size is their number.
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

std::atomic<long> count{0};

std::string setting(const char* name) {
  const char* value = getenv(name);
  return value == nullptr ? "" : value;
}

/// Allocates nothing: the program's signal handlers write, too, maybe amid an allocation.
class PathOf {
 public:
  explicit PathOf(int fd) {
    char link[32];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    const ssize_t length = readlink(link, path_, sizeof path_);
    length_ = length < 0 ? 0 : static_cast<std::size_t>(length);
  }
  operator std::string_view() const { return {path_, length_}; }

 private:
  char path_[PATH_MAX];
  std::size_t length_;
};

std::string path_of(int folder, const char* name) {
  if (name[0] == '/') return name;
  char here[PATH_MAX];
  const std::string from(folder == AT_FDCWD ? getcwd(here, sizeof here) : std::string_view(PathOf(folder)));
  return from + "/" + name;
}

void log(char letter) {
  const long fd =
      syscall(SYS_openat, AT_FDCWD, setting("FAULT_LOG").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
  if (fd < 0) return;
  syscall(SYS_write, fd, &letter, 1);
  syscall(SYS_close, fd);
}

/// Whether an operation on this path is to fail, with errno set.
bool fails(std::string_view path, char letter) {
  static const std::string below = setting("FAULT_BELOW"), what = setting("FAULT_DO");
  static const long at = std::atol(setting("FAULT_AT").c_str());
  if (below.empty() || !path.starts_with(below) || !path.substr(below.size()).starts_with('/')) return false;
  log(letter);
  static const bool goes_on = !setting("FAULT_ON").empty();
  const long number = ++count;
  const bool full = goes_on && number > at && (letter == 'o' || letter == 'w' || letter == 'm');
  if (number != at && !full && !(at == 0 && letter == 'x')) return false;
  if (what == "kill") raise(SIGKILL);
  if (what == "run") {
    unsetenv("LD_PRELOAD");
    if (system(setting("FAULT_RUN").c_str()) != 0) std::abort();
    return false;
  }
  errno = std::atoi(what.c_str());
  return errno != 0;
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

template <class... Arguments>
int call(const char* name, Arguments... arguments) {
  return next<int(Arguments...)>(name)(arguments...);
}

bool writes(int flags) {
  return (flags & (O_WRONLY | O_RDWR | O_CREAT | O_TRUNC)) != 0;
}

}  // namespace

#pragma GCC diagnostic ignored "-Wnonnull-compare"

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if (writes(flags) && fails(path_of(AT_FDCWD, path), 'o')) return -1;
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open(path, flags, mode);
}

ssize_t write(int fd, const void* data, size_t size) {
  if (fails(PathOf(fd), 'w')) return -1;
  return syscall(SYS_write, fd, data, size);
}

ssize_t pwrite(int fd, const void* data, size_t size, off_t at) {
  if (fails(PathOf(fd), 'w')) return -1;
  return syscall(SYS_pwrite64, fd, data, size, at);
}

int close(int fd) {
  const bool wrong = writes(fcntl(fd, F_GETFL)) && fails(PathOf(fd), 'c');
  const int error = errno, status = static_cast<int>(syscall(SYS_close, fd));
  if (!wrong) return status;
  errno = error;
  return -1;
}

int fsync(int fd) {
  return fails(PathOf(fd), 's') ? -1 : call("fsync", fd);
}

int ftruncate(int fd, off_t size) noexcept {
  return fails(PathOf(fd), 't') ? -1 : call("ftruncate", fd, size);
}

int rename(const char* from, const char* to) noexcept {
  return fails(path_of(AT_FDCWD, to), 'r') ? -1 : call("rename", from, to);
}

int renameat2(int a, const char* from, int b, const char* to, unsigned flags) noexcept {
  return fails(path_of(b, to), 'x') ? -1 : call("renameat2", a, from, b, to, flags);
}

int mkdir(const char* path, mode_t mode) noexcept {
  return fails(path_of(AT_FDCWD, path), 'm') ? -1 : call("mkdir", path, mode);
}

int unlink(const char* path) noexcept {
  return fails(path_of(AT_FDCWD, path), 'u') ? -1 : call("unlink", path);
}

int unlinkat(int folder, const char* path, int flags) noexcept {
  return fails(path_of(folder, path), 'u') ? -1 : call("unlinkat", folder, path, flags);
}

int rmdir(const char* path) noexcept {
  return fails(path_of(AT_FDCWD, path), 'd') ? -1 : call("rmdir", path);
}

int remove(const char* path) noexcept {
  return fails(path_of(AT_FDCWD, path), 'u') ? -1 : call("remove", path);
}

}  // extern "C"
