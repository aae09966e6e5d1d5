// Staging, manifest and swap of results folders.
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <sim/input/hash.hpp>
#include <sim/output/folder.hpp>

namespace mckibben::output {
namespace fs = std::filesystem;
namespace {

constexpr const char* manifest_name = ".mckibben-files";  // the job, then digest and name of each file

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw CannotWrite(fmt::format("cannot write {}: {}", path.string(), reason));
}

std::string digest_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return input::sha256_hex(std::string{std::istreambuf_iterator<char>(file), {}});
}

FileNames list_files(const fs::path& folder) {
  FileNames names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) names.insert(entry.path().lexically_relative(folder).generic_string());
  return names;
}

/// Whether a folder holds a result of this job as it was written, and nothing that somebody put there or
/// changed.
bool is_untouched_result(const fs::path& folder, const std::string& job) {
  std::ifstream list(folder / manifest_name);
  std::string line;
  if (!std::getline(list, line) || line != job) return false;
  FileNames ours{manifest_name};
  while (std::getline(list, line)) {
    const auto gap = line.find("  ");
    if (gap == std::string::npos || digest_of(folder / line.substr(gap + 2)) != line.substr(0, gap))
      return false;
    ours.insert(line.substr(gap + 2));
  }
  return holds_only(folder, ours);
}

/// Staging folders are called .NAME.writing-PID. One whose process is gone was left behind by a killed
/// program.
void remove_abandoned(const fs::path& destination) {
  const std::string prefix = fmt::format(".{}.writing-", destination.filename().string());
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(destination.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    pid_t process = 0;
    const char* end = name.data() + name.size();
    if (std::from_chars(name.data() + prefix.size(), end, process).ptr == end && process > 0 &&
        kill(process, 0) != 0 && errno == ESRCH)
      fs::remove_all(entry.path(), error);
  }
}

}  // namespace

bool holds_only(const fs::path& folder, const FileNames& names) {
  std::set<fs::path> folders;
  for (const auto& name : names)
    for (fs::path above = fs::path(name).parent_path(); !above.empty(); above = above.parent_path())
      folders.insert(above);
  const fs::recursive_directory_iterator entries(folder);
  return std::all_of(begin(entries), end(entries), [&](const auto& entry) {
    const fs::path name = entry.path().lexically_relative(folder);
    if (entry.symlink_status().type() == fs::file_type::directory) return folders.contains(name);
    return entry.is_regular_file() && names.contains(name.generic_string());
  });
}

fs::path first_free(const fs::path& path) {
  for (int n = 1;; ++n) {
    fs::path candidate = path;
    candidate += fmt::format(".old-{}", n);
    if (!fs::exists(fs::symlink_status(candidate))) return candidate;
  }
}

fs::path result_path(const fs::path& wanted) {
  std::error_code error;
  if (fs::is_symlink(wanted, error) && !fs::exists(wanted, error))
    fail(wanted, "it is a link that leads nowhere");
  fs::path path = fs::weakly_canonical(fs::absolute(wanted, error), error).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // a trailing slash
  if (error || !path.has_filename()) fail(wanted, "not a folder that can be written");
  const fs::path here = fs::current_path(error) / "";
  if (here.string().starts_with((path / "").string()))
    fail(wanted, "it is, or holds, the current folder; name a folder of its own");
  fs::create_directories(path.parent_path(), error);
  if (error) fail(path.parent_path(), error.message());
  if (fs::exists(path, error) && !fs::is_directory(path, error)) fail(path, "there is a file of that name");
  return path;
}

void write_whole(const fs::path& path, const std::string& content) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) fail(path.parent_path(), error.message());
  fs::path part = path;
  part += unfinished_suffix;
  std::ofstream file(part, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) fail(path, std::strerror(errno));
  fs::rename(part, path, error);
  if (error) fail(path, error.message());
}

fs::path put_in_place(const fs::path& staging, const fs::path& destination, const std::string& job) {
  FileNames names = list_files(staging);
  names.erase(manifest_name);
  std::string list = job + "\n";
  for (const auto& name : names) list += fmt::format("{}  {}\n", digest_of(staging / name), name);
  write_whole(staging / manifest_name, list);

  std::error_code error;
  fs::path aside;
  const bool replaces = fs::exists(destination, error);
  bool keeps = false;
  try {
    keeps = replaces && !fs::is_empty(destination) && !is_untouched_result(destination, job);
  } catch (const fs::filesystem_error& unreadable) {
    fail(destination, unreadable.code().message());
  }
  if (replaces) {
    aside = keeps ? first_free(destination) : fs::path(staging.string() + ".old");
    fs::rename(destination, aside, error);
    if (error) fail(destination, error.message());
  }
  fs::rename(staging, destination, error);
  if (error) {
    std::error_code ignored;
    if (replaces) fs::rename(aside, destination, ignored);
    fail(destination, error.message());
  }
  if (keeps) return aside;
  fs::remove_all(aside, error);
  return {};
}

ResultFolder::ResultFolder(const fs::path& destination, std::string job) : job_(std::move(job)) {
  go_to(destination);
  remove_abandoned(destination_);
  std::error_code error;
  staging_ =
      destination_.parent_path() / fmt::format(".{}.writing-{}", destination_.filename().string(), getpid());
  if (!fs::create_directory(staging_, error))
    fail(destination_, error ? error.message() : "it is being written");
}

void ResultFolder::go_to(const fs::path& destination) {
  destination_ = result_path(destination);
}

ResultFolder::~ResultFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

void ResultFolder::write(const std::string& name, const std::string& content) {
  write_whole(staging_ / name, content);
}

fs::path ResultFolder::publish() {
  fs::path aside = put_in_place(staging_, destination_, job_);
  staging_.clear();
  return aside;
}

}  // namespace mckibben::output
