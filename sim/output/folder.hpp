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

/// Lets folders of a container take their places: all or none. `files`: all that they hold, named from the
/// container. Says what was set aside. Throws CannotWrite.
void publish(const std::filesystem::path& container, const std::vector<Move>& moves, const Digests& files,
             const Say& say);

/// Does something with `path`; what the file system objects to becomes CannotWrite.
auto writing(const std::filesystem::path& path, const auto& work) {
  try {
    return work();
  } catch (const std::filesystem::filesystem_error& error) {
    cannot_write(path, error.code().message());
  }
}

/// Folders that are made piece by piece in OUT.unfinished, so that a job that was interrupted resumes.
class ResumedFolder {
 public:
  const std::filesystem::path& unfinished() const { return unfinished_; }
  /// OUT.
  const std::filesystem::path& data() const { return destination_; }
  /// What the bytes of all pieces depend on.
  std::string key() const;

 protected:
  /// For `destination` = OUT. `say`: hears what became of what was there before; null in a process that helps
  /// the one which has opened it: then nothing is locked, looked at or said.
  ResumedFolder(const std::filesystem::path& destination, Say say);

  /// Opens OUT.unfinished, in which the files of `plan` may be. What a killed program was putting in place is
  /// completed; what is there is kept if its plan is the same, an earlier plan's is removed, anything else
  /// moved aside; and said. `opened` then hears whether anything was kept. OUT, OUT.unfinished and `beside`
  /// are locked until the end: throws CannotWrite, at once if another program is writing there.
  void open(std::string plan, FilesOf files_of, const std::string& job,
            const std::vector<std::filesystem::path>& beside, const std::function<void(bool kept)>& opened);
  /// Lets folders in it take their places and removes it, or renames it if it holds other files.
  void publish(const std::vector<Move>& moves, const Digests& files) const;

  std::filesystem::path destination_, unfinished_;
  Say say_;

 private:
  std::string plan_;
  FilesOf files_of_;
  std::vector<Lock> locks_;
};

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
