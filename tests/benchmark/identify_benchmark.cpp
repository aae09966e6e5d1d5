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
#include <sim/identify/diagnosis.hpp>
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
  const identify::Model& model = found.chosen();
  const auto& chosen = found.table[found.decision.chosen];
  const auto& best = found.table[found.decision.best];
  const double unit = found.study->rows.unit;
  fmt::print(
      "{} {} [{}]{} best [{}] {:.1f} mass {:.3f} left {:.3f} white {:.3f} model {:.3f} passes {} cpu "
      "{:.1f}\n",
      title, plant::name_of(found.decision.verdict), fmt::join(chosen.names, " "),
      found.decision.contradicts_sheet ? " !sheet" : "",
      best.described ? "as described" : fmt::format("{}", fmt::join(best.names, " ")), best.score,
      found.decision.mass[found.decision.best], model.left(), model.error.white() / unit,
      model.error.of_model() / unit, found.passes, cpu_s() - begin_s);
  const diagnose::Diagnosis diagnosis = identify::diagnosis_of(found, settings);
  const auto print = [](const diagnose::FittedNumber& one) {
    fmt::print("    {} {:.6g} [{:.6g}, {:.6g}]{}\n", one.name, one.value, one.low, one.high,
               one.determined ? "" : " open");
  };
  fmt::print("    {}: {}\n", plant::name_of(diagnosis.verdict), diagnosis.because);
  for (const auto& effect : diagnosis.effects)
    for (const auto& one : effect.parameters) print(one);
  for (const auto& fault : diagnosis.bench) {
    print(fault.size);
    fmt::print("    {} {}: {}: {}\n", fault.name, fmt::join(fault.runs, " "), fault.words, fault.write);
  }
  fmt::print("    gap {:.3g} {:.3g} {:.3g} floor {:.3g} closed {:.4f} cpu {:.1f}\n",
             diagnosis.gap.nominal_rmse, diagnosis.gap.recalibrated_rmse, diagnosis.gap.corrected_rmse,
             diagnosis.gap.noise_floor, diagnosis.gap.closed, cpu_s() - begin_s);
  if (verbose) {
    for (const auto& one : diagnosis.recalibrated) {
      fmt::print("    {:.3f} ", one.deviations);
      print(one.fitted);
    }
    for (const auto& one : diagnosis.ranking)
      fmt::print("    {} {} {:.1f} {:.1f}: {}\n", one.name, one.variant, one.score, one.fall, one.outcome);
    for (const auto& one : diagnosis.left_open) fmt::print("    {}\n", one.words);
    for (const auto& one : diagnosis.warnings) fmt::print("    warning: {}\n", one);
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
