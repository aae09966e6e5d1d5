// Staging, manifest and swap of a results folder.
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include <sim/output/folder.hpp>

namespace mckibben::output {
namespace fs = std::filesystem;
namespace {

constexpr const char* manifest = ".mckibben-files";  // names of all files of a result, one a line

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw CannotWrite(fmt::format("cannot write {}: {}", path.string(), reason));
}

// Whether a folder holds a result of ours and nothing that somebody put there since.
bool is_only_ours(const fs::path& folder) {
  std::ifstream list(folder / manifest);
  if (!list) return false;
  std::set<std::string> ours{manifest};
  for (std::string name; std::getline(list, name);) ours.insert(name);
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

}  // namespace

ResultFolder::ResultFolder(const fs::path& destination) {
  go_to(destination);
  std::error_code error;
  fs::create_directories(destination_.parent_path(), error);
  if (error) fail(destination_.parent_path(), error.message());
  if (fs::exists(destination_, error) && !fs::is_directory(destination_, error))
    fail(destination_, "there is a file of that name");
  std::string name =
      (destination_.parent_path() / fmt::format(".{}.XXXXXX", destination_.filename().string())).string();
  if (mkdtemp(name.data()) == nullptr) fail(destination_, std::strerror(errno));
  staging_ = name;
  fs::permissions(staging_, fs::perms(0755), error);
}

void ResultFolder::go_to(const fs::path& destination) {
  std::error_code error;
  destination_ = fs::absolute(destination, error).lexically_normal();
  if (!destination_.has_filename()) destination_ = destination_.parent_path();  // a trailing slash
  if (error || !destination_.has_filename()) fail(destination, "not a folder name");
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
}

fs::path ResultFolder::publish() {
  std::string names;
  std::set<std::string> sorted;
  for (const auto& entry : fs::directory_iterator(staging_)) sorted.insert(entry.path().filename().string());
  for (const auto& name : sorted) names.append(name).append("\n");
  write(manifest, names);

  std::error_code error;
  fs::path aside;
  const bool replaces = fs::exists(destination_);
  const bool keeps = replaces && !is_only_ours(destination_);
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
  if (!replaces || keeps) return aside;
  fs::remove_all(aside, error);
  return {};
}

}  // namespace mckibben::output
