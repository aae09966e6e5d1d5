// What was measured: `bench diagnosis --weak 841 4` and `--nulls 830 15` print it.
#include <algorithm>
#include <cmath>

#include <sim/diagnose/record.hpp>

namespace mckibben::diagnose {

constinit const Record record{.measured = "2026-11-25",
                              .null_seeds = "830 to 844",
                              .false_alarms = {4, 300},
                              .names = {{{0.0, {27, 28}}, {50.0, {29, 29}}}},
                              .first_of_several = {6, 9}};

std::array<double, 2> Share::interval() const {
  constexpr double z = thresholds.interval.normal;
  const double n = of, p = value(), middle = p + z * z / (2.0 * n);
  const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n)), all = 1.0 + z * z / n;
  return {std::max(0.0, middle - half) / all, std::min(1.0, (middle + half) / all)};
}

double margin(const Support& support) {
  return std::min(support.fall, support.before_rivals);
}

std::optional<Share> confidence(const Diagnosis& diagnosis, const NamedEffect& effect) {
  const bool of_catalogue = std::ranges::any_of(
      catalogue(), [&](const Candidate& candidate) { return candidate.effect == effect.name; });
  if (diagnosis.gap.judged != Judged::contraction || !of_catalogue || effect.stands_in ||
      diagnosis.remaining.is_more_than_noise())
    return std::nullopt;
  const auto measured = [](const Share& share) { return share.of > 0 ? std::optional(share) : std::nullopt; };
  if (!effect.confusable_with.empty()) return measured(record.first_of_several);
  const auto above = std::ranges::upper_bound(record.names, margin(effect.support), {}, &Bin::margin);
  if (above == record.names.begin()) return std::nullopt;
  return measured(std::prev(above)->right);
}

}  // namespace mckibben::diagnose
