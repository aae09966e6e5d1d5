// Priors by path; see the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

using Stated = plant::Spreads;

/// The deviation that a rig's file states, of a value; none if it says nothing. What it says of the side of
/// muscle 1 holds for muscle 2 as well, until it says otherwise.
std::optional<double> deviation_of(const Stated& stated, std::string_view path, double value, double usual) {
  auto said = stated.find(std::string(path));
  if (said == stated.end()) said = stated.find(std::string(of_muscle_1(path)));
  if (said == stated.end()) return std::nullopt;
  if (std::isfinite(said->second)) return said->second;
  return std::max(thresholds.parameter.unknown * std::abs(value), thresholds.parameter.unknown_usual * usual);
}

/// Where a number stands; of a pair, whether it is that of both sides.
struct Standing {
  std::string path;
  bool both_sides = false;
};

/// The part of a side that a path leads into: `muscle.`, `effects.muscle_leak.`; empty if it is none.
std::string_view part_of_side(std::string_view path) {
  constexpr std::string_view of_effects = "effects.";
  constexpr std::array<std::string_view, 5> parts{"muscle.", "friction.", "valve.", "hose.", of_effects};
  if (std::none_of(parts.begin(), parts.end(), [&](auto part) { return path.starts_with(part); })) return {};
  const std::size_t from = path.starts_with(of_effects) ? of_effects.size() : 0;
  return path.substr(0, path.find('.', from) + 1);
}

/// Whether both sides of a pair have the same part, and are known alike.
bool is_one_part(const Rig& rig, std::string_view part, const Stated& stated) {
  const std::string other(of_muscle_2);
  const auto numbers = domain::paths_of_numbers(rig);
  Rig copy = rig;
  const auto same = [&](const std::string& path) {
    const double *one = domain::find_number(copy, path).value,
                 *two = domain::find_number(copy, other + path).value;
    return one != nullptr && two != nullptr && *one == *two;
  };
  return std::all_of(numbers.begin(), numbers.end(),
                     [&](const std::string& path) { return !path.starts_with(part) || same(path); }) &&
         std::none_of(stated.begin(), stated.end(),
                      [&](const auto& one) { return one.first.starts_with(other + std::string(part)); });
}

/// What a number of the side of muscle 1, or of what both share, stands for.
std::vector<Standing> standings(const Rig& rig, const std::string& path, const Stated& stated) {
  constexpr std::string_view one_for_both = "valve.supply_pressure";
  const std::string_view part = part_of_side(path);
  if (rig.pair() == nullptr || part.empty()) return {{path}};
  if (path == one_for_both || is_one_part(rig, part, stated)) return {{path, true}};
  return {{path}, {std::string(of_muscle_2) + path}};
}

/// A number of the rig, normal round its value; or its logarithm is.
Parameter normal(const std::string& path, const Found& found, double deviation, bool logarithmic) {
  Parameter p{.path = path,
              .origin = *found.value,
              .scale = deviation,
              .has_prior = true,
              .logarithmic = logarithmic};
  const double most = thresholds.parameter.most_deviations;
  p.lowest = std::max(found.lowest, p.unscaled(-most));
  p.highest = std::min(found.highest, p.unscaled(most));
  return p;
}

/// What somebody has put there: its size is a guess, good within a factor of a few, if nothing is stated.
Parameter size_of(const Candidate& candidate, bool is_size, Parameter p, const Rig& nominal,
                  const Stated& stated) {
  p.origin = value_of(nominal, p.path);
  const double size = p.origin - (is_size ? candidate.absent : 0.0);
  p.scale = std::abs(size);
  if (!p.logarithmic) p.scale = std::max(p.scale, std::abs(candidate.typical));
  p.scale = deviation_of(stated, p.path, p.origin, p.scale).value_or(p.scale);
  p.logarithmic = false;
  p.has_prior = true;
  const double most = thresholds.parameter.most_deviations * p.scale;
  p.lowest = std::max(std::min(p.lowest, p.origin), p.origin - most);
  p.highest = std::min(std::max(p.highest, p.origin), p.origin + most);
  return p;
}

