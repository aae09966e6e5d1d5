// Results folders that appear whole or not at all: files are written into a folder beside the destination,
// which takes its name at the end. What stood there before is removed only if it is the earlier result of the
// same job, untouched; anything else is set aside under another name.
#pragma once

#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>

namespace mckibben::output {

/// Something could not be written (exit status 74). `what()` names the path and the system's reason.
class CannotWrite : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Paths of files inside a folder, relative to it, with /.
using FileNames = std::set<std::string>;

/// `wanted` as an absolute path without links and slash at its end; the folder above it is made. Throws
/// CannotWrite if a file stands there, if it is a link that leads nowhere, or if it is the current folder or
/// holds it.
std::filesystem::path result_path(const std::filesystem::path& wanted);

/// Writes a file, and the folders above it, so that it appears whole or not at all. Throws CannotWrite.
void write_whole(const std::filesystem::path& path, const std::string& content);

/// What write_whole leaves beside a file if the program is killed while it writes.
inline constexpr const char* unfinished_suffix = ".part";

/// Whether a folder holds nothing but these files and the folders they are in.
bool holds_only(const std::filesystem::path& folder, const FileNames& names);

/// `path` with the first of .old-1, .old-2, ... that is free.
std::filesystem::path first_free(const std::filesystem::path& path);

/// Lets the folder `staging` take the place of `destination`, with a list of its files and their digests.
/// `job` says what the result is of (verb and input). What stood there is removed if it is an earlier result
/// of that job and as it was written; otherwise it is set aside, and where to is returned. Throws
/// CannotWrite; the old folder is then where it was.
std::filesystem::path put_in_place(const std::filesystem::path& staging,
                                   const std::filesystem::path& destination, const std::string& job);

class ResultFolder {
 public:
  /// Prepares to write `destination`, the result of `job`. Throws CannotWrite.
  ResultFolder(const std::filesystem::path& destination, std::string job);
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;
  /// Removes what was written, unless it was published.
  ~ResultFolder();

  /// Takes another place than it was prepared for.
  void go_to(const std::filesystem::path& destination);

  /// Writes one file of the result; `name` may lead through folders (`figures/one.csv`). Throws CannotWrite.
  void write(const std::string& name, const std::string& content);

  /// Lets the folder take its place, as put_in_place does.
  std::filesystem::path publish();

 private:
  std::filesystem::path destination_, staging_;
  std::string job_;
};

}  // namespace mckibben::output
