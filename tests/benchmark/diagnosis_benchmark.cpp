// Scores the diagnosis on data with something hidden in it.
//
//   benchmark_diagnosis -v ...                   any of these, each step of the search as well
//   benchmark_diagnosis [SEED [SEEDS [TITLE]]]   seeds SEED to SEED + SEEDS - 1 (default 101, 3 of them), of
//                                                what has a title that begins so (default: all)
//   benchmark_diagnosis --nulls [SEED [SEEDS [TITLE]]]   the same where nothing is hidden, on four benches
//   benchmark_diagnosis --off-sheet [SEED [SEEDS [TITLE]]]   every kind on rigs of other sizes whose numbers
//                                                are each one deviation off, or two of them three
//   benchmark_diagnosis --other-laws [SEED [SEEDS [TITLE]]]   nothing or a plain effect beside a law that no
//                                                catalogue has: of friction, of the braid, of the valve
//   benchmark_diagnosis --weak [SEED [SEEDS [TITLE]]]   effects of 10 to 200 % of a small size, other numbers
//                                                and laws of no catalogue in four to nine short runs: how
//                                                often a name is right that is given with such evidence
//   benchmark_diagnosis --advice [SEED [SETS]]   SETS data sets (default 60), three or four short sines with
//                                                little of an effect that has relatives: where a name is
//                                                open, the measurement that is asked for is made, and all is
//                                                diagnosed again
//   benchmark_diagnosis --pairs [SEED [SEEDS]]   two muscles on one wheel, an effect in one, both or none
//   benchmark_diagnosis --corrupted [SEED [SEEDS [TITLE]]]   the same for data that were spoilt on purpose
//
// Every third data set is of the thesis's rig, of one of another size, of one that is badly known.
// Started by mpirun or srun, its processes share the data sets out and meet in out/bench-diagnosis.ranks.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <plant/names.hpp>
#include <sim/cluster/share.hpp>
#include <sim/input/hash.hpp>
#include <sim/run/batch.hpp>

#include "corrupted_benchmark.hpp"
#include "data_sets.hpp"
#include "pairs_benchmark.hpp"
#include "score.hpp"
#include "whole.hpp"

