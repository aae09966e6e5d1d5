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
#include <string_view>

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

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == "--corrupted") {
    std::uint64_t seed = 201;
    std::string only;
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (words[i].starts_with("only="))
        only = words[i].substr(5);
      else
        seed = std::strtoull(words[i].c_str(), nullptr, 10);
    }
    diagnose::score_corrupted(seed, only);
    return 0;
  }
  const auto number = [&](int at, std::uint64_t otherwise) {
    return argc > at ? std::strtoull(argv[at], nullptr, 10) : otherwise;
  };
  const std::uint64_t first = number(1, 101), seeds = number(2, 3);
  const std::string wanted = argc > 3 ? argv[3] : "";
  Tally first_name, in_set, false_alarms, unknown, wrong_names, covered, closed, recalibrated;
  double slowest_s = 0.0;
  for (std::size_t kind = 0; kind < diagnose::kinds(); ++kind) {
    if (!diagnose::title(kind).starts_with(wanted)) continue;
    for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
      const auto hidden = diagnose::hide(kind, seed);
      const auto start = std::chrono::steady_clock::now();
      const auto found =
          diagnose::diagnose(hidden.data, {.threads = 0, .seed = seed}, [](auto, auto, auto) {});
      const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      slowest_s = std::max(slowest_s, took_s);
      std::set<std::string> named, declared;
      std::string said;
      for (const auto& effect : found.effects) {
        named.insert(effect.name);
        declared.insert(effect.name);
        declared.insert(effect.confusable_with.begin(), effect.confusable_with.end());
        said += (said.empty() ? "" : " + ") + effect.name;
        if (!effect.confusable_with.empty())
          said += fmt::format(" (or {})", fmt::join(effect.confusable_with, ", "));
      }
      const std::set<std::string> truth(hidden.effects.begin(), hidden.effects.end());
      const bool right = named == truth;
      const bool within = std::includes(declared.begin(), declared.end(), truth.begin(), truth.end());
      if (hidden.verdict == Verdict::missing_effect) {
        first_name.count(right && found.verdict == Verdict::missing_effect);
        in_set.count(within);
        if (right) {
          closed.count(found.gap.closed >= 0.9);
          for (const auto& planted : hidden.truth) {
            for (const auto& effect : found.effects)
              for (const auto& p : effect.parameters)
                if (planted.path == "effects." + effect.name + "." + p.name)
                  covered.count(planted.value >= p.low && planted.value <= p.high);
          }
        }
      }
      if (hidden.verdict == Verdict::nothing_missing)
        false_alarms.count(found.verdict != Verdict::nothing_missing &&
                           found.verdict != Verdict::cannot_tell);
      if (hidden.verdict == Verdict::recalibrate) recalibrated.count(found.verdict == Verdict::recalibrate);
      if (hidden.verdict == Verdict::unknown_effect) unknown.count(found.verdict == Verdict::unknown_effect);
      wrong_names.count(!named.empty() &&
                        !std::includes(truth.begin(), truth.end(), named.begin(), named.end()));
      fmt::print("{:<48} {:>4} {:<16} {:<40} {:.2e} > {:.2e} > {:.2e} {:5.1f} s{}\n", hidden.title, seed,
                 name_of(found.verdict), said, found.gap.nominal_rmse, found.gap.recalibrated_rmse,
                 found.gap.corrected_rmse, took_s,
                 found.verdict == hidden.verdict && right ? ""
                 : within && !truth.empty()               ? "  in the set"
                                                          : "  MISSED");
      std::fflush(stdout);
    }
  }
  first_name.print("effects: right name first");
  in_set.print("effects: right name in the declared set");
  closed.print("effects: gap on held-out runs closed by 90 %");
  covered.print("effects: true parameter in its interval");
  recalibrated.print("changed nominal parameter: recalibrate");
  unknown.print("unknown laws recognised");
  false_alarms.print("nothing hidden: false alarms");
  wrong_names.print("wrong names (all data sets)");
  fmt::print("slowest diagnosis {:.1f} s\n", slowest_s);
  return 0;
}
