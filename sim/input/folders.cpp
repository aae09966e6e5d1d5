// See the header.
#include <algorithm>
#include <fstream>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/input/folders.hpp>
#include <sim/input/utf8.hpp>

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

/// What wrote a folder: `run a.yaml`; empty if it is not known.
std::string job_of(const fs::path& folder) {
  std::error_code ignored;
  const fs::path manifest = folder / manifest_name;
  std::string job;
  if (fs::is_regular_file(manifest, ignored)) std::getline(std::ifstream(manifest), job);
  if (const auto secret = job.find(fmt::format(" {}", secret_mark)); secret != std::string::npos)
    job.resize(secret);
  return printable(shortened(job));
}

std::string written_by(const std::string& job) {
  return job.empty() ? "" : fmt::format("; written by `mckibben {}`", job);
}

std::vector<std::string> files_in(const fs::path& folder, const char* ending) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (fs::directory_iterator at(folder, ignored), end; at != end; at.increment(ignored))
    if (at->path().extension() == ending) names.push_back(printable(at->path().string()));
  std::ranges::sort(names);
  return names;
}

}  // namespace

std::string what_to_give(const fs::path& folder) {
  constexpr std::size_t most = 5;
  const std::string job = job_of(folder);
  std::vector<std::string> inside = files_in(folder, ".yaml");
  if (inside.size() > most) inside.resize(most);
  if (!inside.empty()) return fmt::format("{}; in it: {}", written_by(job), fmt::join(inside, ", "));
  for (const std::string_view verb : {"run ", "replay "})  // which leave no input there
    if (job.starts_with(verb)) return fmt::format("{}: give {}", written_by(job), job.substr(verb.size()));
  return written_by(job);
}

std::string how_to_import(const fs::path& folder) {
  if (files_in(folder, ".csv").empty()) return what_to_give(folder);
  return fmt::format("{}; of its tables one is made by: mckibben import {}/*.csv", written_by(job_of(folder)),
                     printable(folder.string()));
}

}  // namespace mckibben::input
