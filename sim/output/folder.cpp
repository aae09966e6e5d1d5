// Staging, manifest and swap of a results folder.
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
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

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Whether a folder holds a result of this job as it was written, and nothing that somebody put there or
/// changed.
bool is_untouched_result(const fs::path& folder, const std::string& job) {
  std::ifstream list(folder / manifest_name);
  std::string line;
  if (!std::getline(list, line) || line != job) return false;
  std::set<std::string> ours{manifest_name};
  while (std::getline(list, line)) {
    const auto gap = line.find("  ");
    if (gap == std::string::npos) return false;
    const std::string name = line.substr(gap + 2);
    if (input::sha256_hex(text_of(folder / name)) != line.substr(0, gap)) return false;
    ours.insert(name);
  }
  return std::all_of(fs::directory_iterator(folder), fs::directory_iterator(), [&](const auto& entry) {
    return entry.is_regular_file() && ours.contains(entry.path().filename().string());
  });
}

fs::path first_free(const fs::path& path) {
  for (int n = 1;; ++n) {
    fs::path candidate = path;
    candidate += fmt::format(".old-{}", n);
    if (!fs::exists(fs::symlink_status(candidate))) return candidate;
  }
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

ResultFolder::ResultFolder(const fs::path& destination, std::string job) : job_(std::move(job)) {
  std::error_code error;
  if (fs::is_symlink(destination, error) && !fs::exists(destination, error))
    fail(destination, "it is a link that leads nowhere");
  go_to(destination);
  const fs::path here = fs::current_path(error) / "";
  if (here.string().starts_with((destination_ / "").string()))
    fail(destination, "it is, or holds, the current folder; name a folder of its own");
  fs::create_directories(destination_.parent_path(), error);
  if (error) fail(destination_.parent_path(), error.message());
  if (fs::exists(destination_, error) && !fs::is_directory(destination_, error))
    fail(destination_, "there is a file of that name");
  remove_abandoned(destination_);
  staging_ =
      destination_.parent_path() / fmt::format(".{}.writing-{}", destination_.filename().string(), getpid());
  if (!fs::create_directory(staging_, error))
    fail(destination_, error ? error.message() : "it is being written");
}

void ResultFolder::go_to(const fs::path& destination) {
  std::error_code error;
  destination_ = fs::weakly_canonical(fs::absolute(destination, error), error).lexically_normal();
  if (!destination_.has_filename()) destination_ = destination_.parent_path();  // a trailing slash
  if (error || !destination_.has_filename()) fail(destination, "not a folder that can be written");
}

ResultFolder::~ResultFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

void ResultFolder::write(const std::string& name, const std::string& content) {
  const fs::path path = staging_ / name;
  std::ofstream file(path, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) fail(destination_ / name, std::strerror(errno));
  if (name != manifest_name) manifest_.push_back(fmt::format("{}  {}", input::sha256_hex(content), name));
}

fs::path ResultFolder::publish() {
  std::sort(manifest_.begin(), manifest_.end());
  write(manifest_name, fmt::format("{}\n{}\n", job_, fmt::join(manifest_, "\n")));

  std::error_code error;
  fs::path aside;
  const bool replaces = fs::exists(destination_, error);
  bool keeps = false;
  try {
    keeps = replaces && !fs::is_empty(destination_) && !is_untouched_result(destination_, job_);
  } catch (const fs::filesystem_error& unreadable) {
    fail(destination_, unreadable.code().message());
  }
  if (replaces) {
    aside = keeps ? first_free(destination_) : fs::path(staging_.string() + ".old");
    fs::rename(destination_, aside, error);
    if (error) fail(destination_, error.message());
  }
  fs::rename(staging_, destination_, error);
  if (error) {
    std::error_code ignored;
    if (replaces) fs::rename(aside, destination_, ignored);
    fail(destination_, error.message());
  }
  staging_.clear();
  if (keeps) return aside;
  fs::remove_all(aside, error);
  return {};
}

}  // namespace mckibben::output
