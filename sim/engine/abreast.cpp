// Walks the field lists of a rig; see the header.
#include <concepts>
#include <string_view>
#include <type_traits>
#include <vector>

#include <sim/engine/abreast.hpp>

namespace mckibben::engine {
namespace {

template <class T, class Visitor>
concept Listed = requires(T& value, Visitor& visitor) {
  T::fields(value, visitor);
};

/// Visits whatever a field list leads to, depth first: leaf(value), and size(list) of each list on the way.
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
      T::fields(value, *this);
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
  Rig::fields(rig, visitor);
}

/// Numbers of a rig in the order of its field lists, and all choices that are no numbers.
struct Leaves {
  std::vector<double> numbers;
  std::vector<long> choices;

  void operator()(double& number) { numbers.push_back(number); }
  template <class T>
  requires(std::integral<T> || std::is_enum_v<T>) void operator()(T& choice) {
    choices.push_back(static_cast<long>(choice));
  }
  template <class T>
  void size(const std::vector<T>& list) {
    choices.push_back(static_cast<long>(list.size()));
  }
};

Leaves leaves_of(plant::Rig rig) {
  Leaves leaves;
  walk(rig, leaves);
  return leaves;
}

/// Puts the rigs' leaves where they belong: numbers into lanes, the rest from the first rig.
struct Fill {
  const std::vector<Leaves>& rigs;
  std::size_t number = 0, choice = 0;

  void operator()(Lanes& lanes) {
    for (std::size_t lane = 0; lane < Lanes::count; ++lane)
      lanes.set(lane, rigs[lane < rigs.size() ? lane : 0].numbers[number]);
    ++number;
  }
  void operator()(double& value) { value = rigs.front().numbers[number++]; }  // of instruments
  template <class T>
  requires(std::integral<T> || std::is_enum_v<T>) void operator()(T& value) {
    value = static_cast<T>(rigs.front().choices[choice++]);
  }
  template <class T>
  void size(std::vector<T>& list) {
    list.resize(static_cast<std::size_t>(rigs.front().choices[choice++]));
  }
};

}  // namespace

std::optional<plant::PlantOf<Lanes>> abreast(std::span<const plant::Plant> plants) {
  std::vector<Leaves> rigs;
  for (const plant::Plant& plant : plants) rigs.push_back(leaves_of(plant.rig()));
  for (const Leaves& rig : rigs)
    if (rig.choices != rigs.front().choices) return std::nullopt;
  plant::RigOf<Lanes> rig;
  Fill fill{rigs};
  walk(rig, fill);
  Lanes load_kg;
  for (std::size_t lane = 0; lane < Lanes::count; ++lane)
    load_kg.set(lane, plants[lane < plants.size() ? lane : 0].load_kg());
  return plant::PlantOf<Lanes>(rig, load_kg);
}

plant::HeldOf<Lanes> abreast(std::span<const plant::Held> held) {
  const auto gathered = [&](const auto& of) {
    Lanes lanes;
    for (std::size_t lane = 0; lane < Lanes::count; ++lane)
      lanes.set(lane, of(held[lane < held.size() ? lane : 0]));
    return lanes;
  };
  plant::HeldOf<Lanes> all;
  all.reference_pressure_Pa = gathered([](const plant::Held& one) { return one.reference_pressure_Pa; });
  all.current_speed_mA_per_s = gathered([](const plant::Held& one) { return one.current_speed_mA_per_s; });
  if (held.front().pressure_rate_Pa_per_s)
    all.pressure_rate_Pa_per_s =
        gathered([](const plant::Held& one) { return one.pressure_rate_Pa_per_s.value(); });
  all.length_is_given = held.front().length_is_given;
  return all;
}

}  // namespace mckibben::engine
