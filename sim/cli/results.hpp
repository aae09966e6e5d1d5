// What the verbs do alike with their results: where they go, how they get there, what is said of them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sim/cli/options.hpp>
#include <sim/cli/streams.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/output/folder.hpp>
#include <sim/output/progress.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::cli {

/// The folder asked for, or out/<name>.
std::filesystem::path destination(const Options& options, const std::string& name);

/// Throws output::CannotWrite if one of the files that are read is in the folder `where`: a results folder
/// replaces what stood there, or sets it aside.
void keep_apart(const std::filesystem::path& where, const std::vector<domain::InputFile>& read);

/// Tells the user on stderr, in a line.
void say(const std::string& text);

/// Says on stderr what the user should know of a result.
void warn(const std::vector<std::string>& warnings);

/// Does `work(hook)` while what the hook hears is shown on stderr.
auto with_progress(const std::string& title, const auto& work) {
  output::Progress progress(title);
  return work(progress.hook());
}

/// Whether any of the runs, or of what else may fail on its own, did.
bool any_failed(const auto& runs) {
  return std::any_of(runs.begin(), runs.end(), [](const auto& run) { return !run.failure.empty(); });
}

/// How many of the runs were begun before the user stopped.
std::size_t begun(const auto& runs) {
  return static_cast<std::size_t>(
      std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.failure != run::not_begun; }));
}

/// Says that the user interrupted, what is kept for the same command to go on from, and returns that status.
int stopped(std::size_t there, std::size_t all, const std::filesystem::path& where);

/// A result as one JSON document, and as text to read.
struct Printable {
  std::string document, text;
};

/// Prints what was asked for of it.
void print(const Options& options, const Printable& result);

/// A verb's way from its input to its exit status:
///   Job job(options, "run my.yaml", name, inputs);    nothing is begun that could not be written
///   result = with_progress(name, ...);  warn(...);  job.interrupted(...) if it is not whole
///   job.write(...) each file
///   return job.finish({document, text}, status);      publishes, prints, says how to go on
class Job {
 public:
  /// Prepares the results folder: the one asked for, or out/<name>; of a job without a name, none that is not
  /// asked for. `words`: verb and input; `read`: the input files. Throws output::CannotWrite.
  Job(const Options& options, std::string words, const std::optional<std::string>& name,
      const std::vector<domain::InputFile>& read);

  /// The user interrupted: what is finished goes beside any whole result. `what`: runs, targets.
  void interrupted(std::size_t finished, std::size_t all, const char* what);
  /// The same of a result that is one whole: `what` was found by then.
  void interrupted(const char* what);

  /// Writes a file of the result, if there is a folder. Throws output::CannotWrite.
  void write(const std::string& name, const std::string& content);
  bool has_folder() const { return folder_.has_value(); }
  const std::filesystem::path& where() const { return where_; }

  /// Lets the folder take its place, says so, prints, and returns the exit status: `status`, or that of an
  /// interruption. `next`: the command with which people go on, without the program's name; `first`: what
  /// they do before it. Said where all went well. Throws output::CannotWrite.
  int finish(const Printable& result, int status, const std::string& next = "",
             const std::string& first = "");

 private:
  const Options& options_;
  std::filesystem::path where_;
  std::optional<output::ResultFolder> folder_;
  void set_aside(const std::string& what, const char* again);
  std::string interruption_;
};

}  // namespace mckibben::cli
