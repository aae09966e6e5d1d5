// Lists of files and their digests; see the header. No file is opened that is not a regular one: a FIFO would
// wait for ever.
#include <algorithm>
#include <optional>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>

#include <sim/input/hash.hpp>
#include <sim/output/file.hpp>
#include <sim/output/manifest.hpp>

namespace mckibben::output {
namespace fs = std::filesystem;
namespace {

struct Manifest {
  std::string job;
  Digests files;
};

/// "JOB", then "DIGEST  NAME" for each file.
std::optional<Manifest> read_manifest(const fs::path& folder) {
  std::istringstream list(read_regular(folder / manifest_name).value_or(""));
  Manifest manifest;
  if (!std::getline(list, manifest.job)) return std::nullopt;
  for (std::string line; std::getline(list, line);) {
    const auto gap = line.find("  ");
    if (gap == std::string::npos) return std::nullopt;
    manifest.files[line.substr(gap + 2)] = line.substr(0, gap);
  }
  return manifest;
}

/// Files in a folder by their names, without the manifest.
FileNames names_in(const fs::path& folder) {
  FileNames names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.symlink_status().type() != fs::file_type::directory)
      names.insert(entry.path().lexically_relative(folder).generic_string());
  names.erase(manifest_name);
  return names;
}

}  // namespace

std::string digest_of(const fs::path& path) {
  input::Sha256 digest;
  const bool whole = read_pieces(open_file(path, O_RDONLY), [&](std::string_view part) { digest.add(part); });
  return whole ? digest.hex() : "";
}

bool holds_only(const fs::path& folder, const FileNames& names) {
  std::set<fs::path> folders;
  for (const auto& name : names)
    for (fs::path above = fs::path(name).parent_path(); !above.empty(); above = above.parent_path())
      folders.insert(above);
  const fs::recursive_directory_iterator entries(folder);
  return std::all_of(begin(entries), end(entries), [&](const auto& entry) {
    const fs::path name = entry.path().lexically_relative(folder);
    const fs::file_type type = entry.symlink_status().type();
    if (type == fs::file_type::directory) return folders.contains(name);
    return type == fs::file_type::regular && (names.contains(name.generic_string()) || is_temporary(name));
  });
}

bool is_ours(const fs::path& folder, const std::string& job) {
  if (fs::symlink_status(folder).type() != fs::file_type::directory) return false;
  const FileNames present = names_in(folder);
  const auto manifest = read_manifest(folder);
  if (!manifest) return present.empty() && !fs::exists(fs::symlink_status(folder / manifest_name));
  return manifest->job == job && std::all_of(present.begin(), present.end(), [&](const std::string& name) {
           const auto listed = manifest->files.find(name);
           return listed != manifest->files.end() && digest_of(folder / name) == listed->second;
         });
}

void seal(const fs::path& folder, const std::string& job, const Digests& files) {
  for (const std::string& name : names_in(folder))
    if (is_temporary(name))
      fs::remove(folder / name);
    else if (!files.contains(name))
      cannot_write(folder, fmt::format("{} is not of this result; please move it away", name));
  std::string list = job + "\n";
  for (const auto& [name, digest] : files) {
    if (digest_of(folder / name) != digest)
      cannot_write(folder, fmt::format("{} is no longer as it was written", name));
    list += fmt::format("{}  {}\n", digest, name);
  }
  write_staged(folder / manifest_name, list);
}

std::string seal_of(const fs::path& folder) {
  std::error_code missing;
  if (!fs::is_directory(folder, missing)) return "";
  const auto manifest = read_manifest(folder);
  if (!manifest) return "";
  const bool whole = std::all_of(manifest->files.begin(), manifest->files.end(), [&](const auto& file) {
    return digest_of(folder / file.first) == file.second;
  });
  return whole && names_in(folder).size() == manifest->files.size() ? digest_of(folder / manifest_name) : "";
}

void bring_tree_to_disk(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) bring_to_disk(entry.path());
  bring_to_disk(folder);
}

void remove_folder(const fs::path& folder, const FileNames& last) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (!last.contains(entry.path().filename().string()) && !error) fs::remove_all(entry.path(), error);
  for (const auto& name : last)
    if (!error) fs::remove(folder / name, error);
  if (!error) fs::remove(folder, error);
  if (error) cannot_write(folder, error.value());
}

fs::path first_free(const fs::path& path) {
  for (int n = 1;; ++n) {
    fs::path candidate = path;
    candidate += fmt::format(".old-{}", n);
    if (!fs::exists(fs::symlink_status(candidate))) return candidate;
  }
}

}  // namespace mckibben::output
