// A file in memory with a path (Linux: memfd_create), for libraries that know files only by their names.
#pragma once

#include <string>

namespace mckibben::formats {

class MemoryFile {
 public:
  /// Holds these bytes. Throws std::system_error if the machine has no memory for them.
  explicit MemoryFile(const std::string& bytes = {});
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  /// A path under which it can be opened as long as this lives.
  std::string path() const;
  /// Throws std::system_error.
  void append(const std::string& bytes);
  /// What is in it now.
  std::string bytes() const;

 private:
  int descriptor_;
};

}  // namespace mckibben::formats
