// A results folder that appears whole or not at all: files are written into a folder beside it, which takes
// its name at the end. What stood there before is removed only if it is the earlier result of the same job,
// untouched; anything else is set aside under another name.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace mckibben::output {

/// Something could not be written (exit status 74). `what()` names the path and the system's reason.
class CannotWrite : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ResultFolder {
 public:
  /// Prepares to write `destination`. `job` says what the result is of (verb and input): a result of another
  /// job is not replaced but set aside. Throws CannotWrite if nothing can be written beside it, or if it is
  /// the current folder or holds it.
  ResultFolder(const std::filesystem::path& destination, std::string job);
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;
  /// Removes what was written, unless it was published.
  ~ResultFolder();

  /// Takes another place than it was prepared for.
  void go_to(const std::filesystem::path& destination);

  /// Writes one file of the result. Throws CannotWrite.
  void write(const std::string& name, const std::string& content);

  /// Lets the folder take its place. Returns where an older folder was set aside; empty if there was none to
  /// keep. Throws CannotWrite; the old folder is then where it was.
  std::filesystem::path publish();

 private:
  std::filesystem::path destination_, staging_;
  std::string job_;
  std::vector<std::string> manifest_;  ///< "digest  name" of each file
};

}  // namespace mckibben::output
