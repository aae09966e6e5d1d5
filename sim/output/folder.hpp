// Results folders that appear whole or not at all: files are written into a hidden folder beside the
// destination, which takes its place at the end. What stood there before is removed only if it is the earlier
// result of the same job, untouched; anything else is set aside under another name.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <sim/output/file.hpp>
#include <sim/output/lock.hpp>
#include <sim/output/manifest.hpp>

namespace mckibben::output {

/// Tells the user, in a line.
using Say = std::function<void(const std::string&)>;

/// `wanted` as an absolute path without links and slash at its end; the folder above it is made. Throws
/// CannotWrite if a file stands there, if it is a link that leads nowhere,
/// or if it is the current folder or holds it.
std::filesystem::path result_path(const std::filesystem::path& wanted);

/// Completes what a killed program was putting in place from a container, and says so; whether there was any.
bool finish(const std::filesystem::path& container, const Say& say);

/// Removes a container that holds nothing but these files, `last` of them last; else renames it to the first
/// free name after `otherwise` and says so. Whether it was removed.
bool clear(const std::filesystem::path& container, const FileNames& names, const FileNames& last,
           const std::filesystem::path& otherwise, const Say& say);

/// Does something with `path`; what the file system objects to becomes CannotWrite.
template <class Work>
auto writing(const std::filesystem::path& path, const Work& work) {
  try {
    return work();
  } catch (const std::filesystem::filesystem_error& error) {
    cannot_write(path, error.code().message());
  }
}

class ResultFolder {
 public:
  /// Prepares to write `destination`, the result of `job`. `say`: hears what an earlier run left and what
  /// became of it. Throws CannotWrite, at once if another program is writing there.
  ResultFolder(const std::filesystem::path& destination, std::string job, Say say);
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;
  /// Removes what was written, unless it was published.
  ~ResultFolder();

  /// Takes another place than it was prepared for.
  void go_to(const std::filesystem::path& destination);

  /// Writes one file of the result; `name` may lead through folders (`figures/one.csv`). Throws CannotWrite.
  void write(const std::string& name, const std::string& content);

  /// Lets the folder take its place, once every file is there as it was written. Says what was set aside.
  void publish();

 private:
  ResultFolder(std::string job, Say say);

  std::filesystem::path destination_, container_;
  std::string job_;
  Say say_;
  std::vector<Lock> locks_;
  Descriptor begun_;
  Digests files_;
};

}  // namespace mckibben::output
