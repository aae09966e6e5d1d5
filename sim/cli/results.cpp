// Destination, printing and publishing of results; see the header.
#include <cstdio>
#include <system_error>

#include <fmt/format.h>

#include <sim/cli/results.hpp>

namespace mckibben::cli {

std::filesystem::path destination(const Options& options, const std::string& name) {
  return options.out.empty() ? std::filesystem::path("out") / name : std::filesystem::path(options.out);
}

void keep_apart(const std::filesystem::path& where, const std::filesystem::path& data) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  for (fs::path folder = fs::absolute(data).lexically_normal(); folder != folder.parent_path();
       folder = folder.parent_path())
    if (fs::equivalent(where, folder, ignored))
      throw output::CannotWrite(
          fmt::format("cannot write {}: what is read is there; give another --out", where.string()));
}

void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
}

void publish(output::ResultFolder& folder, const std::filesystem::path& where) {
  say_moved(where, folder.publish());
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

void say_moved(const std::filesystem::path& where, const std::filesystem::path& aside) {
  if (!aside.empty())
    fmt::print(stderr, "mckibben: {} was not an earlier result of this, as it was written; it is now {}\n",
               where.string(), aside.string());
}

}  // namespace mckibben::cli
