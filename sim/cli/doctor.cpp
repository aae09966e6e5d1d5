// The verb `doctor`: is the program sound on this machine? Known cases, versions, how SUNDIALS was built,
// where results can go.
#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <sim/cli/exit_status.hpp>
#include <sim/cli/known_cases.hpp>
#include <sim/cli/options.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/engine/versions.hpp>
#include <sim/input/field_kinds.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/solver/settings.hpp>

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;
using input::Json;

#ifdef __clang__
constexpr const char* compiler = __VERSION__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

/// Whether a folder could be made there or written to: asked of the nearest folder above that exists.
bool can_write(fs::path folder) {
  std::error_code ignored;
  for (folder = fs::absolute(folder); !fs::exists(folder, ignored) && folder.has_relative_path();)
    folder = folder.parent_path();
  return fs::is_directory(folder, ignored) && access(folder.c_str(), W_OK | X_OK) == 0;
}

std::string machine() {
  utsname name{};
  return uname(&name) == 0 ? fmt::format("{} {} {}", name.sysname, name.release, name.machine) : "unknown";
}

struct Findings {
  std::vector<KnownCase> cases;
  engine::SundialsBuild sundials;
  bool versions_agree = false, out_is_writable = false;
  unsigned threads = 0;

  bool sound() const {
    return versions_agree &&
           std::all_of(cases.begin(), cases.end(), [](const auto& one) { return one.ok(); });
  }
};

Json json_of(const Findings& found) {
  const auto& library = found.sundials;
  Json document{
      {"schema", "mckibben-doctor/1"},
      {"ok", found.sound() && found.out_is_writable},
      {"program",
       {{"mckibben", MCKIBBEN_VERSION},
        {"compiler", compiler},
        {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}}},
      {"machine", machine()},
      {"threads", found.threads},
      {"out", {{"folder", fs::absolute("out").string()}, {"writable", found.out_is_writable}}},
      {"sundials",
       {{"version", library.version},
        {"headers_version", library.headers_version},
        {"file", library.file},
        {"precision", library.precision},
        {"index_bits", library.index_bits},
        {"logging_level", library.logging_level},
        {"profiling", library.profiling},
        {"monitoring", library.monitoring},
        {"mpi", library.mpi},
        {"vector_sum_slowness", library.slowness}}},
      {"cases", Json::array()}};
  for (const KnownCase& one : found.cases) {
    Json entry{{"name", one.name}, {"method", input::spelling(one.method)}, {"ok", one.ok()}};
    if (one.failure.empty())
      entry.update({{"error", one.error}, {"allowed", one.allowed}, {"unit", one.unit}});
    else
      entry["failure"] = one.failure;
    document["cases"].push_back(std::move(entry));
  }
  return document;
}

std::string text_of(const Findings& found) {
  const auto& library = found.sundials;
  const auto word = [](bool yes) { return yes ? "on" : "off"; };
  std::string text = "Known cases, integrated here\n";
  for (const KnownCase& one : found.cases)
    text +=
        one.failure.empty()
            ? fmt::format("  {:4}  {:28} {:6} error {:.1e}, allowed {:.0e} ({})\n", one.ok() ? "ok" : "BAD",
                          one.name, input::spelling(one.method), one.error, one.allowed, one.unit)
            : fmt::format("  BAD   {:28} {:6} {}\n", one.name, input::spelling(one.method), one.failure);
  text += fmt::format("\nProgram\n  mckibben {}, compiled by {}, Eigen {}.{}.{}\n", MCKIBBEN_VERSION,
                      __VERSION__, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  text += fmt::format(
      "\nSUNDIALS\n  {}  version {}{}\n        {}\n        {} precision, {}-bit indices, logging level {}, "
      "profiling {}, monitoring {}, MPI {}\n        built {} optimisation: its vector sum takes {:.1f} times "
      "as long as ours\n",
      found.versions_agree ? "ok  " : "BAD ", library.version,
      found.versions_agree
          ? ""
          : ", but this program was compiled for " + library.headers_version + "; build it again",
      library.file.empty() ? "linked statically" : library.file, library.precision, library.index_bits,
      library.logging_level, word(library.profiling), word(library.monitoring), word(library.mpi),
      library.slowness > 2.0 ? "without" : "with", library.slowness);
  text += fmt::format(
      "\nMachine\n  {}, {} threads\n  {}  {} {}\n", machine(), found.threads,
      found.out_is_writable ? "ok  " : "BAD ", fs::absolute("out").string(),
      found.out_is_writable ? "can be written" : "cannot be written; run elsewhere or give --out");
  return text + (found.sound() ? found.out_is_writable ? "\nAll is well.\n" : ""
                               : "\nResults of this program cannot be trusted here.\n");
}

struct DoctorOptions : Options {
  double tolerance = solver::Settings{}.tolerance;  ///< of the integration
};

int examine(const DoctorOptions& options) {
  Findings found;
  found.cases = known_cases(options.tolerance);
  found.sundials = engine::sundials_build();
  found.versions_agree = found.sundials.version == found.sundials.headers_version;
  found.out_is_writable = can_write("out");
  found.threads = std::max(1U, std::thread::hardware_concurrency());
  print(options, {json_of(found).dump(2) + "\n", text_of(found)});
  return !found.sound() ? failure : found.out_is_writable ? done : cannot_write;
}

}  // namespace

void add_doctor(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "doctor", to_find_out,
                            "Is the program sound here? Integrates known cases; prints versions and builds");
  DoctorOptions& options = asked.when(verb, examine);
  add_json(verb, options);
  verb.add_option("--tolerance", options.tolerance, "Of the integration (default: 1e-6, as in a rig)")
      ->check(from_to(solver::tightest_tolerance, 1e-3))
      ->type_name("RATIO");
  verb.footer(
      "Examples:\n"
      "  mckibben doctor\n"
      "  mckibben doctor --json > doctor.json             to go with a report of something odd\n"
      "Exit status: 70 if a case is not found, 74 if out/ cannot be written.\n");
}

}  // namespace mckibben::cli
