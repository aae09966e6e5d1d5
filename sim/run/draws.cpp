// Numbers by chance from counters instead of sequences (Salmon et al. 2011: "as easy as 1, 2, 3"), here with
// the mixing function of SplitMix64 (Steele, Lea & Flood 2014); a permutation that is calculated instead of
// kept: a Feistel network over the next power of four, walked until it is back in range (Black & Rogaway
// 2002).
#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include <sim/domain/rig_number.hpp>
#include <sim/run/draws.hpp>

namespace mckibben::run {
namespace {

constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

std::uint64_t mixed(std::uint64_t one, std::uint64_t other) {
  return mixed(mixed(one) ^ other);
}

/// Above 0 and below 1.
double uniform(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11U) + 0.5) * 0x1p-53;
}

double below(double x) {
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

double drawn(const domain::Varied& number, double probability) {
  if (number.law == domain::DrawLaw::uniform) return number.low + probability * (number.high - number.low);
  const double cut = below(-domain::most_deviations);
  return std::clamp(number.middle + number.deviation * normal_quantile(cut + probability * (1.0 - 2.0 * cut)),
                    number.low, number.high);
}

}  // namespace

std::uint64_t permuted(std::uint64_t value, std::uint64_t count, std::uint64_t key) {
  const auto half = static_cast<unsigned>(std::bit_width(count - 1) + 1) / 2;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  do {
    std::uint64_t left = value >> half, right = value & mask;
    for (std::uint64_t round = 0; round < 6; ++round) {
      const std::uint64_t next = left ^ (mixed(mixed(key, round), right) & mask);
      left = right;
      right = next;
    }
    value = left << half | right;
  } while (value >= count);
  return value;
}

// Abramowitz & Stegun 26.2.23 is right to 4.5e-4; Newton's method does the rest.
double normal_quantile(double probability) {
  const double tail = std::min(probability, 1.0 - probability);
  const double t = std::sqrt(-2.0 * std::log(tail));
  double x = -(t - (2.515517 + t * (0.802853 + t * 0.010328)) /
                       (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308))));
  for (int step = 0; step < 3; ++step)
    x -= (below(x) - tail) * std::sqrt(2.0 * std::numbers::pi) * std::exp(0.5 * x * x);
  return probability < 0.5 ? x : -x;
}

std::vector<double> draws(const domain::Variation& variation, std::uint64_t seed, int repeats, int repeat) {
  const auto count = static_cast<std::uint64_t>(repeats), place = static_cast<std::uint64_t>(repeat - 1);
  std::vector<double> values;
  for (const auto& number : variation.numbers) {
    const std::uint64_t key = mixed(seed, values.size());
    double probability = uniform(mixed(key, place));
    if (variation.sampling == domain::Sampling::latin_hypercube)
      probability =
          (static_cast<double>(permuted(place, count, key)) + probability) / static_cast<double>(count);
    values.push_back(drawn(number, probability));
  }
  return values;
}

std::vector<double> draws(const domain::Campaign& campaign, int repeat) {
  return draws(campaign.vary, campaign.seed, campaign.repeats, repeat);
}

plant::Rig with_numbers(plant::Rig rig, const domain::Variation& variation,
                        const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    *domain::find_number(rig, variation.numbers[i].path).value = values[i];
  return rig;
}

plant::Rig drawn_rig(const domain::Campaign& campaign, int repeat) {
  return with_numbers(campaign.rig, campaign.vary, draws(campaign, repeat));
}

std::string unfit(const plant::Rig& rig, double load_kg) {
  if (std::string broken = domain::broken_rule(rig); !broken.empty()) return broken;
  const std::string heavy = domain::too_heavy(load_kg, rig);
  return heavy.empty() ? "" : fmt::format("{:g} kg: {}", load_kg, heavy);
}

}  // namespace mckibben::run
