// Scores the diagnosis on data with something hidden in it.
//
//   benchmark_diagnosis [SEED [SEEDS [TITLE]]]   seeds SEED to SEED + SEEDS - 1 (default 101, 3 of them), of
//                                                what has a title that begins so (default: all)
//   benchmark_diagnosis --nulls [SEED [SEEDS [TITLE]]]   the same where nothing is hidden, on four benches
//   benchmark_diagnosis --weak [SEED [SEEDS [TITLE]]]   effects of 10 to 200 % of a small size, other numbers
//                                                and laws of no catalogue in four to nine short runs: how
//                                                often a name is right that is given with such evidence
//   benchmark_diagnosis --advice [SEED [SETS]]   SETS data sets (default 60), three or four short sines with
//                                                little of an effect that has relatives: where a name is
//                                                open, the measurement that is asked for is made, and all is
//                                                diagnosed again
//   benchmark_diagnosis --doubts [SEED [SETS]]   the same between two explanations alone, numbers in
//                                                place of an effect among them (default 30 data sets)
//   benchmark_diagnosis --pairs [SEED [SEEDS]]   two muscles on one wheel, an effect in one, both or none
//   benchmark_diagnosis --corrupted [SEED [only=NAME]]   the same for data that were spoilt on purpose
//
// Every third data set is of the thesis's rig, of one of another size, of one that is badly known.
// Started by mpirun or srun, its processes share the data sets out and meet in out/bench-diagnosis.ranks.
// Thresholds of the workflow were set on seeds below 100.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/cluster/share.hpp>
#include <sim/diagnose/diagnose.hpp>
#include <sim/input/hash.hpp>
#include <sim/run/batch.hpp>

#include "advice_benchmark.hpp"
#include "corrupted_benchmark.hpp"
#include "doubts_benchmark.hpp"
#include "hidden_effects.hpp"
#include "pairs_benchmark.hpp"
#include "tally.hpp"

