// From the plant's table, and what a diagnosis knows of typical sizes; see the header.
#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include <sim/diagnose/catalogue.hpp>
#include <sim/domain/rig_number.hpp>
#include <sim/live/switches.hpp>

namespace mckibben::live {
namespace {

constexpr double most_typical_sizes = 5.0;  // further up effects only get absurd
constexpr double shape_reach = 3.0;         // beyond the shapes that a diagnosis begins from

using diagnose::Side;

/// Does something with the effect of that name.
void with_effect_named(plant::Effects& effects, std::string_view name, const auto& work) {
  const auto look_at = [&]<class E>(E& effect) {
    if (name == E::name) work(effect);
  };
  std::apply([&](auto&... effect) { (look_at(effect), ...); }, effects.all);
}

Dial dial_at(plant::Rig& rig, const std::string& path) {
  const domain::RigNumber number = domain::find_number(rig, path);
  return {.unit = number.unit, .lowest = number.lowest, .highest = number.highest, .value = *number.value};
}

/// One for both muscles, or where the rig's file tells them apart one for each.
std::vector<diagnose::Candidate> by_side(const diagnose::Candidate& candidate, const plant::Rig& rig) {
  if (rig.pair() == nullptr) return {candidate};
  const diagnose::Candidate one = candidate.of(Side::one), two = candidate.of(Side::two);
  const auto same = [&](const std::string& path, const std::string& other) {
    return path.empty() || diagnose::value_of(rig, path) == diagnose::value_of(rig, other);
  };
  if (same(one.amplitude, two.amplitude) && same(one.shape, two.shape)) return {candidate};
  return {one, two};
}

/// Whether the rig may have it and shows it: a gauge error is of a gauge; a pair and a lever have no guide of
/// a load, and both gases are of one kind.
bool is_of(const plant::Rig& rig, const diagnose::Candidate& candidate) {
  if (candidate.effect == plant::GaugeError::name &&
      rig.sensors.of(plant::Sensed::muscle_pressure) == nullptr)
    return false;
  if (!rig.has_angle()) return true;
  plant::Rig with = candidate.chosen(rig);
  candidate.put(with, candidate.absent + candidate.typical);
  return domain::broken_rule(with).empty();
}

Switch switch_of(const diagnose::Candidate& candidate, const plant::Rig& file) {
  Switch one;
  one.effect = candidate.effect;
  one.name = candidate.effect + (candidate.variant.empty() ? "" : " " + candidate.variant) +
             diagnose::of_muscle(candidate.side);
  one.candidate = candidate;
  one.absent = candidate.absent;
  one.on = candidate.carried(file);
  plant::Rig rig = file;
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

}  // namespace

std::string out_of_range(std::string_view what, double value, double low, double high,
                         std::string_view unit) {
  if (std::isfinite(value) && value >= low && value <= high) return "";
  const std::string of = unit == "1" ? "" : fmt::format(" {}", unit);
  return fmt::format("{} = {:g}{}: must be from {:g} to {:g}{}", what, value, of, low, high, of);
}

std::vector<std::pair<double, double>> Switch::plain_sizes() const {
  std::vector<std::pair<double, double>> sides;
  for (const double side : {candidate.typical, -candidate.typical}) {
    const double near = absent + side;
    if (near >= size.least && near <= size.most)
      sides.emplace_back(near, std::clamp(near + side, size.least, size.most));
  }
  return sides;
}

Switches::Switches(const plant::Rig& rig) : bare_(rig), file_(rig) {
  for (const diagnose::Candidate& candidate : diagnose::catalogue()) {
    if (!candidate.adds_to.empty()) continue;  // a law with one term more: too much for one dial
    if (!is_of(rig, candidate)) continue;
    for (const diagnose::Candidate& each : by_side(candidate, rig)) all_.push_back(switch_of(each, rig));
    diagnose::each_side(bare_, [&](plant::Effects& effects) {
      with_effect_named(effects, candidate.effect, [](auto& effect) { effect = {}; });
    });
  }
}

const Switch* Switches::find(std::string_view name) const {
  const auto found = std::ranges::find(all_, name, &Switch::name);
  return found == all_.end() ? nullptr : &*found;
}

std::string Switches::hide(std::string_view name, double size, double shape) {
  const std::vector<Switch> before = all_;
  if (hidden_.empty())
    for (Switch& one : all_) one.on = false;
  std::string why = set(name, true, size, shape);
  if (why.empty())
    hidden_ = name;
  else
    all_ = before;
  return why;
}

std::string Switches::set(std::string_view name, bool on, double size, double shape) {
  if (!hidden_.empty())
    return "an effect is hidden: choose which one it is, or show it, before others are switched";
  const auto found = std::ranges::find(all_, name, &Switch::name);
  if (found == all_.end()) return fmt::format("name = {}: there is no such effect", name);
  const auto refusal = [&](std::string_view which, const Dial& dial, double value) {
    return out_of_range(fmt::format("{} of {}", which, name), value, dial.lowest, dial.highest, dial.unit);
  };
  std::string why = refusal("size", found->size, size);
  if (why.empty() && found->has_shape()) why = refusal("shape", found->shape, shape);
  if (!why.empty()) return why;
  const std::vector<Switch> before = all_;
  if (on)
    for (Switch& one : all_) {
      const Side side = one.candidate.side;
      const bool meets =
          side == found->candidate.side || side == Side::both || found->candidate.side == Side::both;
      if (one.effect == found->effect && meets) one.on = false;
    }
  found->on = on;
  found->size.value = size;
  if (found->has_shape()) found->shape.value = shape;
  why = domain::broken_rule(rig());
  if (!why.empty()) all_ = before;
  return why;
}

/// What the file's effect has besides what is switched.
void Switches::take_from_file(plant::Rig& rig, const Switch& one) const {
  const auto take = [&](plant::Effects& into, const plant::Effects& from) {
    with_effect_named(into, one.effect, [&]<class E>(E& effect) { effect = from.get<E>(); });
  };
  if (one.candidate.side != Side::two) take(rig.effects, file_.effects);
  if (plant::Pair* const pair = rig.pair(); pair != nullptr && one.candidate.side != Side::one)
    take(pair->opposite.effects, file_.pair()->opposite.effects);
}

plant::Rig Switches::known() const {
  plant::Rig rig = bare_;
  for (const Switch& one : all_)
    if (one.on && one.candidate.carried(file_)) take_from_file(rig, one);
  return rig;
}

plant::Rig Switches::rig() const {
  plant::Rig rig = bare_;
  for (const Switch& one : all_) {
    if (!one.on) continue;
    if (one.candidate.carried(file_)) take_from_file(rig, one);
    rig = one.candidate.chosen(std::move(rig));
    if (one.has_shape())
      one.candidate.put(rig, one.size.value, one.shape.value);
    else
      one.candidate.put(rig, one.size.value);
  }
  return rig;
}

}  // namespace mckibben::live
