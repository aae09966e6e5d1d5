// See the header. Rows are written at once, so that they are the system's and no longer this program's; they
// are not forced onto the disk, which may take longer than a tick.
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <sim/output/unfinished.hpp>

namespace mckibben::output {
namespace fs = std::filesystem;

Unfinished::Unfinished(const fs::path& destination, const std::string& growing, const std::string& head,
                       const Say& say)
    : names_{growing}, pending_(head), head_(static_cast<std::int64_t>(head.size())) {
  const fs::path out = destination.has_filename() ? destination : destination.parent_path();
  const std::string wanted = result_path(out.string() + ".unfinished").string();
  fs::path folder = wanted;
  writing(folder, [&] {
    for (int number = 2; !fs::create_directory(folder); ++number) {
      say(fmt::format("{} is of an earlier recording that was not finished; it stays", folder.string()));
      folder = fmt::format("{}-{}", wanted, number);
    }
  });
  folder_ = folder;  // from here on ours to remove
  file_ = open_file(folder_ / growing, O_WRONLY | O_CREAT | O_EXCL | O_APPEND);
  if (file_) flush();
  if (complete()) return;
  const int error = errno;
  remove();
  cannot_write(folder / growing, error);
}

Unfinished::~Unfinished() {
  if (size_ <= head_ && pending_.empty()) remove();
}

void Unfinished::write(const std::string& name, const std::string& content) {
  names_.insert(name);
  write_staged(folder_ / name, content);
}

void Unfinished::append(const std::string& rows) {
  pending_ += rows;
  flush();
}

void Unfinished::flush() {
  const ssize_t written = ::write(file_.number(), pending_.data(), pending_.size());
  if (written <= 0) return;
  const std::size_t end = pending_.rfind('\n', static_cast<std::size_t>(written) - 1);
  const std::size_t whole = end == std::string::npos ? 0 : end + 1;
  size_ += static_cast<std::int64_t>(whole);
  if (whole < static_cast<std::size_t>(written) && ftruncate(file_.number(), size_) != 0) {
    // A torn row stays at the end of a full disk.
  }
  pending_.erase(0, whole);
}

void Unfinished::remove() {
  const fs::path folder = std::exchange(folder_, fs::path());
  if (folder.empty()) return;
  std::error_code stays;
  for (const std::string& name : names_) fs::remove(folder / name, stays);
  fs::remove(folder, stays);
}

}  // namespace mckibben::output