namespace {

using namespace mckibben;
using diagnose::Verdict;

std::string_view name_of(Verdict verdict) {
  for (const auto& [value, name] : names(verdict))
    if (value == verdict) return name;
  return {};
}

using Names = std::set<std::string>;

bool holds(const Names& all, const Names& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

/// What a diagnosis says, and how that compares with what was hidden.
struct Answer {
  Names named, declared;
  std::string said;
  bool right = false, within = false;

  Answer(const diagnose::Hidden& hidden, const diagnose::Diagnosis& found) {
    for (const auto& effect : found.effects) {
      named.insert(effect.name);
      declared.insert(effect.name);
      for (const auto& rival : effect.confusable_with) declared.insert(rival.effect);
      said += (said.empty() ? "" : " + ") + effect.name;
      if (!effect.confusable_with.empty())
        said += fmt::format(" (or {})", fmt::join(words_of(effect.confusable_with), ", "));
    }
    const Names truth(hidden.effects.begin(), hidden.effects.end());
    right = named == truth;
    within = holds(declared, truth);
  }
};

/// How often a true value lies in the interval that is told.
struct Coverage {
  int inside = 0, of = 0;
  void count(double truth, const diagnose::FittedNumber& told) {
    inside += truth >= told.low && truth <= told.high ? 1 : 0;
    ++of;
  }
};

/// A name that was given, and by what evidence.
struct Given {
  bool right = false, alone = true;
  bool among = false;    ///< right, or one of those is that do as well
  bool simpler = false;  ///< an explanation without effects does as well
  double margin = 0.0;   ///< by which it is ahead

  Given() = default;
  Given(const diagnose::NamedEffect& effect, const std::vector<std::string>& truth, bool simpler_does)
      : right(is_in(truth, effect.name)),
        alone(effect.confusable_with.empty()),
        among(right || std::ranges::any_of(effect.confusable_with,
                                           [&](const auto& rival) { return is_in(truth, rival.effect); })),
        simpler(simpler_does),
        margin(std::min(effect.support.fall, effect.support.before_rivals)) {}

 private:
  static bool is_in(const std::vector<std::string>& list, const std::string& name) {
    return std::ranges::find(list, name) != list.end();
  }
};

bool simpler_does_as_well(const diagnose::Diagnosis& found) {
  return std::ranges::any_of(found.explanations, [](const diagnose::Explanation& one) {
    return one.as_good && !one.chosen && one.kind < diagnose::Explanation::Kind::effects;
  });
}

/// What counts of a diagnosis.
struct Outcome {
  Verdict hidden{}, found{};
  std::size_t effects = 0;  ///< that were hidden
  bool right = false, within = false, wrong_name = false, closed = false;
  Coverage sizes, numbers;
  std::array<Given, 4> given{};
  std::size_t names = 0;
  diagnose::Advice advice{};
  double took_s = 0.0;

  Outcome(const diagnose::Hidden& truth, const diagnose::Diagnosis& diagnosis, const Answer& answer)
      : hidden(truth.verdict),
        found(diagnosis.verdict),
        effects(truth.effects.size()),
        right(answer.right),
        within(answer.within),
        wrong_name(!answer.named.empty() &&
                   !holds({truth.effects.begin(), truth.effects.end()}, answer.named)),
        closed(diagnosis.gap.closed >= 0.9) {
    for (const auto& planted : truth.truth)
      for (const auto& effect : diagnosis.effects)
        for (const auto& p : effect.parameters)
          if (planted.path == "effects." + effect.name + "." + p.name) sizes.count(planted.value, p);
    for (const auto& number : truth.numbers)
      for (const auto& moved : diagnosis.recalibrated)
        if (moved.fitted.name == number.path) numbers.count(number.value, moved.fitted);
    for (const auto& effect : diagnosis.effects)
      if (names < given.size()) given[names++] = {effect, truth.effects, simpler_does_as_well(diagnosis)};
  }
  Outcome() = default;
};

class Score {
 public:
  void count(const Outcome& outcome) {
    slowest_s_ = std::max(slowest_s_, outcome.took_s);
    if (outcome.hidden == Verdict::missing_effect) {
      const bool right = outcome.right && outcome.found == Verdict::missing_effect;
      (outcome.effects > 2 ? triples_ : few_).count(right);
      in_set_.count(outcome.within);
      if (outcome.right) closed_.count(outcome.closed);
      if (outcome.right) add(sizes_, outcome.sizes);
    }
    if (outcome.right) add(numbers_, outcome.numbers);
    if (outcome.hidden == Verdict::nothing_missing)
      false_alarms_.count(outcome.found == Verdict::missing_effect ||
                          outcome.found == Verdict::unknown_effect);
    if (outcome.hidden == Verdict::recalibrate) recalibrated_.count(outcome.found == Verdict::recalibrate);
    if (outcome.hidden == Verdict::unknown_effect) unknown_.count(outcome.found == Verdict::unknown_effect);
    wrong_names_.count(outcome.wrong_name);
    advice_.count(outcome.advice);
    for (std::size_t i = 0; i < outcome.names; ++i) given_.push_back(outcome.given.at(i));
  }

  void print() const {
    few_.print("one or two effects: right names");
    triples_.print("three effects: right names");
    in_set_.print("effects: right name in the declared set");
    closed_.print("effects: gap on held-out runs closed by 90 %");
    sizes_.print("effects: true parameter in its interval");
    numbers_.print("the rig's numbers: true one in its interval");
    recalibrated_.print("changed nominal parameter: recalibrate");
    unknown_.print("unknown laws recognised");
    false_alarms_.print("nothing hidden: false alarms");
    wrong_names_.print("wrong names (all data sets)");
    print_reliability();
    advice_.print();
    fmt::print("slowest diagnosis {:.1f} s\n", slowest_s_);
  }

 private:
  static void add(Tally& tally, const Coverage& coverage) {
    tally.yes += coverage.inside;
    tally.of += coverage.of;
  }

  /// How often names were right, by how far they were ahead.
  void print_reliability() const {
    constexpr std::array edges{0.0, 50.0, 200.0, 1000.0, std::numeric_limits<double>::infinity()};
    for (std::size_t bin = 0; bin + 1 < edges.size(); ++bin) {
      Tally right;
      for (const Given& one : given_)
        if (one.alone && one.margin >= edges.at(bin) && one.margin < edges.at(bin + 1))
          right.count(one.right);
      right.print(fmt::format("names ahead by {:g}", edges.at(bin)));
    }
    Tally first, among, simpler;
    for (const Given& one : given_) {
      if (!one.alone) first.count(one.right);
      if (!one.alone) among.count(one.among);
      if (one.simpler) simpler.count(one.right);
    }
    first.print("names beside which others do as well: right");
    among.print("the same: one of them right");
    simpler.print("names beside which numbers do as well: right");
  }

  Tally few_, triples_, in_set_, false_alarms_, unknown_, wrong_names_, sizes_, numbers_, closed_,
      recalibrated_;
  std::vector<Given> given_;
  diagnose::AdviceScore advice_;
  double slowest_s_ = 0.0;
};

/// A diagnosis for another process: its outcome and its line, as bytes.
std::string bytes_of(const Outcome& outcome, const std::string& line) {
  return std::string(reinterpret_cast<const char*>(&outcome), sizeof outcome) + line;
}

struct DataSet {
  std::size_t kind = 0;
  std::uint64_t seed = 0;
  diagnose::Surroundings surroundings{};
  bool advised = false;  ///< its advice is followed
};

std::string_view name_of(diagnose::Bench bench) {
  return bench == diagnose::Bench::thesis ? "" : bench == diagnose::Bench::other_size ? "size" : "wide";
}

/// The evidence for each name.
std::string evidence_in_words(const Outcome& outcome) {
  std::string words;
  for (std::size_t i = 0; i < outcome.names; ++i)
    words += fmt::format(" [ahead by {:.0f}{}{}]", outcome.given.at(i).margin,
                         outcome.given.at(i).simpler ? ", numbers" : "",
                         outcome.given.at(i).right ? "" : ", wrong");
  return words;
}

/// Parts of the data in which more is left than chance.
std::string left_in_words(const diagnose::Diagnosis& found) {
  std::string words;
  for (const auto& cell : found.where)
    if (cell.significant) words += fmt::format(" {{{} {}}}", cell.factor, cell.cell);
  return words;
}

/// Diagnoses one data set.
std::string diagnose_one(const DataSet& set) {
  const auto hidden = diagnose::hide(set.kind, set.seed, set.surroundings);
  const auto start = std::chrono::steady_clock::now();
  const diagnose::Settings settings{.threads = cluster::crew().threads, .seed = set.seed};
  const auto found = diagnose::diagnose(hidden.data, settings, [](auto, auto, auto) {});
  const Answer answer(hidden, found);
  Outcome outcome(hidden, found, answer);
  outcome.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::string advised;
  if (set.advised) outcome.advice = diagnose::follow(hidden, found, settings, advised);
  const bool right = found.verdict == hidden.verdict && answer.right;
  return bytes_of(
      outcome,
      fmt::format(
          "{:<48} {:>4} {:<4} {:<16} {:<40} {:.2e} > {:.2e} > {:.2e} {:5.1f} s{}{}\n{}", hidden.title,
          set.seed, name_of(set.surroundings.bench), name_of(found.verdict), answer.said,
          found.gap.nominal_rmse, found.gap.recalibrated_rmse, found.gap.corrected_rmse, outcome.took_s,
          evidence_in_words(outcome) + (found.verdict == Verdict::unknown_effect ? left_in_words(found) : ""),
          right                                      ? ""
          : answer.within && !hidden.effects.empty() ? "  in the set"
                                                     : "  MISSED",
          advised));
}

void count_and_print(const std::string& bytes, Score& score) {
  Outcome outcome;
  std::memcpy(static_cast<void*>(&outcome), bytes.data(), sizeof outcome);
  score.count(outcome);
  fmt::print("{}", bytes.substr(sizeof outcome));
  std::fflush(stdout);
}

using Job = std::function<std::string(std::size_t)>;
using Take = std::function<void(std::size_t, const std::string&)>;

/// With the rest of the crew if there is one; rank 0 takes.
void diagnose_all(std::size_t count, const std::string& words, const Job& job, const Take& take) {
  if (cluster::crew().alone()) {
    for (std::size_t i = 0; i < count; ++i) take(i, job(i));
    return;
  }
  cluster::Workplace place("out/bench-diagnosis.ranks", cluster::crew());
  const auto program = output::read_regular(std::filesystem::read_symlink("/proc/self/exe"));
  place.begin(input::sha256_hex(program.value_or("")) + " " + words);
  cluster::share(place, "diagnosis", count, 1, cluster::Needed::by_rank_0, job, take);
  if (!cluster::crew().leads()) return;
  place.close();
  place.leave();
}

/// Diagnoses all of them; after Ctrl-C what was done by then is counted.
void score_all(const std::vector<DataSet>& sets, const std::string& words) {
  Score score;
  std::size_t taken = 0;
  run::catch_interrupts();
  try {
    diagnose_all(
        sets.size(), words, [&](std::size_t i) { return diagnose_one(sets[i]); },
        [&](std::size_t, const std::string& bytes) {
          count_and_print(bytes, score);
          ++taken;
        });
  } catch (const run::Interrupted&) {
    fmt::print("interrupted: {} of {} data sets\n", taken, sets.size());
  }
  if (cluster::crew().leads()) score.print();
}

void score_corrupted(const std::vector<std::string>& words) {
  std::uint64_t seed = 201;
  std::string only;
  for (const auto& word : words) {
    if (word.starts_with("only="))
      only = word.substr(5);
    else
      seed = std::strtoull(word.c_str(), nullptr, 10);
  }
  diagnose::score_corrupted(seed, only);
}

constexpr std::array benches{diagnose::Bench::thesis, diagnose::Bench::other_size,
                             diagnose::Bench::badly_known};

/// What has a title that begins so, on one bench after another.
std::vector<DataSet> all_sets(std::uint64_t first, std::uint64_t seeds, const std::string& wanted) {
  std::vector<DataSet> sets;
  for (std::size_t kind = 0; kind < diagnose::kinds(); ++kind)
    if (diagnose::title(kind).starts_with(wanted))
      for (std::uint64_t seed = first; seed < first + seeds; ++seed)
        sets.push_back({kind, seed, {.bench = benches.at((kind + seed) % benches.size())}});
  return sets;
}

/// Data sets as people have them: four to nine runs of 4 to 5 s.
diagnose::Surroundings few_runs(diagnose::Bench bench, std::uint64_t number) {
  constexpr std::array<std::size_t, 4> runs{4, 5, 6, 9};
  return {.bench = bench, .runs = runs.at(number % runs.size()), .lasting = 0.5};
}

/// Those in which nothing is hidden, on each bench, and on one that is off its data sheet.
std::vector<DataSet> nulls(std::uint64_t first, std::uint64_t seeds, const std::string& wanted) {
  std::vector<DataSet> sets;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed)
    for (std::size_t kind = 0; kind < diagnose::kinds(); ++kind) {
      const std::string& title = diagnose::title(kind);
      if (!title.starts_with("nothing") || !title.starts_with(wanted)) continue;
      for (const diagnose::Bench bench : benches) sets.push_back({kind, seed, few_runs(bench, kind + seed)});
      sets.push_back({kind, seed, few_runs(diagnose::Bench::thesis, kind + seed)});
      sets.back().surroundings.off_its_sheet = true;
    }
  return sets;
}

/// Small effects made weaker or twice as large, and what has no name, in few runs.
std::vector<DataSet> weak_ones(std::uint64_t first, std::uint64_t seeds, const std::string& wanted) {
  std::vector<DataSet> sets;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> exponent(-1.0, 0.3);
    for (std::size_t kind = 0; kind < diagnose::kinds(); ++kind) {
      const std::string& title = diagnose::title(kind);
      const bool small = title.ends_with(" small") && !title.starts_with("gauge:");
      if (!small && !title.starts_with("recalibrate") && !title.starts_with("unknown")) continue;
      DataSet set{kind, seed, few_runs(benches.at((kind + seed) % benches.size()), kind / 2 + seed)};
      if (small) set.surroundings.share = std::pow(10.0, exponent(random));
      if (title.starts_with(wanted)) sets.push_back(set);
    }
  }
  return sets;
}

