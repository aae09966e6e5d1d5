// Single files: written so that they appear whole or not at all, and never through a link or over what
// somebody else put there; and the system calls that results folders are published with.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mckibben::output {

/// Something could not be written (exit status 74). `what()` names the path and the system's reason.
class CannotWrite : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws CannotWrite. `error`: an errno.
[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& reason);
[[noreturn]] void cannot_write(const std::filesystem::path& path, int error);

/// A file descriptor that closes itself; -1 for none.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();
  explicit operator bool() const { return number_ >= 0; }
  int number() const { return number_; }
  /// 0, or the errno of what was written but did not arrive.
  int close();

 private:
  int number_;
};

/// Opens without following a link at the end of the path and without waiting for the other end of a FIFO;
/// none (and errno) if that fails. `flags` as for open(2).
Descriptor open_file(const std::filesystem::path& path, int flags);

/// What became of an attempt to lock a file; `gone` if it is no longer what stands at its path.
enum class Taken { yes, is_held, is_gone, no_locks };

/// Locks an open file, which stands at `path`, for as long as it is open; does not wait.
Taken take(const Descriptor& file, const std::filesystem::path& path);

/// What a regular file holds; nothing if there is none, or something else.
std::optional<std::string> read_regular(const Descriptor& file);
std::optional<std::string> read_regular(const std::filesystem::path& path);

/// The same piece by piece; false if there is no regular file, or it cannot be read to its end.
bool read_pieces(const Descriptor& file, const std::function<void(std::string_view)>& take);

/// Writes all of it. 0 or an errno.
int write_all(int descriptor, std::string_view content);

/// What may stand where a file is to be written.
enum class Earlier { is_replaced, is_refused };

/// Writes a file, and the folders above it, so that it appears whole or not at all,
/// also if the power fails. Throws CannotWrite.
void write_whole(const std::filesystem::path& path, const std::string& content,
                 Earlier earlier = Earlier::is_replaced);

/// The same for a file of a folder that is not published yet: what is lost if the power fails is made again.
void write_staged(const std::filesystem::path& path, const std::string& content);

/// Whether a file is what a killed program leaves that was writing another one; it is hidden.
bool is_temporary(const std::filesystem::path& name);

/// Brings a file, or the names in a folder, to the disk. Throws CannotWrite.
void bring_to_disk(const std::filesystem::path& path);

/// Renames to a name that is free. Throws CannotWrite, also if it is not.
void rename_new(const std::filesystem::path& from, const std::filesystem::path& to);

/// Two names for two things exchange them at once. False where the file system cannot. Throws CannotWrite.
bool exchange(const std::filesystem::path& one, const std::filesystem::path& other);

}  // namespace mckibben::output