namespace {

using namespace mckibben;
using diagnose::DataSet;
using diagnose::Outcome;
using diagnose::Verdict;

/// A diagnosis for another process: its outcome and its line, as bytes.
std::string bytes_of(const Outcome& outcome, const std::string& line) {
  return std::string(reinterpret_cast<const char*>(&outcome), sizeof outcome) + line;
}

/// The evidence for each name, and numbers whose interval misses the true one.
std::string evidence_in_words(const Outcome& outcome) {
  std::string words;
  for (std::size_t i = 0; i < outcome.names; ++i)
    words += fmt::format(" [ahead by {:.1f}{}]", outcome.given.at(i).margin,
                         outcome.given.at(i).right ? "" : ", wrong");
  if (outcome.simpler) words += " [a simpler explanation does as well]";
  if (const auto& numbers = outcome.numbers; numbers.inside < numbers.of)
    words += fmt::format(" [{} of {} numbers in their intervals]", numbers.inside, numbers.of);
  return words;
}

/// Parts of the data in which more is left than chance.
std::string left_in_words(const diagnose::Diagnosis& found) {
  std::string words;
  for (const auto& cell : found.where)
    if (cell.significant) words += fmt::format(" {{{} {}}}", cell.factor, cell.cell);
  return words;
}

/// The rig's numbers as told beside the true ones, and what was told of each candidate.
void print_numbers(const diagnose::Hidden& hidden, const diagnose::Diagnosis& found) {
  for (const auto& one : found.recalibrated)
    for (const auto& number : hidden.numbers)  // half a 95 % interval is 1
      if (number.path == one.fitted.name)
        fmt::print("    {} {:.6g}, truly {:.6g}: off by {:.2f} of its half interval, {:.2f} deviations\n",
                   one.fitted.name, one.fitted.value, number.value,
                   2.0 * (one.fitted.value - number.value) / (one.fitted.high - one.fitted.low),
                   one.deviations);
  for (const auto& one : found.ranking)
    fmt::print("    {} {} {:.1f} {:.1f}: {}\n", one.name, one.variant, one.score, one.fall, one.outcome);
  fmt::print("    {}\n", found.because);
}

bool verbose = false;

/// Diagnoses one data set.
std::string diagnose_one(const DataSet& set) {
  const auto hidden = diagnose::hide(set.kind, set.seed, set.surroundings);
  const auto start = std::chrono::steady_clock::now();
  diagnose::Asked asked{.threads = cluster::crew().threads, .seed = set.seed};
  if (verbose) asked.say = [](const std::string& what) { fmt::print("{}\n", what); };
  const auto found = diagnose::whole_diagnosis(hidden.data, asked);
  if (verbose) print_numbers(hidden, found);
  const diagnose::Answer answer(hidden, found);
  Outcome outcome(hidden, found, answer);
  outcome.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::string advised;
  if (set.advised) outcome.advice = diagnose::follow(hidden, found, asked, advised);
  return bytes_of(
      outcome,
      fmt::format(
          "{:<48} {:>4} {:<4} {:<16} {:<40} {:.2e} > {:.2e} > {:.2e} {:5.1f} s{}{}\n{}",
          hidden.title + std::string(plant::name_of(set.surroundings.other_law)), set.seed,
          name_of(set.surroundings.bench), plant::name_of(found.verdict), answer.said, found.gap.nominal_rmse,
          found.gap.recalibrated_rmse, found.gap.corrected_rmse, outcome.took_s,
          evidence_in_words(outcome) + (found.verdict == Verdict::unknown_effect ? left_in_words(found) : ""),
          answer.well                                ? std::string()
          : answer.within && !hidden.effects.empty() ? "  in the set"
                                                     : fmt::format("  MISSED: {}", found.because),
          advised));
}

void count_and_print(const std::string& bytes, diagnose::Score& score) {
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
  diagnose::Score score;
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

constexpr std::array suites{"",       "--nulls",  "--off-sheet", "--other-laws",
                            "--weak", "--advice", "--pairs",     "--corrupted"};

bool is_number(const std::string& word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
}

/// Whether a suite takes these words: at most two numbers, then a title.
bool are_understood(const std::string& suite, const std::vector<std::string>& words) {
  if (std::ranges::find(suites, suite) == suites.end()) return false;
  return words.size() <= 3 &&
         std::all_of(words.begin(), words.begin() + std::min<std::ptrdiff_t>(std::ssize(words), 2),
                     is_number);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  verbose = std::erase(words, "-v") > 0;
  const std::string all = fmt::format("{}", fmt::join(words, " "));
  const std::string suite = !words.empty() && words.front().starts_with("--") ? words.front() : "";
  if (!suite.empty()) words.erase(words.begin());
  if (!are_understood(suite, words)) {
    fmt::print(stderr, "usage: bench diagnosis [{}] [SEED [SEEDS [TITLE]]], see docs/testing.md\n",
               fmt::join(std::next(suites.begin()), suites.end(), " | "));
    return suite == "--help" ? 0 : 64;
  }
  const auto number = [&](std::size_t at, std::uint64_t otherwise) {
    return words.size() > at ? std::strtoull(words[at].c_str(), nullptr, 10) : otherwise;
  };
  const std::uint64_t first = number(0, 101), seeds = number(1, 3);
  if (suite == "--pairs") {
    if (cluster::crew().leads()) diagnose::score_pairs(first, number(1, 1), cluster::crew().threads);
    return 0;
  }
  const std::string wanted = words.size() > 2 ? words[2] : "";
  if (suite == "--corrupted") {
    diagnose::Asked asked{};
    if (verbose) asked.say = [](const std::string& what) { fmt::print("{}\n", what); };
    if (cluster::crew().leads()) diagnose::score_corrupted(asked, first, seeds, wanted);
    return 0;
  }
  try {
    score_all(suite == "--nulls"        ? diagnose::nulls(first, seeds, wanted)
              : suite == "--off-sheet"  ? diagnose::off_sheet(first, seeds, wanted)
              : suite == "--other-laws" ? diagnose::other_laws(first, seeds, wanted)
              : suite == "--weak"       ? diagnose::weak_ones(first, seeds, wanted)
              : suite == "--advice"     ? diagnose::open_ones(first, number(1, 60))
                                        : diagnose::all_sets(first, seeds, wanted),
              all);
  } catch (const output::CannotWrite& error) {
    fmt::print(stderr, "mckibben: {}\n", error.what());
    return 74;
  }
  return 0;
}
