// Files in memory; see the header.
#include <cerrno>
#include <string>
#include <system_error>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <sim/formats/memory_file.hpp>

namespace mckibben::formats {
namespace {

[[noreturn]] void fail() {
  throw std::system_error(errno, std::generic_category(), "a file in memory");
}

}  // namespace

MemoryFile::MemoryFile(const std::string& bytes) : descriptor_(memfd_create("mckibben", MFD_CLOEXEC)) {
  if (descriptor_ < 0) fail();
  try {
    append(bytes);
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

void MemoryFile::append(const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (count < 0) fail();
    done += static_cast<std::size_t>(count);
  }
}

MemoryFile::~MemoryFile() {
  close(descriptor_);
}

std::string MemoryFile::path() const {
  return "/proc/self/fd/" + std::to_string(descriptor_);
}

std::string MemoryFile::bytes() const {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) fail();
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count =
        pread(descriptor_, text.data() + done, text.size() - done, static_cast<off_t>(done));
    if (count <= 0) fail();
    done += static_cast<std::size_t>(count);
  }
  return text;
}

}  // namespace mckibben::formats
