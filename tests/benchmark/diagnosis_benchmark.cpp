// Scores the diagnosis on data with something hidden in it.
//
//   benchmark_diagnosis [SEED [SEEDS [TITLE]]]   seeds SEED to SEED + SEEDS - 1 (default 101, 3 of them), of
//                                                what has a title that begins so (default: all)
//   benchmark_diagnosis --corrupted [SEED [only=NAME]]   the same for data that were spoilt on purpose
//
// Started by mpirun or srun, its processes share the data sets out and meet in out/bench-diagnosis.ranks.
// Thresholds of the workflow were set on seeds below 100.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <sim/cluster/share.hpp>
#include <sim/diagnose/diagnose.hpp>
#include <sim/input/hash.hpp>

#include "corrupted_benchmark.hpp"
#include "hidden_effects.hpp"

namespace {

using namespace mckibben;
using diagnose::Verdict;

std::string_view name_of(Verdict verdict) {
  for (const auto& [value, name] : names(verdict))
    if (value == verdict) return name;
  return {};
}

struct Tally {
  int yes = 0, of = 0;
  void count(bool hit) {
    yes += hit ? 1 : 0;
    ++of;
  }
  void print(const char* what) const {
    fmt::print("{:<44} {:>4} of {:<4} {:5.1f} %\n", what, yes, of, of == 0 ? 0.0 : 100.0 * yes / of);
  }
};

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
      declared.insert(effect.confusable_with.begin(), effect.confusable_with.end());
      said += (said.empty() ? "" : " + ") + effect.name;
      if (!effect.confusable_with.empty())
        said += fmt::format(" (or {})", fmt::join(effect.confusable_with, ", "));
    }
    const Names truth(hidden.effects.begin(), hidden.effects.end());
    right = named == truth;
    within = holds(declared, truth);
  }
};

/// What counts of a diagnosis.
struct Outcome {
  Verdict hidden{}, found{};
  bool right = false, within = false, wrong_name = false, closed = false;
  int covered = 0, parameters = 0;  ///< true ones in their intervals, of
  double took_s = 0.0;

  Outcome(const diagnose::Hidden& truth, const diagnose::Diagnosis& diagnosis, const Answer& answer)
      : hidden(truth.verdict),
        found(diagnosis.verdict),
        right(answer.right),
        within(answer.within),
        wrong_name(!answer.named.empty() &&
                   !holds({truth.effects.begin(), truth.effects.end()}, answer.named)),
        closed(diagnosis.gap.closed >= 0.9) {
    for (const auto& planted : truth.truth)
      for (const auto& effect : diagnosis.effects)
        for (const auto& p : effect.parameters)
          if (planted.path == "effects." + effect.name + "." + p.name) {
            covered += planted.value >= p.low && planted.value <= p.high ? 1 : 0;
            ++parameters;
          }
  }
  Outcome() = default;
};

class Score {
 public:
  void count(const Outcome& outcome) {
    slowest_s_ = std::max(slowest_s_, outcome.took_s);
    if (outcome.hidden == Verdict::missing_effect) {
      first_name_.count(outcome.right && outcome.found == Verdict::missing_effect);
      in_set_.count(outcome.within);
      if (outcome.right) {
        closed_.count(outcome.closed);
        covered_.yes += outcome.covered;
        covered_.of += outcome.parameters;
      }
    }
    if (outcome.hidden == Verdict::nothing_missing)
      false_alarms_.count(outcome.found != Verdict::nothing_missing && outcome.found != Verdict::cannot_tell);
    if (outcome.hidden == Verdict::recalibrate) recalibrated_.count(outcome.found == Verdict::recalibrate);
    if (outcome.hidden == Verdict::unknown_effect) unknown_.count(outcome.found == Verdict::unknown_effect);
    wrong_names_.count(outcome.wrong_name);
  }

  void print() const {
    first_name_.print("effects: right name first");
    in_set_.print("effects: right name in the declared set");
    closed_.print("effects: gap on held-out runs closed by 90 %");
    covered_.print("effects: true parameter in its interval");
    recalibrated_.print("changed nominal parameter: recalibrate");
    unknown_.print("unknown laws recognised");
    false_alarms_.print("nothing hidden: false alarms");
    wrong_names_.print("wrong names (all data sets)");
    fmt::print("slowest diagnosis {:.1f} s\n", slowest_s_);
  }

