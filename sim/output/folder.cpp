// Results folders from their preparation to their publication; see the header.
//
// .NAME.writing/   begun           the files that were begun: what is in `result` beside them is not ours
//                  result/         what will be NAME
//                  publish         while it takes its place (publication.hpp)
#include <cerrno>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <sim/input/hash.hpp>
#include <sim/output/folder.hpp>

namespace mckibben::output {
namespace fs = std::filesystem;
namespace {

constexpr const char* begun_name = "begun";
constexpr const char* result_name = "result";

/// Whether a file system is mounted there: such a folder cannot change places with another.
bool is_mounted(const fs::path& path) {
  struct statx found {};
  return statx(AT_FDCWD, path.c_str(), 0, 0, &found) == 0 &&
         (found.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

/// The files that a container's own list says were begun.
FileNames names_begun(const fs::path& container) {
  FileNames names{begun_name, record_name, fmt::format("{}/{}", result_name, manifest_name)};
  std::istringstream list(read_regular(container / begun_name).value_or(""));
  for (std::string line; std::getline(list, line);) names.insert(fmt::format("{}/{}", result_name, line));
  return names;
}

/// Completes what a killed program was putting in place from a container; whether there was any.
bool finish(const fs::path& container, const Say& say) {
  if (!is_on_its_way(container)) return false;
  const auto asides = complete(container);
  say("an earlier run was killed while its result took its place; that is completed now");
  for (const Aside& aside : asides) say(to_text(aside));
  return true;
}

/// Removes a container that holds nothing but these files, `last` of them last; else renames it to the first
/// free name after `otherwise` and says so. Whether it was removed.
bool clear(const fs::path& container, const FileNames& names, const FileNames& last,
           const fs::path& otherwise, const Say& say) {
  if (fs::is_directory(fs::symlink_status(container)) && holds_only(container, names)) {
    remove_folder(container, last);
    return true;
  }
  const fs::path aside = first_free(otherwise);
  rename_new(container, aside);
  say(fmt::format("{} held other files and is now {}", container.string(), aside.string()));
  return false;
}

}  // namespace

fs::path result_path(const fs::path& wanted) {
  std::error_code error;
  if (fs::is_symlink(wanted, error) && !fs::exists(wanted, error))
    cannot_write(wanted, "it is a link that leads nowhere");
  fs::path path = fs::weakly_canonical(fs::absolute(wanted, error), error).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // a trailing slash
  if (error || !path.has_filename()) cannot_write(wanted, "not a folder that can be written");
  const fs::path here = fs::current_path(error) / "";
  if (here.string().starts_with((path / "").string()))
    cannot_write(wanted, "it is, or holds, the current folder; name a folder of its own");
  fs::create_directories(path.parent_path(), error);
  if (error) cannot_write(path.parent_path(), error.message());
  if (fs::exists(path, error) && !fs::is_directory(path, error))
    cannot_write(path, "there is a file of that name");
  if (is_mounted(path)) cannot_write(path, "a file system is mounted there; name a folder in it");
  return path;
}

void publish(const fs::path& container, const std::vector<Move>& moves, const Digests& files,
             const Say& say) {
  for (const Move& move : moves) {
    Digests below;
    for (const auto& [name, digest] : files)
      if (name.starts_with(move.folder + "/")) below[name.substr(move.folder.size() + 1)] = digest;
    seal(container / move.folder, move.job, below);
  }
  for (const Aside& aside : put_in_place(container, moves)) say(to_text(aside));
}

ResumedFolder::ResumedFolder(const fs::path& destination, Say say)
    : destination_(result_path(destination)),
      unfinished_(result_path(destination_.string() + ".unfinished")),
      say_(std::move(say)) {}

std::string ResumedFolder::key() const {
  return input::sha256_hex(plan_);
}

void ResumedFolder::open(std::string plan, FilesOf files_of, const std::string& job,
                         const std::vector<fs::path>& beside, const std::function<void(bool)>& opened) {
  plan_ = std::move(plan);
  files_of_ = std::move(files_of);
  if (!say_) return;
  locks_.emplace_back(destination_, job);
  for (const fs::path& place : beside) locks_.emplace_back(place, job);
  locks_.emplace_back(unfinished_, job);
  writing(unfinished_, [&] {
    const bool finished = finish(unfinished_, say_);
    if (fs::exists(unfinished_) && !fs::is_empty(unfinished_)) {
      const std::string found = read_regular(unfinished_ / plan_name).value_or("");
      if (found == plan_ && !finished) return opened(true);
      if (clear(unfinished_, files_of_(found), {plan_name}, unfinished_, say_) && !finished)
        say_(fmt::format("{} was of another campaign or version; starting anew", unfinished_.string()));
    }
    write_whole(unfinished_ / plan_name, plan_);
    opened(false);
  });
}

void ResumedFolder::publish(const std::vector<Move>& moves, const Digests& files) const {
  output::publish(unfinished_, moves, files, say_);
  if (is_on_its_way(unfinished_)) return;
  clear(unfinished_, files_of_(read_regular(unfinished_ / plan_name).value_or("")), {plan_name}, unfinished_,
        say_);
}

ResultFolder::ResultFolder(std::string job, Say say) : job_(std::move(job)), say_(std::move(say)) {}

// Of an object whose delegate has ended, the destructor runs also if what follows fails.
ResultFolder::ResultFolder(const fs::path& destination, std::string job, Say say)
    : ResultFolder(std::move(job), std::move(say)) {
  go_to(destination);
  const fs::path container =
      destination_.parent_path() / fmt::format(".{}.writing", destination_.filename().string());
  writing(container, [&] {
    const bool finished = finish(container, say_);
    if (fs::exists(fs::symlink_status(container)) &&
        clear(container, names_begun(container), {begun_name}, destination_, say_) && !finished)
      say_(fmt::format("what a killed run had begun to write to {} is removed", destination_.string()));
    fs::create_directory(container);
    container_ = container;  // from here on ours to remove
    begun_ = open_file(container / begun_name, O_WRONLY | O_CREAT | O_EXCL | O_APPEND);
    if (!begun_) cannot_write(container, errno);
    fs::create_directory(container / result_name);
  });
}

ResultFolder::~ResultFolder() {
  if (container_.empty() || is_on_its_way(container_)) return;
  try {
    remove_folder(container_, {begun_name});
  } catch (const std::runtime_error&) {
    // The next run does it.
  }
}

void ResultFolder::go_to(const fs::path& destination) {
  destination_ = result_path(destination);
  locks_.emplace_back(destination_, job_);
}

void ResultFolder::write(const std::string& name, const std::string& content) {
  if (const int failed = write_all(begun_.number(), name + "\n")) cannot_write(container_, failed);
  const std::string path = fmt::format("{}/{}", result_name, name);
  write_staged(container_ / path, content);
  files_[path] = input::sha256_hex(content);
}

void ResultFolder::publish() {
  writing(destination_, [&] {
    output::publish(container_, {{result_name, destination_, job_}}, files_, say_);
  });
}

}  // namespace mckibben::output
