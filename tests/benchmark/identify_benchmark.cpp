// Identifies data sets by one likelihood (sim/identify) and says what it found, a line each.
//
//   benchmark_identify [-v] DATASET...                         data sets of files; -v: each step
//   benchmark_identify [-v] --descents FIRST SEEDS STARTS [TITLE]   of the suite (data_sets.hpp), what has a
//                                title that begins so: do descents from random starts end in the same place?
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <plant/names.hpp>
#include <sim/data/judged.hpp>
#include <sim/data/stamps.hpp>
#include <sim/identify/diagnosis.hpp>
#include <sim/identify/usable.hpp>
#include <sim/input/dataset_file.hpp>

#include "data_sets.hpp"
#include "tally.hpp"

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

/// A point with these effects, drawn from the priors.
identify::Point drawn(const identify::Dictionary& dictionary, const std::vector<std::string>& effects,
                      std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  identify::Point point = dictionary.nominal();
  for (double& z : point.z) z = normal(random);
  for (const std::string& name : effects) {
    std::vector<std::size_t> laws;
    for (std::size_t k = 0; k < dictionary.entries.size(); ++k)
      if (dictionary.entries[k].name == name) laws.push_back(k);
    const std::size_t k = laws[random() % laws.size()];
    const identify::Entry& entry = dictionary.entries[k];
    const double size = normal(random);
    std::vector<double> shapes;
    for (std::size_t i = 0; i < entry.shapes.size(); ++i) shapes.push_back(normal(random));
    point.effects.push_back(dictionary.clipped({k, entry.either_sign ? size : std::abs(size), shapes}));
  }
  std::ranges::sort(point.effects, {}, &identify::Added::entry);
  return point;
}

void descend_all(const std::vector<diagnose::DataSet>& sets, std::size_t starts, bool verbose) {
  Tally tally;
  for (const diagnose::DataSet& set : sets) {
    diagnose::Hidden hidden = diagnose::hide(set.kind, set.seed, set.surroundings);
    if (hidden.effects.empty()) continue;
    domain::Dataset data = data::with_rows(std::move(hidden.data));
    const identify::Usable counts = identify::usable(data, 0);
    const identify::Rows rows(data, counts.masked, counts.runs);
    const identify::Dictionary dictionary(data, rows.count > rows.sensor_count ? rows.count : 0.0);
    const identify::Simulator simulator(rows, 0);
    const identify::Error error(rows, simulator.wander(dictionary.setting(dictionary.described())));
    const identify::Problem problem{rows, dictionary, simulator,
                                    verbose ? [](const std::string& what) { fmt::print("{}\n", what); }
                                            : std::function<void(const std::string&)>()};
    std::mt19937_64 random(set.seed);
    std::map<std::vector<std::size_t>, std::vector<double>> ends;  // by law
    for (std::size_t i = 0; i < starts; ++i) {
      identify::Model model(problem, drawn(dictionary, hidden.effects, random), error);
      model.look();
      const long before = simulator.passes();
      model.settle({});
      const long took = simulator.passes() - before;
      const double value = model.evidence();
      std::vector<std::size_t> laws;
      for (const auto& added : model.point.effects) laws.push_back(added.entry);
      ends[laws].push_back(value);
      fmt::print("  {} {} start {}: {:.1f}{} z'z {:.1f} left {:.3f} {} passes\n", hidden.title,
                 fmt::join(laws, " "), i, value, model.arrived ? "" : " not there",
                 model.point.z.squaredNorm(), model.left(), took);
      std::fflush(stdout);
    }
    for (const auto& [laws, values] : ends)
      for (const double value : values) tally.count(value > std::ranges::max(values) - 0.5);
    tally.print("starts that reach the best");
  }
}

}  // namespace

int main(int argc, char** argv) {
  bool verbose = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "-v") == 0) {
      verbose = true;
      continue;
    }
    if (argv[i] == std::string_view("--descents") && i + 3 < argc) {
      const auto first = std::strtoull(argv[i + 1], nullptr, 10),
                 seeds = std::strtoull(argv[i + 2], nullptr, 10);
      descend_all(diagnose::all_sets(first, seeds, i + 4 < argc ? argv[i + 4] : ""),
                  std::strtoull(argv[i + 3], nullptr, 10), verbose);
      return 0;
    }
    try {
      identify_one(argv[i], input::read_dataset(std::filesystem::path(argv[i])), verbose);
    } catch (const std::exception& failure) {
      fmt::print("{} FAILED {}\n", argv[i], failure.what());
    }
  }
}
