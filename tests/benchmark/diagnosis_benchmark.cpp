// Scores the diagnosis on data with something hidden in it.
//
//   benchmark_diagnosis [SEED [SEEDS [TITLE]]]   seeds SEED to SEED + SEEDS - 1 (default 101, 3 of them), of
//                                                what has a title that begins so (default: all)
//   benchmark_diagnosis --corrupted [SEED [only=NAME]]   the same for data that were spoilt on purpose
//
// Thresholds of the workflow were set on seeds below 100.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <sim/diagnose/diagnose.hpp>

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

class Score {
 public:
  void count(const diagnose::Hidden& hidden, const diagnose::Diagnosis& found, const Answer& answer) {
    if (hidden.verdict == Verdict::missing_effect) {
      first_name_.count(answer.right && found.verdict == Verdict::missing_effect);
      in_set_.count(answer.within);
      if (answer.right) count_sizes(hidden, found);
    }
    if (hidden.verdict == Verdict::nothing_missing)
      false_alarms_.count(found.verdict != Verdict::nothing_missing && found.verdict != Verdict::cannot_tell);
    if (hidden.verdict == Verdict::recalibrate) recalibrated_.count(found.verdict == Verdict::recalibrate);
    if (hidden.verdict == Verdict::unknown_effect) unknown_.count(found.verdict == Verdict::unknown_effect);
    wrong_names_.count(!answer.named.empty() &&
                       !holds({hidden.effects.begin(), hidden.effects.end()}, answer.named));
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
  }

 private:
  void count_sizes(const diagnose::Hidden& hidden, const diagnose::Diagnosis& found) {
    closed_.count(found.gap.closed >= 0.9);
    for (const auto& planted : hidden.truth)
      for (const auto& effect : found.effects)
        for (const auto& p : effect.parameters)
          if (planted.path == "effects." + effect.name + "." + p.name)
            covered_.count(planted.value >= p.low && planted.value <= p.high);
  }

  Tally first_name_, in_set_, false_alarms_, unknown_, wrong_names_, covered_, closed_, recalibrated_;
};

/// Diagnoses one data set, counts and prints what came out. Returns how long it took.
double diagnose_one(std::size_t kind, std::uint64_t seed, Score& score) {
  const auto hidden = diagnose::hide(kind, seed);
  const auto start = std::chrono::steady_clock::now();
  const auto found = diagnose::diagnose(hidden.data, {.threads = 0, .seed = seed}, [](auto, auto, auto) {});
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Answer answer(hidden, found);
  score.count(hidden, found, answer);
  fmt::print("{:<48} {:>4} {:<16} {:<40} {:.2e} > {:.2e} > {:.2e} {:5.1f} s{}\n", hidden.title, seed,
             name_of(found.verdict), answer.said, found.gap.nominal_rmse, found.gap.recalibrated_rmse,
             found.gap.corrected_rmse, took_s,
             found.verdict == hidden.verdict && answer.right ? ""
             : answer.within && !hidden.effects.empty()      ? "  in the set"
                                                             : "  MISSED");
  std::fflush(stdout);
  return took_s;
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
    score_corrupted({words.begin() + 1, words.end()});
    return 0;
  }
  const auto number = [&](std::size_t at, std::uint64_t otherwise) {
    return words.size() > at ? std::strtoull(words[at].c_str(), nullptr, 10) : otherwise;
  };
  const std::uint64_t first = number(0, 101), seeds = number(1, 3);
  const std::string wanted = words.size() > 2 ? words[2] : "";
  Score score;
  double slowest_s = 0.0;
  for (std::size_t kind = 0; kind < diagnose::kinds(); ++kind)
    if (diagnose::title(kind).starts_with(wanted))
      for (std::uint64_t seed = first; seed < first + seeds; ++seed)
        slowest_s = std::max(slowest_s, diagnose_one(kind, seed, score));
  score.print();
  fmt::print("slowest diagnosis {:.1f} s\n", slowest_s);
  return 0;
}