 private:
  Tally first_name_, in_set_, false_alarms_, unknown_, wrong_names_, covered_, closed_, recalibrated_;
  double slowest_s_ = 0.0;
};

/// A diagnosis for another process: its outcome and its line, as bytes.
std::string bytes_of(const Outcome& outcome, const std::string& line) {
  return std::string(reinterpret_cast<const char*>(&outcome), sizeof outcome) + line;
}

/// Diagnoses one data set.
std::string diagnose_one(std::size_t kind, std::uint64_t seed) {
  const auto hidden = diagnose::hide(kind, seed);
  const auto start = std::chrono::steady_clock::now();
  const auto found = diagnose::diagnose(hidden.data, {.threads = cluster::crew().threads, .seed = seed},
                                        [](auto, auto, auto) {});
  const Answer answer(hidden, found);
  Outcome outcome(hidden, found, answer);
  outcome.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return bytes_of(
      outcome, fmt::format("{:<48} {:>4} {:<16} {:<40} {:.2e} > {:.2e} > {:.2e} {:5.1f} s{}\n", hidden.title,
                           seed, name_of(found.verdict), answer.said, found.gap.nominal_rmse,
                           found.gap.recalibrated_rmse, found.gap.corrected_rmse, outcome.took_s,
                           found.verdict == hidden.verdict && answer.right ? ""
                           : answer.within && !hidden.effects.empty()      ? "  in the set"
                                                                           : "  MISSED"));
}

void count_and_print(const std::string& bytes, Score& score) {
  Outcome outcome;
  std::memcpy(static_cast<void*>(&outcome), bytes.data(), sizeof outcome);
  score.count(outcome);
  fmt::print("{}", bytes.substr(sizeof outcome));
  std::fflush(stdout);
}

struct DataSet {
  std::size_t kind = 0;
  std::uint64_t seed = 0;
};

/// Diagnoses all of them, with the rest of the crew if there is one; rank 0 prints.
void score_all(const std::vector<DataSet>& sets, const std::string& words) {
  Score score;
  const auto job = [&](std::size_t i) { return diagnose_one(sets[i].kind, sets[i].seed); };
  const auto take = [&](std::size_t, const std::string& bytes) { count_and_print(bytes, score); };
  if (cluster::crew().alone()) {
    for (std::size_t i = 0; i < sets.size(); ++i) take(i, job(i));
    return score.print();
  }
  cluster::Workplace place("out/bench-diagnosis.ranks", cluster::crew());
  const auto program = output::read_regular(std::filesystem::read_symlink("/proc/self/exe"));
  place.begin(input::sha256_hex(program.value_or("")) + " " + words);
  cluster::share(place, "diagnosis", sets.size(), 1, cluster::Needed::by_rank_0, job, take);
  if (!cluster::crew().leads()) return;
  place.close();
  place.leave();
  score.print();
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

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == "--corrupted") {
    if (cluster::crew().leads()) score_corrupted({words.begin() + 1, words.end()});
    return 0;
  }
  const auto number = [&](std::size_t at, std::uint64_t otherwise) {
    return words.size() > at ? std::strtoull(words[at].c_str(), nullptr, 10) : otherwise;
  };
  const std::uint64_t first = number(0, 101), seeds = number(1, 3);
  const std::string wanted = words.size() > 2 ? words[2] : "";
  std::vector<DataSet> sets;
  for (std::size_t kind = 0; kind < diagnose::kinds(); ++kind)
    if (diagnose::title(kind).starts_with(wanted))
      for (std::uint64_t seed = first; seed < first + seeds; ++seed) sets.push_back({kind, seed});
  try {
    score_all(sets, fmt::format("{} {} {}", first, seeds, wanted));
  } catch (const output::CannotWrite& error) {
    fmt::print(stderr, "mckibben: {}\n", error.what());
    return 74;
  }
  return 0;
}
