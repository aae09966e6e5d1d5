// Files by their system calls; see the header.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <sim/output/file.hpp>

namespace mckibben::output {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view temporary_prefix = ".mckibben-";  // and a number

/// A hidden file that nobody else writes: its writer holds its lock.
struct Temporary {
  fs::path path;
  Descriptor file;
};

/// Removes a temporary file that nobody holds any more. False if it is held, or is no file.
bool remove_abandoned(const fs::path& path) {
  const Descriptor file = open_file(path, O_RDONLY);
  struct stat found {};
  return file && fstat(file.number(), &found) == 0 && S_ISREG(found.st_mode) &&
         take(file, path) == Taken::yes && unlink(path.c_str()) == 0;
}

Temporary make_temporary(const fs::path& folder) {
  for (int n = 1;;) {
    fs::path path = folder / fmt::format("{}{}", temporary_prefix, n);
    Descriptor file = open_file(path, O_WRONLY | O_CREAT | O_EXCL);
    if (file) {
      // Between these two calls somebody may take it for abandoned; where there are no locks nobody does.
      const Taken taken = take(file, path);
      if (taken == Taken::yes || taken == Taken::no_locks) return {path, std::move(file)};
    } else if (errno != EEXIST) {
      cannot_write(path, errno);
    } else if (!remove_abandoned(path)) {
      ++n;
    }
  }
}

void write_file(const fs::path& path, const std::string& content, Earlier earlier, bool durable) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) cannot_write(path.parent_path(), error.value());
  Temporary made = make_temporary(path.parent_path());
  try {
    if (const int failed = write_all(made.file.number(), content)) cannot_write(path, failed);
    if (durable && fsync(made.file.number()) != 0) cannot_write(path, errno);
    if (earlier == Earlier::is_refused)
      rename_new(made.path, path);
    else if (rename(made.path.c_str(), path.c_str()) != 0)
      cannot_write(path, errno);
  } catch (const CannotWrite&) {
    unlink(made.path.c_str());
    throw;
  }
  if (const int failed = made.file.close()) cannot_write(path, failed);
  if (durable) bring_to_disk(path.parent_path());
}

bool has_no_such_rename(int error) {
  return error == EINVAL || error == ENOSYS || error == ENOTSUP;
}

}  // namespace

void cannot_write(const fs::path& path, const std::string& reason) {
  throw CannotWrite(fmt::format("cannot write {}: {}", path.string(), reason));
}

void cannot_write(const fs::path& path, int error) {
  cannot_write(path, std::string(std::strerror(error)));
}

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

Descriptor::~Descriptor() {
  close();
}

int Descriptor::close() {
  return number_ < 0 || ::close(std::exchange(number_, -1)) == 0 ? 0 : errno;
}

Descriptor open_file(const fs::path& path, int flags) {
  return Descriptor(open(path.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666));
}

Taken take(const Descriptor& file, const fs::path& path) {
  if (flock(file.number(), LOCK_EX | LOCK_NB) != 0)
    return errno == EWOULDBLOCK ? Taken::is_held : Taken::no_locks;
  struct stat held {
  }, named{};
  const bool same = fstat(file.number(), &held) == 0 && lstat(path.c_str(), &named) == 0 &&
                    held.st_ino == named.st_ino && held.st_dev == named.st_dev;
  return same ? Taken::yes : Taken::is_gone;
}

bool read_pieces(const Descriptor& file, const std::function<void(std::string_view)>& take) {
  struct stat found {};
  if (!file || fstat(file.number(), &found) != 0 || !S_ISREG(found.st_mode)) return false;
  for (std::string part(1 << 16, '\0');;) {
    const ssize_t count = read(file.number(), part.data(), part.size());
    if (count == 0) return true;
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) take({part.data(), static_cast<std::size_t>(count)});
  }
}

std::optional<std::string> read_regular(const Descriptor& file) {
  std::string content;
  if (!read_pieces(file, [&](std::string_view part) { content += part; })) return std::nullopt;
  return content;
}

std::optional<std::string> read_regular(const fs::path& path) {
  return read_regular(open_file(path, O_RDONLY));
}

int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t count = write(descriptor, content.data(), content.size());
    if (count > 0)
      content.remove_prefix(static_cast<std::size_t>(count));
    else if (count == 0 || errno != EINTR)
      return count == 0 ? ENOSPC : errno;
  }
  return 0;
}

void write_whole(const fs::path& path, const std::string& content, Earlier earlier) {
  write_file(path, content, earlier, true);
}

void write_staged(const fs::path& path, const std::string& content) {
  write_file(path, content, Earlier::is_replaced, false);
}

bool is_temporary(const fs::path& name) {
  const std::string leaf = name.filename().string();
  return leaf.size() > temporary_prefix.size() && leaf.starts_with(temporary_prefix) &&
         leaf.find_first_not_of("0123456789", temporary_prefix.size()) == std::string::npos;
}

void bring_to_disk(const fs::path& path) {
  const Descriptor file = open_file(path, O_RDONLY);
  if (!file) cannot_write(path, errno);
  // Some file systems have nothing of the kind for folders.
  if (fsync(file.number()) != 0 && errno != EINVAL && errno != ENOTSUP) cannot_write(path, errno);
}

void rename_new(const fs::path& from, const fs::path& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return;
  if (!has_no_such_rename(errno)) cannot_write(to, errno);
  if (fs::exists(fs::symlink_status(to))) cannot_write(to, EEXIST);
  if (rename(from.c_str(), to.c_str()) != 0) cannot_write(to, errno);
}

bool exchange(const fs::path& one, const fs::path& other) {
  if (renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0) return true;
  if (!has_no_such_rename(errno)) cannot_write(other, errno);
  return false;
}

}  // namespace mckibben::output
