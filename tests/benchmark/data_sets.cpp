// See the header.
#include "data_sets.hpp"

#include <array>
#include <cmath>
#include <random>

#include <fmt/format.h>

namespace mckibben::diagnose {
namespace {

constexpr std::array benches{Bench::thesis, Bench::other_size, Bench::badly_known};

/// Data sets as people have them: four to nine runs of 4 to 5 s.
Surroundings few_runs(Bench bench, std::uint64_t number) {
  constexpr std::array<std::size_t, 4> runs{4, 5, 6, 9};
  return {.bench = bench, .runs = runs.at(number % runs.size()), .lasting = 0.5};
}

}  // namespace

std::string_view name_of(Bench bench) {
  return bench == Bench::thesis ? "" : bench == Bench::other_size ? "size" : "wide";
}

std::vector<DataSet> all_sets(std::uint64_t first, std::uint64_t seeds, const std::string& wanted) {
  std::vector<DataSet> sets;
  for (std::size_t kind = 0; kind < kinds(); ++kind) {
    if (!title(kind).starts_with(wanted)) continue;
    Surroundings surroundings;
    if (title(kind).find("nothing") == std::string::npos) surroundings.off_by = 1.0;
    for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
      surroundings.bench = benches.at((kind + seed) % benches.size());
      sets.push_back({kind, seed, surroundings});
    }
  }
  return sets;
}

std::vector<DataSet> nulls(std::uint64_t first, std::uint64_t seeds, const std::string& wanted) {
  std::vector<DataSet> sets;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed)
    for (std::size_t kind = 0; kind < kinds(); ++kind) {
      const std::string& title = diagnose::title(kind);
      if (!title.starts_with("nothing") || !title.starts_with(wanted)) continue;
      for (const Bench bench : benches) sets.push_back({kind, seed, few_runs(bench, kind + seed)});
      sets.push_back({kind, seed, few_runs(Bench::thesis, kind + seed)});
      sets.back().surroundings.off_by = 0.3;
    }
  return sets;
}

std::vector<DataSet> weak_ones(std::uint64_t first, std::uint64_t seeds, const std::string& wanted) {
  std::vector<DataSet> sets;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> exponent(-1.0, 0.3);
    for (std::size_t kind = 0; kind < kinds(); ++kind) {
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

std::vector<DataSet> off_sheet(std::uint64_t first, std::uint64_t seeds, const std::string& wanted) {
  std::vector<DataSet> sets;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed)
    for (std::size_t kind = 0; kind < kinds(); ++kind) {
      if (!title(kind).starts_with(wanted)) continue;
      Surroundings surroundings = few_runs(Bench::other_size, kind + seed);
      surroundings.off_sheet = (kind / 2 + seed) % 2 == 0 ? OffSheet::each_by_one : OffSheet::two_by_three;
      sets.push_back({kind, seed, surroundings});
    }
  return sets;
}

std::vector<DataSet> other_laws(std::uint64_t first, std::uint64_t seeds, const std::string& wanted) {
  std::vector<DataSet> sets;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed)
    for (const char* hidden : {"nothing, white", "muscle_leak large", "bladder_elasticity large",
                               "valve_dead_band large", "encoder_backlash large"})
      for (const OtherLaw law :
           {OtherLaw::stick_slip, OtherLaw::area_friction, OtherLaw::braid, OtherLaw::valve}) {
        if (!std::string_view(hidden).starts_with(wanted)) continue;
        const std::size_t kind = kind_titled(hidden);
        Surroundings surroundings = few_runs(benches.at(seed % 2), kind + seed);
        surroundings.other_law = law;
        sets.push_back({kind, seed, surroundings});
      }
  return sets;
}

std::vector<DataSet> open_ones(std::uint64_t first, std::size_t count) {
  std::vector<DataSet> sets;
  std::mt19937_64 random(first);
  std::uniform_real_distribution<double> exponent(-1.3, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    sets.push_back({.kind = kind_titled(fmt::format("{} small", relatives.at(i % relatives.size()))),
                    .seed = first + i / relatives.size(),
                    .surroundings = {.share = std::pow(10.0, exponent(random)),
                                     .runs = 3 + i % 2,
                                     .lasting = 0.4,
                                     .poor = true},
                    .advised = true});
  }
  return sets;
}

}  // namespace mckibben::diagnose
