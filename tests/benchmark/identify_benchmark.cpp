// Identifies data sets by one likelihood (sim/identify) and says what it found, a line each.
//
//   benchmark_identify [-v] DATASET...       data sets of files; -v: each step
//   benchmark_identify [-v] --own FIRST SEEDS [TITLE]     of the suite (data_sets.hpp), what has a title that
//   benchmark_identify [-v] --nulls FIRST SEEDS [TITLE]   begins so; then how many are right
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <plant/names.hpp>
#include <sim/data/judged.hpp>
#include <sim/data/stamps.hpp>
#include <sim/identify/identify.hpp>
#include <sim/identify/usable.hpp>
#include <sim/input/dataset_file.hpp>

#include "data_sets.hpp"
#include "tally.hpp"

namespace {

using namespace mckibben;

double cpu_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Of sets of which it is known what is hidden.
struct Tallies {
  Tally named, triples, recalibrated, unknown, quiet, wrong;
  double cpu_s = 0.0;
  std::vector<long> passes;

  /// Names given that are not among what is hidden; whether the answer is right.
  bool count(const diagnose::Hidden& hidden, const identify::Identified& found) {
    using enum diagnose::Verdict;
    const auto verdict = found.decision.verdict;
    std::set<std::string> truth(hidden.effects.begin(), hidden.effects.end()), told;
    if (verdict == missing_effect)
      for (const std::string& name : found.table[found.decision.chosen].names) told.insert(name);
    // Nothing in these data tells a late command from a late reading.
    for (auto [one, other] :
         {std::pair{"command_delay", "reading_delay"}, {"reading_delay", "command_delay"}})
      if (told.contains(one) && truth.contains(other) && !truth.contains(one)) {
        told.erase(one);
        told.insert(other);
      }
    bool right = told == truth;
    if (hidden.verdict == missing_effect)
      (truth.size() > 2 ? triples : named).count(right);
    else if (hidden.verdict == recalibrate)
      recalibrated.count(right = verdict == recalibrate);
    else if (hidden.verdict == unknown_effect)
      unknown.count(right = verdict == unknown_effect);
    else
      quiet.count(right = told.empty() && verdict != unknown_effect);
    wrong.count(!std::ranges::includes(truth, told));
    passes.push_back(found.passes);
    return right;
  }
  void print() {
    named.print("one or two effects: named right");
    triples.print("three effects: named right");
    recalibrated.print("parameters off: recalibrated");
    unknown.print("outside the catalogue: unknown");
    quiet.print("nothing hidden: no name");
    wrong.print("a name that is not hidden");
    std::ranges::sort(passes);
    if (!passes.empty())
      fmt::print("simulations of a set: median {}, most {}; {:.1f} CPU-s a set\n", passes[passes.size() / 2],
                 passes.back(), cpu_s / static_cast<double>(passes.size()));
  }
};

identify::Identified identify_one(const std::string& title, domain::Dataset data, bool verbose) {
  const double begin_s = cpu_s();
  data::mend_at_stamps(data);
  data = data::with_rows(std::move(data));
  identify::Settings settings;
  if (verbose)
    settings.say = [](const std::string& what) {
      fmt::print("{}\n", what);
      std::fflush(stdout);
    };
  identify::Identified found = identify::identify(std::move(data), settings);
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
  return found;
}

void identify_all(const std::vector<diagnose::DataSet>& sets, bool verbose) {
  Tallies tallies;
  for (const diagnose::DataSet& set : sets) {
    diagnose::Hidden hidden = diagnose::hide(set.kind, set.seed, set.surroundings);
    const std::string title =
        fmt::format("{} {} {}", hidden.title, diagnose::name_of(set.surroundings.bench), set.seed);
    try {
      const double made_s = cpu_s();
      const identify::Identified found = identify_one(title, std::move(hidden.data), verbose);
      tallies.cpu_s += cpu_s() - made_s;
      if (!tallies.count(hidden, found))
        fmt::print("  WRONG: hidden {} [{}]\n", plant::name_of(hidden.verdict),
                   fmt::join(hidden.effects, " "));
    } catch (const std::exception& failure) {
      fmt::print("{} FAILED {}\n", title, failure.what());
    }
  }
  tallies.print();
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
    const double size = normal(random), shape = normal(random);
    point.effects.push_back(dictionary.clipped({k, dictionary.entries[k].either_sign ? size : std::abs(size),
                                                dictionary.entries[k].has_shape() ? shape : 0.0}));
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
    if (argv[i] == std::string_view("--own") || argv[i] == std::string_view("--nulls")) {
      if (i + 2 >= argc) {
        fmt::print(stderr, "{} FIRST SEEDS [TITLE]\n", argv[i]);
        return 2;
      }
      const bool own = argv[i] == std::string_view("--own");
      const std::string wanted = i + 3 < argc ? argv[i + 3] : "";
      const auto first = std::strtoull(argv[i + 1], nullptr, 10),
                 seeds = std::strtoull(argv[i + 2], nullptr, 10);
      identify_all(own ? diagnose::all_sets(first, seeds, wanted) : diagnose::nulls(first, seeds, wanted),
                   verbose);
      return 0;
    }
    try {
      identify_one(argv[i], input::read_dataset(std::filesystem::path(argv[i])), verbose);
    } catch (const std::exception& failure) {
      fmt::print("{} FAILED {}\n", argv[i], failure.what());
    }
  }
}
