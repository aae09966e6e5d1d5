// Walks the field lists of a rig; see the header.
#include <algorithm>
#include <concepts>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <sim/engine/batch.hpp>
#include <sim/engine/vectorised.hpp>

namespace mckibben::engine {
namespace {

template <class T, class Visitor>
concept Listed = requires(T& value, Visitor& visitor) {
  T::fields(value, visitor);
};

/// Visits whatever a field list leads to, depth first: leaf(value); enters each struct on the way and leaves
/// it, and asks for the size of each list.
template <class Leaf>
class Walk {
 public:
  explicit Walk(Leaf& leaf) : leaf_(leaf) {}

  template <class T, class... About>
  void operator()(std::string_view, T& value, const About&...) {
    go(value);
  }
  template <class T, class... About>
  void required(std::string_view, T& value, const About&...) {
    go(value);
  }

 private:
  template <class T>
  void go(T& value) {
    if constexpr (Listed<T, Walk>) {
      const auto before = leaf_.enter(value);
      T::fields(value, *this);
      leaf_.leave(before);
    } else {
      leaf_(value);
    }
  }
  template <class T>
  void go(std::vector<T>& list) {
    leaf_.size(list);
    for (T& value : list) go(value);
  }

  Leaf& leaf_;
};

template <class Rig, class Leaf>
void walk(Rig& rig, Leaf& leaf) {
  Walk<Leaf> visitor(leaf);
  if constexpr (requires { Rig::parts(rig, visitor); })
    Rig::parts(rig, visitor);
  else
    Rig::fields(rig, visitor);
}

/// Numbers of a rig in the order of its field lists, and all choices that are no numbers; but for those of an
/// effect that is absent: they make no difference.
struct Leaves {
  std::vector<double> numbers;
  std::vector<std::optional<long>> choices;
  bool makes_no_difference = false;

  template <class T>
  bool enter(const T& value) {
    const bool before = makes_no_difference;
    if constexpr (std::same_as<T, plant::Effects>) return before;
    if constexpr (requires { value.absent(); }) makes_no_difference = makes_no_difference || value.absent();
    return before;
  }
  void leave(bool before) { makes_no_difference = before; }

  void operator()(double& number) { numbers.push_back(number); }
  template <class T>
  requires(std::integral<T> || std::is_enum_v<T>) void operator()(T& choice) {
    choices.push_back(makes_no_difference ? std::nullopt : std::optional(static_cast<long>(choice)));
  }
  void operator()(const plant::Sensors&) {}  // laws know none
  template <class T>
  void size(const std::vector<T>& list) {
    choices.emplace_back(static_cast<long>(list.size()));
  }
};

Leaves leaves_of(plant::Rig rig) {
  Leaves leaves;
  walk(rig, leaves);
  return leaves;
}

/// Puts the rigs' leaves where they belong: numbers into lanes; the choices are those of all.
struct Fill {
  const std::vector<Leaves>& rigs;
  const std::vector<long>& choices;
  std::size_t number = 0, choice = 0;

  template <class T>
  bool enter(const T&) {
    return false;
  }
  void leave(bool) {}

