// What is recorded while a job goes on, on disk as it comes: OUT.unfinished, a folder that can be read at any
// time, also once the program was killed. What was recorded stays until it is removed.
#pragma once

#include <filesystem>
#include <string>

#include <sim/output/file.hpp>
#include <sim/output/folder.hpp>

namespace mckibben::output {

class Unfinished {
 public:
  /// Makes OUT.unfinished or, where earlier ones stand, OUT.unfinished-2 and so on; `say` hears of them.
  /// `growing`: a file that rows are appended to, which begins with `head`. Throws CannotWrite.
  Unfinished(const std::filesystem::path& destination, const std::string& growing, const std::string& head,
             const Say& say);
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  /// Removes it if no row came.
  ~Unfinished();

  const std::filesystem::path& path() const { return folder_; }
  /// A whole file beside the one that grows. Throws CannotWrite.
  void write(const std::string& name, const std::string& content);
  /// Whole lines. What finds no room is kept, and written with what comes next; never throws.
  void append(const std::string& rows);
  /// Whether all that was appended is on disk.
  bool complete() const { return pending_.empty(); }
  /// Once it is whole elsewhere. What cannot be removed stays.
  void remove();

 private:
  void flush();

  std::filesystem::path folder_;
  FileNames names_;
  Descriptor file_;
  std::string pending_;
  std::int64_t size_ = 0, head_ = 0;
};

}  // namespace mckibben::output
