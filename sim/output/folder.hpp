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
#include <sim/output/publication.hpp>

namespace mckibben::output {

/// Tells the user, in a line.
using Say = std::function<void(const std::string&)>;

/// `wanted` as an absolute path without links and slash at its end; the folder above it is made. Throws
/// CannotWrite if a file stands there, if it is a link that leads nowhere,
/// or if it is the current folder or holds it.
std::filesystem::path result_path(const std::filesystem::path& wanted);

/// The files that a container may hold whose plan is this text, for us to remove them.
using FilesOf = std::function<FileNames(const std::string& plan)>;

inline constexpr const char* plan_name = "plan.json";  ///< in a container: whose pieces it holds

/// Opens a container whose result is made piece by piece, so that a job that was interrupted resumes.
/// Completes what a killed program was putting in place; keeps what is there if its plan is the same; removes
/// what was made by another plan; renames what holds other files; says so. Whether anything was kept.
bool resume(const std::filesystem::path& container, const std::string& plan, const FilesOf& files_of,
            const Say& say);

/// Lets folders of a container take their places: all or none. `files`: all that they hold, named from the
/// container. Says what was set aside. Throws CannotWrite.
void publish(const std::filesystem::path& container, const std::vector<Move>& moves, const Digests& files,
             const Say& say);

/// The same of one that was resumed; then removes it, or renames it if it holds other files.
void publish_resumed(const std::filesystem::path& container, const std::vector<Move>& moves,
                     const Digests& files, const FilesOf& files_of, const Say& say);

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