/// So many data sets in which names may be open: little of an effect that has relatives (docs/effects.md), in
/// three or four short sines. Delays are not among them, as no current tells
/// which of the two it is.
std::vector<DataSet> open_ones(std::uint64_t first, std::size_t count) {
  constexpr std::array<std::string_view, 10> relatives{
      "viscous_damping", "guide_friction",  "bladder_hysteresis", "polytropic_gas",   "gas_temperature",
      "valve_lag",       "valve_dead_band", "valve_hysteresis",   "friction_warm_up", "encoder_backlash"};
  std::vector<DataSet> sets;
  std::mt19937_64 random(first);
  std::uniform_real_distribution<double> exponent(-1.3, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string wanted = fmt::format("{} small", relatives.at(i % relatives.size()));
    std::size_t kind = 0;
    while (diagnose::title(kind) != wanted) ++kind;
    sets.push_back({.kind = kind,
                    .seed = first + i / relatives.size(),
                    .surroundings = {.share = std::pow(10.0, exponent(random)),
                                     .runs = 3 + i % 2,
                                     .lasting = 0.4,
                                     .poor = true},
                    .advised = true});
  }
  return sets;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == "--corrupted") {
    if (cluster::crew().leads()) score_corrupted({words.begin() + 1, words.end()});
    return 0;
  }
  const std::string all = fmt::format("{}", fmt::join(words, " "));
  const std::string suite = !words.empty() && words.front().starts_with("--") ? words.front() : "";
  if (!suite.empty()) words.erase(words.begin());
  const auto number = [&](std::size_t at, std::uint64_t otherwise) {
    return words.size() > at ? std::strtoull(words[at].c_str(), nullptr, 10) : otherwise;
  };
  const std::uint64_t first = number(0, 101), seeds = number(1, 3);
  if (suite == "--pairs" || suite == "--doubts") {
    const unsigned threads = cluster::crew().threads;
    if (!cluster::crew().leads()) return 0;
    if (suite == "--pairs")
      diagnose::score_pairs(first, number(1, 1), threads);
    else
      diagnose::score_doubts(first, number(1, 30), threads);
    return 0;
  }
  try {
    const std::string wanted = words.size() > 2 ? words[2] : "";
    score_all(suite == "--nulls"    ? nulls(first, seeds, wanted)
              : suite == "--weak"   ? weak_ones(first, seeds, wanted)
              : suite == "--advice" ? open_ones(first, number(1, 60))
                                    : all_sets(first, seeds, wanted),
              all);
  } catch (const output::CannotWrite& error) {
    fmt::print(stderr, "mckibben: {}\n", error.what());
    return 74;
  }
  return 0;
}