  void operator()(Lanes& lanes) {
    for (std::size_t lane = 0; lane < Lanes::count; ++lane)
      lanes.set(lane, rigs[lane < rigs.size() ? lane : 0].numbers[number]);
    ++number;
  }
  void operator()(double& value) { value = rigs.front().numbers[number++]; }  // of the DAC
  void operator()(const plant::Sensors&) {}
  template <class T>
  requires(std::integral<T> || std::is_enum_v<T>) void operator()(T& value) {
    value = static_cast<T>(choices[choice++]);
  }
  template <class T>
  void size(std::vector<T>& list) {
    list.resize(static_cast<std::size_t>(choices[choice++]));
  }
};

/// The choices that suit all rigs, where one of them has made any; nothing if two of them differ.
std::optional<Kind> common_choices(const std::vector<Leaves>& rigs) {
  Kind common;
  for (std::size_t i = 0; i < rigs.front().choices.size(); ++i) {
    std::optional<long> one;
    for (const Leaves& rig : rigs) {
      if (!rig.choices[i]) continue;
      if (one && *one != *rig.choices[i]) return std::nullopt;
      one = rig.choices[i];
    }
    common.push_back(one);
  }
  return common;
}

/// Gives each rig every kind of term that one of them has, of no size where it had none: terms are no choices
/// then.
void level_terms(std::vector<plant::Rig>& rigs) {
  using Terms = std::vector<plant::ForceTerm>;
  Terms all;
  std::vector<std::vector<std::size_t>> places;  // of each rig's terms among all
  for (const plant::Rig& rig : rigs) {
    std::vector<bool> taken(all.size(), false);
    auto& mine = places.emplace_back();
    for (const plant::ForceTerm& term : rig.effects.get<plant::ResidualForce>().terms) {
      std::size_t at = 0;
      while (at < all.size() && (taken[at] || all[at].of != term.of)) ++at;
      if (at == all.size()) {
        all.push_back({.of = term.of});
        taken.push_back(false);
      }
      taken[at] = true;
      mine.push_back(at);
    }
  }
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    Terms& terms = rigs[i].effects.get<plant::ResidualForce>().terms;
    Terms level = all;
    for (std::size_t k = 0; k < terms.size(); ++k) level[places[i][k]] = terms[k];
    terms = std::move(level);
  }
}

/// Gives each rig every law that one of them has, absent where it had none. Laws that remember stay in their
/// places: the same law in two places counts as two.
void level_laws(std::vector<plant::Rig>& rigs) {
  std::vector<plant::OwnLawOf<double>> all;
  const auto same = [](const auto& a, const auto& b) {
    return a.place == b.place && (a.text == b.text || *a.text == *b.text);
  };
  for (const plant::Rig& rig : rigs)
    for (const auto& law : rig.effects.laws.list)
      if (!law.absent() && std::ranges::none_of(all, [&](const auto& known) { return same(known, law); }))
        all.push_back({law.text, {}, law.place});
  for (plant::Rig& rig : rigs) {
    auto level = all;
    for (auto& slot : level)
      for (const auto& law : rig.effects.laws.list)
        if (!law.absent() && same(slot, law)) slot = law;
    rig.effects.laws.list = std::move(level);
  }
}

std::vector<Leaves> levelled_leaves(std::vector<plant::Rig>& rigs) {
  level_terms(rigs);
  level_laws(rigs);
  std::vector<Leaves> leaves;
  leaves.reserve(rigs.size());
  for (const plant::Rig& rig : rigs) leaves.push_back(leaves_of(rig));
  return leaves;
}

/// Rigs as one; nothing if they differ in more than numbers.
std::optional<plant::RigOf<Lanes>> as_one(std::vector<plant::Rig> rigs) {
  const auto leaves = levelled_leaves(rigs);
  const auto choices = common_choices(leaves);
  if (!choices) return std::nullopt;
  std::vector<long> chosen;  // what nobody chooses makes no difference
  for (const auto& choice : *choices) chosen.push_back(choice.value_or(0));
  plant::RigOf<Lanes> rig;
  for (const auto& law : rigs.front().effects.laws.list)
    rig.effects.laws.list.push_back({law.text, {}, law.place});
  Fill fill{leaves, chosen};
  walk(rig, fill);
  return rig;
}

/// A part that `of` each plant differs in numbers alone, as one.
template <template <class> class Part, class Of>
Part<Lanes> part_as_one(std::span<const plant::Plant> plants, const Of& of) {
  std::vector<Leaves> leaves;
  for (const plant::Plant& plant : plants) {
    Part<double> part = of(plant);
    walk(part, leaves.emplace_back());
  }
  std::vector<long> chosen;
  for (const auto& choice : leaves.front().choices) chosen.push_back(choice.value_or(0));
  Part<Lanes> part;
  Fill fill{leaves, chosen};
  walk(part, fill);
  return part;
}

void put_side(const plant::HeldSide& held, std::size_t lane, plant::HeldSideOf<Lanes>& all) {
  all.reference_pressure_Pa.set(lane, held.reference_pressure_Pa);
  all.current_speed_mA_per_s.set(lane, held.current_speed_mA_per_s);
  all.given = held.given;
  all.pressure_rate_Pa_per_s.set(lane, held.pressure_rate_Pa_per_s);
  all.supply_above_Pa.set(lane, held.supply_above_Pa);
  all.fills.set(lane, held.fills);
  all.vents.set(lane, held.vents);
}

}  // namespace

std::optional<plant::PlantOf<Lanes>> vectorised(std::span<const plant::Plant> plants) {
  std::vector<plant::Rig> rigs, opposite;
  rigs.reserve(plants.size());
  for (const plant::Plant& plant : plants) {
    rigs.push_back(plant.rig());
    if (plant.opposite()) opposite.push_back(plant.opposite()->rig());
  }
  const auto rig = as_one(std::move(rigs));
  if (!rig) return std::nullopt;
  if (!opposite.empty()) {
    const auto other = as_one(std::move(opposite));
    if (!other) return std::nullopt;
    return plant::PlantOf<Lanes>(
        *rig, *other,
        part_as_one<plant::LinkOf>(plants, [](const plant::Plant& plant) { return plant.link(); }));
  }
  Lanes load_kg;
  for (std::size_t lane = 0; lane < Lanes::count; ++lane)
    load_kg.set(lane, plants[lane < plants.size() ? lane : 0].load_kg());
  if (plants.front().lever())
    return plant::PlantOf<Lanes>(
        *rig, load_kg,
        part_as_one<plant::LeverOf>(plants, [](const plant::Plant& plant) { return *plant.lever(); }));
  return plant::PlantOf<Lanes>(*rig, load_kg);
}

void put(const plant::Held& held, std::size_t lane, plant::HeldOf<Lanes>& all) {
  put_side(held, lane, all);
  put_side(held.opposite, lane, all.opposite);
  all.length_is_given = held.length_is_given;
  all.joint_force_N.set(lane, held.joint_force_N);
}

std::optional<Kind> kind_of(std::span<const plant::Plant* const> group) {
  std::vector<plant::Rig> rigs, opposite;
  std::vector<Leaves> levers;
  for (const plant::Plant* plant : group) {
    rigs.push_back(plant->rig());
    if (plant->opposite()) opposite.push_back(plant->opposite()->rig());
    Leaves& lever = levers.emplace_back();
    lever.choices.emplace_back(plant->lever().has_value());
    if (!plant->lever()) continue;
    plant::Lever turned = *plant->lever();
    walk(turned, lever);
  }
  auto kind = common_choices(levelled_leaves(rigs));
  const bool alike =
      std::ranges::all_of(levers, [&](const Leaves& one) { return one.choices == levers.front().choices; });
  if (!alike) return std::nullopt;
  if (kind && levers.front().choices.front() != 0L)
    kind->insert(kind->end(), levers.front().choices.begin(), levers.front().choices.end());
  if (!kind || opposite.empty()) return kind;
  const auto other = common_choices(levelled_leaves(opposite));
  if (!other) return std::nullopt;
  kind->insert(kind->end(), other->begin(), other->end());
  return kind;
}

}  // namespace mckibben::engine
