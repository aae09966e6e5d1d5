// From the plant's table, and what a diagnosis knows of typical sizes; see the header.
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <type_traits>

#include <fmt/format.h>

#include <sim/domain/rig_number.hpp>
#include <sim/live/switches.hpp>

namespace mckibben::live {
namespace {

constexpr double most_typical_sizes = 5.0;  // further up effects only get absurd
constexpr double shape_reach = 3.0;         // beyond the shapes that a diagnosis begins from

/// Does something with the effect of that name.
template <class Work>
void with_effect_named(plant::Effects& effects, std::string_view name, const Work& work) {
  const auto look_at = [&]<class E>(E& effect) {
    if (name == E::name) work(effect);
  };
  std::apply([&](auto&... effect) { (look_at(effect), ...); }, effects.all);
}

Dial dial_at(domain::RigFile& rig, const std::string& path) {
  const domain::RigNumber number = domain::find_number(rig, path);
  return {.unit = number.unit, .lowest = number.lowest, .highest = number.highest, .value = *number.value};
}

Switch switch_of(const diagnose::Candidate& candidate, const domain::RigFile& file) {
  Switch one;
  one.effect = candidate.effect;
  one.name = candidate.effect + (candidate.variant.empty() ? "" : " " + candidate.variant);
  one.candidate = candidate;
  one.absent = candidate.absent;
  one.on = candidate.carried(file);
  domain::RigFile rig = file;
  with_effect_named(rig.effects, candidate.effect, [&]<class E>(E&) {
    one.sentence = E::sentence;
    one.law = E::law;
  });
  one.size = dial_at(rig, candidate.amplitude);
  const double reach = most_typical_sizes * candidate.typical;
  const double one_end = candidate.absent + reach,
               other_end = candidate.absent - (candidate.either_sign ? reach : 0.0);
  one.size.least = std::max(one.size.lowest, std::min(one_end, other_end));
  one.size.most = std::min(one.size.highest, std::max(one_end, other_end));
  if (!one.on) one.size.value = candidate.absent + candidate.typical;
  if (!one.has_shape()) return one;
  one.shape = dial_at(rig, candidate.shape);
  one.shape.least = std::max(one.shape.lowest, candidate.shapes.front() / shape_reach);
  one.shape.most = std::min(one.shape.highest, candidate.shapes.back() * shape_reach);
  if (!one.on) one.shape.value = candidate.shapes[candidate.shapes.size() / 2];
  return one;
}

/// Why a number cannot be set on a dial; empty if it can.
std::string refusal(std::string_view key, const Dial& dial, double value) {
  if (std::isfinite(value) && value >= dial.lowest && value <= dial.highest) return "";
  return fmt::format("{} = {:g}: must be from {:g} to {:g}{}", key, value, dial.lowest, dial.highest,
                     dial.unit == "1" ? "" : " " + dial.unit);
}

}  // namespace

Switches::Switches(const domain::RigFile& rig) : bare_(rig), file_(rig) {
  for (const diagnose::Candidate& candidate : diagnose::catalogue()) {
    if (!candidate.adds_to.empty()) continue;  // a law with one term more: too much for one dial
    all_.push_back(switch_of(candidate, rig));
    with_effect_named(bare_.effects, candidate.effect, [](auto& effect) { effect = {}; });
  }
}

const Switch* Switches::find(std::string_view name) const {
  const auto found = std::ranges::find(all_, name, &Switch::name);
  return found == all_.end() ? nullptr : &*found;
}

std::string Switches::set(std::string_view name, bool on, double size, double shape) {
  const auto found = std::ranges::find(all_, name, &Switch::name);
  if (found == all_.end()) return fmt::format("name = {}: there is no such effect", name);
  std::string why = refusal("size", found->size, size);
  if (why.empty() && found->has_shape()) why = refusal("shape", found->shape, shape);
  if (!why.empty()) return why;
  const std::vector<Switch> before = all_;
  if (on)
    for (Switch& one : all_)
      if (one.effect == found->effect) one.on = false;
  found->on = on;
  found->size.value = size;
  if (found->has_shape()) found->shape.value = shape;
  why = domain::broken_rule(rig());
  if (!why.empty()) all_ = before;
  return why;
}

domain::RigFile Switches::rig() const {
  domain::RigFile rig = bare_;
  for (const Switch& one : all_) {
    if (!one.on) continue;
    with_effect_named(rig.effects, one.effect, [&]<class E>(E& effect) {
      if (one.candidate.carried(file_)) effect = file_.effects.get<E>();  // what it has besides
    });
    rig = one.candidate.chosen(std::move(rig));
    if (one.has_shape())
      one.candidate.put(rig, one.size.value, one.shape.value);
    else
      one.candidate.put(rig, one.size.value);
  }
  return rig;
}

}  // namespace mckibben::live
