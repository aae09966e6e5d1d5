// See the header.
#include "corrupted_benchmark.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include <sim/data/finding.hpp>
#include <sim/engine/failure.hpp>

#include "corruptions.hpp"

namespace mckibben::diagnose {
namespace {

struct Said {
  std::string verdict, sentence;
  std::vector<std::string> effects{};
};

Said said_of(const domain::Dataset& data, const Asked& asked) {
  try {
    const auto found = whole_diagnosis(data, asked);
    Said said{.verdict = {}, .sentence = found.because};
    for (const std::string& warning : found.warnings) said.sentence += " | " + warning;
    for (const auto& [value, name] : names(found.verdict))
      if (value == found.verdict) said.verdict = name;
    for (const auto& effect : found.effects) said.effects.push_back(effect.name);
    return said;
  } catch (const data::UnfitData& unfit) {
    return {.verdict = "refused", .sentence = unfit.what()};
  } catch (const engine::NumericalFailure& failure) {
    return {.verdict = "failed", .sentence = failure.what()};
  }
}

bool names_it(const Corruption& corruption, const std::string& sentence) {
  return sentence.find(corruption.run) != std::string::npos &&
         std::any_of(corruption.culprit.begin(), corruption.culprit.end(),
                     [&](const std::string& word) { return sentence.find(word) != std::string::npos; });
}

}  // namespace

void score_corrupted(Asked asked, std::uint64_t first, std::uint64_t seeds, const std::string& wanted) {
  int all = 0, wrong = 0, named = 0, within_noise = 0, kept = 0, hidden_effects = 0;
  std::vector<Hidden> bases;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed)
    for (Hidden& base : sound_data(seed)) bases.push_back(std::move(base));
  for (const Hidden& base : bases) {
    asked.seed = base.seed;
    for (const Corruption& corruption : corruptions()) {
      const std::string label = base.title + ": " + corruption.name;
      if (!label.starts_with(wanted)) continue;
      domain::Dataset data = base.data;
      corruption.spoil(data);
      const auto start = std::chrono::steady_clock::now();
      const Said said = said_of(data, asked);
      const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const bool right = names_it(corruption, said.sentence);
      const bool wrongly = std::any_of(said.effects.begin(), said.effects.end(), [&](const auto& effect) {
        return std::ranges::find(base.effects, effect) == base.effects.end() &&
               std::ranges::find(corruption.effects, effect) == corruption.effects.end();
      });
      const bool silent = said.verdict == "nothing_missing" && !right;
      ++all;
      named += right ? 1 : 0;
      wrong += wrongly ? 1 : 0;
      within_noise += silent ? 1 : 0;
      hidden_effects += base.effects.empty() ? 0 : 1;
      kept += !said.effects.empty() && !wrongly ? 1 : 0;
      fmt::print("{:<56} {:<16} {:<26} {:6.1f} s  {}{}{}\n    {}\n", label, said.verdict,
                 fmt::join(said.effects, " + "), took_s, right ? "" : "NOT NAMED ",
                 wrongly ? "WRONG NAME " : "", silent ? "WITHIN NOISE" : "", said.sentence);
      std::fflush(stdout);
    }
  }
  fmt::print("{:<44} {:>4} of {}\n", "culprits named", named, all);
  fmt::print("{:<44} {:>4} of {}\n", "wrong names", wrong, all);
  fmt::print("{:<44} {:>4} of {}\n", "\"within noise\", no culprit named", within_noise, all);
  fmt::print("{:<44} {:>4} of {}\n", "effects named all the same", kept, hidden_effects);
}

}  // namespace mckibben::diagnose
