// Destination, printing and publishing of results; see the header.
#include <cstdio>
#include <system_error>

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

void publish(output::ResultFolder& folder, const std::filesystem::path& where) {
  folder.publish();
  fmt::print(stderr, "results in {}\n", where.string());
}

std::filesystem::path beside(const std::filesystem::path& where) {
  std::filesystem::path other = where;
  if (!other.has_filename()) other = other.parent_path();
  other += ".interrupted";
  return other;
}

void say_interrupted(std::size_t finished, std::size_t all, const char* what,
                     const std::filesystem::path& whole) {
  fmt::print(
      stderr,
      "mckibben: interrupted; {} of {} {} are finished and in {}\n"
      "The same command makes all of them again. Earlier results in {} are as they were, if there are any.\n",
      finished, all, what, beside(whole).string(), whole.string());
}

void warn(const std::vector<std::string>& warnings) {
  for (const auto& text : warnings) fmt::print(stderr, "mckibben: warning: {}\n", text);
}

}  // namespace mckibben::cli
