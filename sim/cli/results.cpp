// Destination, publication and printing of results; see the header.
#include <cstdio>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <sim/cli/results.hpp>

namespace mckibben::cli {

std::filesystem::path destination(const Options& options, const std::string& name) {
  return options.out.empty() ? std::filesystem::path("out") / name : std::filesystem::path(options.out);
}

void keep_apart(const std::filesystem::path& where, const std::vector<domain::InputFile>& read) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const auto refuse_within = [&](const fs::path& file, const std::string& name) {
    for (fs::path folder = file.parent_path(); folder != folder.parent_path(); folder = folder.parent_path())
      if (fs::equivalent(where, folder, ignored))
        output::cannot_write(where, fmt::format("{} is read from there; give another --out", name));
  };
  for (const auto& file : read) {  // where a link is, and where it leads to
    const fs::path path = fs::absolute(file.name, ignored).lexically_normal();
    refuse_within(path, file.name);
    refuse_within(fs::weakly_canonical(path, ignored), file.name);
  }
}

void say(const std::string& text) {
  fmt::print(stderr, "mckibben: {}\n", text);
}

void warn(const std::vector<std::string>& warnings) {
  for (const auto& text : warnings) say("warning: " + text);
}

int stopped(std::size_t there, std::size_t all, const std::filesystem::path& where) {
  fmt::print(stderr,
             "mckibben: interrupted; {} of {} runs are in {}\n"
             "The same command goes on from there. Earlier results are as they were.\n",
             there, all, where.string());
  return interrupted;
}

void print(const Options& options, const Printable& result) {
  print(options.json ? result.document : result.text);
}

Job::Job(const Options& options, std::string words, const std::optional<std::string>& name,
         const std::vector<domain::InputFile>& read)
    : options_(options), where_(destination(options, name.value_or(""))) {
  if (!name && options.out.empty()) return;
  keep_apart(where_, read);
  folder_.emplace(where_, std::move(words), say);
}

void Job::interrupted(std::size_t finished, std::size_t all, const char* what) {
  set_aside(fmt::format("{} of {} {} are finished and", finished, all, what), "makes all of them again");
}

void Job::interrupted(const char* what) {
  set_aside(fmt::format("{} is", what), "begins again");
}

void Job::set_aside(const std::string& what, const char* again) {
  const std::filesystem::path whole = where_;
  if (!where_.has_filename()) where_ = where_.parent_path();
  where_ += ".interrupted";
  folder_->go_to(where_);
  interruption_ = fmt::format(
      "interrupted; {} in {}\nThe same command {}. Earlier results in {} are as they were, if there are any.",
      what, where_.string(), again, whole.string());
}

void Job::write(const std::string& name, const std::string& content) {
  if (folder_) folder_->write(name, content);
}

int Job::finish(const Printable& result, int status, const std::string& next, const std::string& first) {
  if (folder_) {
    folder_->publish();
    fmt::print(stderr, "results in {}\n", where_.string());
  }
  print(options_, result);
  if (interruption_.empty() && status == done && !next.empty() && !options_.json)
    fmt::print(stderr, "next: {}mckibben {}\n", first.empty() ? "" : first + ", then ", next);
  if (interruption_.empty()) return status;
  say(interruption_);
  return ExitStatus::interrupted;
}

}  // namespace mckibben::cli
