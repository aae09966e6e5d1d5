// One program at a time writes a results folder: whoever holds the lock of its place (flock on a hidden file
// beside it). The system lets go of it when its holder ends, however it ends; so nothing can be left locked,
// and process numbers, which repeat from container to container, do not matter.
#pragma once

#include <filesystem>
#include <string>

#include <sim/output/file.hpp>

namespace mckibben::output {

class Lock {
 public:
  /// Takes the lock of a place; `job` is what the next in line is told. Throws CannotWrite at once if another
  /// program holds it, or if the file system has no locks.
  Lock(const std::filesystem::path& place, const std::string& job);
  Lock(Lock&&) = default;
  Lock& operator=(Lock&&) = delete;
  ~Lock();

 private:
  std::filesystem::path path_;
  Descriptor file_;
};

}  // namespace mckibben::output