/// Numbers of the rig's parts that a file may say how well it knows. What is not in a part is not of the
/// plant: the tick, the settling time.
bool of_a_part(const Rig& nominal, std::string_view path) {
  constexpr std::array<std::string_view, 7> parts{"muscle.", "friction.", "valve.",    "hose.",
                                                  "gas.",    "joint.",    "mechanics."};
  Rig rig = nominal;
  return path.find("effects.") == std::string_view::npos && domain::find_number(rig, path).value != nullptr &&
         std::any_of(parts.begin(), parts.end(), [&](auto part) { return path.starts_with(part); });
}

/// A link's moment of inertia is at least that of its mass where its centre is (parallel axes): each of the
/// three numbers may take a third of what is to spare.
void keep_link_possible(const plant::Link& link, Parameter& p) {
  const double least = link.mass_kg * link.length_m * link.length_m;
  if (!(least > 0.0)) return;
  const double share = std::cbrt(link.inertia_kg_m2 / least);
  if (p.path == "mechanics.link_inertia") p.lowest = std::max(p.lowest, link.inertia_kg_m2 / share);
  if (p.path == "mechanics.link_mass") p.highest = std::min(p.highest, link.mass_kg * share);
  if (p.path == "mechanics.link_length") p.highest = std::min(p.highest, link.length_m * std::sqrt(share));
}

/// Gathers what a fit may move.
class Gathering {
 public:
  Gathering(const Rig& nominal, const Stated& stated) : rig_(nominal), stated_(stated) {}

  std::vector<Parameter> operator()() {
    usual(thresholds.parameter.priors);
    if (rig_.pair() != nullptr) usual(thresholds.parameter.pair_priors);
    stated();
    of_effects();
    return std::move(list_);
  }

 private:
  template <class Priors>
  void usual(const Priors& priors) {
    for (const Prior& prior : priors) {
      if (prior.of == Prior::Of::hanging_load && rig_.has_angle()) continue;
      if (prior.of == Prior::Of::load && rig_.pair() != nullptr) continue;
      for (const Standing& one : standings(rig_, std::string(prior.path), stated_))
        if (const double* value = domain::find_number(rig_, one.path).value)  // not every rig has a regulator
          add(one, prior.logarithmic ? prior.relative : prior.relative * std::abs(*value) + prior.absolute,
              prior.logarithmic);
    }
  }
  void stated() {
    for (const auto& [path, deviation] : stated_) {
      if (!of_a_part(rig_, path)) continue;
      for (const Standing& one : standings(rig_, path, stated_)) add(one, 0.0);
    }
  }
  void of_effects() {
    for (const Candidate& candidate : catalogue(rig_)) {
      if (!candidate.carried(rig_)) continue;
      for (const Parameter& p : candidate.parameters(rig_))
        for (const Standing& one : standings(rig_, p.path, stated_)) add_size(candidate, p, one);
    }
  }
  void add_size(const Candidate& candidate, Parameter p, const Standing& at) {
    p.both_sides = at.both_sides;
    const std::string side = at.path.substr(0, at.path.size() - p.path.size());
    if (value_of(rig_, side + candidate.amplitude) == candidate.absent) return;  // this side has none
    const bool is_size = p.path == candidate.amplitude;
    p.path = at.path;
    p = size_of(candidate, is_size, std::move(p), rig_, stated_);
    if (p.scale > 0.0) list_.push_back(std::move(p));
  }
  void add(const Standing& at, double usual_deviation, bool logarithmic = false) {
    const bool known = std::any_of(list_.begin(), list_.end(), [&](const Parameter& p) {
      return p.path == at.path || (p.both_sides && p.path == of_muscle_1(at.path));
    });
    if (known) return;
    const Found found = find(rig_, at.path);
    const std::optional<double> said = deviation_of(stated_, at.path, *found.value, usual_deviation);
    const double deviation = said.value_or(usual_deviation);
    if (!(deviation > 0.0)) return;  // known exactly
    list_.push_back(normal(at.path, found, deviation, logarithmic && !said));
    list_.back().both_sides = at.both_sides;
    if (rig_.pair() != nullptr) keep_link_possible(*rig_.pair(), list_.back());
  }

  Rig rig_;
  const Stated& stated_;
  std::vector<Parameter> list_;
};

}  // namespace

std::vector<Parameter> nominal_parameters(const Rig& nominal, const plant::Spreads& stated) {
  return Gathering(nominal, stated)();
}

}  // namespace mckibben::diagnose
