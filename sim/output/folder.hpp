// A results folder that appears whole or not at all: files are written into a folder beside it, which takes
// its name at the end. What stood there before is removed only if it is an earlier result of ours and nothing
// else.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace mckibben::output {

/// Something could not be written (exit status 74). `what()` names the path and the system's reason.
class CannotWrite : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ResultFolder {
 public:
  /// Prepares to write `destination`. Throws CannotWrite if nothing can be written beside it.
  explicit ResultFolder(const std::filesystem::path& destination);
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;
  /// Removes what was written, unless it was published.
  ~ResultFolder();

  /// Takes another place than it was prepared for.
  void go_to(const std::filesystem::path& destination);

  /// Writes one file of the result. Throws CannotWrite.
  void write(const std::string& name, const std::string& content);

  /// Lets the folder take its place. Returns where a folder that was not ours has been moved to; empty if
  /// there was none. Throws CannotWrite; the old folder is then where it was.
  std::filesystem::path publish();

 private:
  std::filesystem::path destination_, staging_;
};

}  // namespace mckibben::output
