// Identifies data sets by one likelihood (sim/identify) and says what it found, a line each.
//
//   benchmark_identify [-v] DATASET...       data sets of files; -v: each step
//   benchmark_identify --own KIND SEED [SEEDS]   of the diagnosis's own suite (hidden_effects.hpp), with a
//   title that begins so
#include <chrono>
#include <cstring>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <plant/names.hpp>
#include <sim/data/judged.hpp>
#include <sim/data/stamps.hpp>
#include <sim/identify/identify.hpp>
#include <sim/input/dataset_file.hpp>

namespace {

using namespace mckibben;

double cpu_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void identify_one(const std::string& title, domain::Dataset data, bool verbose) {
  const double begin_s = cpu_s();
  data::mend_at_stamps(data);
  data = data::with_rows(std::move(data));
  identify::Settings settings;
  if (verbose)
    settings.say = [](const std::string& what) {
      fmt::print("{}\n", what);
      std::fflush(stdout);
    };
  const identify::Identified found = identify::identify(std::move(data), settings);
  const auto& chosen = found.table[found.decision.chosen];
  const auto& best = found.table[found.decision.best];
  fmt::print(
      "{} {} [{}]{} best [{}] {:.1f} mass {:.3f} left {:.3f} white {:.3f} model {:.3f} passes {} cpu "
      "{:.1f}\n",
      title, plant::name_of(found.decision.verdict), fmt::join(chosen.names, " "),
      found.decision.contradicts_sheet ? " !sheet" : "",
      best.described ? "as described" : fmt::format("{}", fmt::join(best.names, " ")), best.score,
      found.decision.mass[found.decision.best], found.left, found.white, found.model_error, found.passes,
      cpu_s() - begin_s);
  for (const auto& one : found.sizes)
    fmt::print("    {} {:.6g} +- {:.2g}\n", one.name, one.value, one.deviation);
  if (verbose) {
    for (const auto& one : found.parameters)
      fmt::print("    {} {:.3f} +- {:.3f}\n", one.name, one.value, one.deviation);
    for (std::size_t i = 0; i < found.table.size(); ++i) {
      const auto& row = found.table[i];
      const auto [nats, error] = identify::loss(best.held_out, row.held_out);
      fmt::print("    {:>10.1f} {:>8.1f} +- {:<8.1f} z {:<6.1f} {}{}\n", row.score, nats, error,
                 row.off_sheet, row.described ? "as described " : "", fmt::join(row.names, " "));
    }
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  bool verbose = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "-v") == 0) {
      verbose = true;
      continue;
    }
    try {
      identify_one(argv[i], input::read_dataset(std::filesystem::path(argv[i])), verbose);
    } catch (const std::exception& failure) {
      fmt::print("{} FAILED {}\n", argv[i], failure.what());
    }
  }
}
