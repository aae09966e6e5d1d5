// Parameters by path; see the header. The field lists of the plant are walked with the path as a guide.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include <sim/diagnose/parameter.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

/// The visitor of a field list that follows a path.
class Guide {
 public:
  explicit Guide(std::string_view path) : rest_(path) {}

  void operator()(std::string_view key, double& value, std::string_view unit, double lowest, double highest,
                  std::string_view) {
    if (key == rest_) found = {&value, std::string(unit), lowest, highest};
  }
  template <class T, class... Rest>
  requires(!std::same_as<T, double>) void operator()(std::string_view key, T& value, const Rest&...) {
    if constexpr (requires { T::fields(value, *this); }) {
      enter(key, [&] { T::fields(value, *this); });
    } else if constexpr (requires { T::value_type::fields(value.front(), *this); }) {
      enter(key, [&] {
        for (std::size_t i = 0; i < value.size(); ++i)
          enter(std::to_string(i), [&] { T::value_type::fields(value[i], *this); });
      });
    }
  }

  void required(std::string_view key, auto& value, const auto&... rest) { (*this)(key, value, rest...); }

  Found found;

 private:
  // Goes on inside `key` if the path leads there.
  template <class Inside>
  void enter(std::string_view key, const Inside& inside) {
    if (rest_.size() <= key.size() || !rest_.starts_with(key) || rest_[key.size()] != '.') return;
    const std::string_view whole = rest_;
    rest_.remove_prefix(key.size() + 1);
    inside();
    rest_ = whole;
  }

  std::string_view rest_;
};

/// Calls `tell` with the effect of this name in the rig.
template <class Tell>
void with_effect(plant::Rig& rig, std::string_view effect, const Tell& tell) {
  const auto look = [&]<class E>(E& mine) {
    if (effect == E::name) tell(mine);
  };
  std::apply([&](const auto&... e) { (look(rig.effects.get<std::remove_cvref_t<decltype(e)>>()), ...); },
             plant::Effects::Table{});
}

}  // namespace

bool carries(plant::Rig rig, std::string_view effect) {
  bool present = false;
  with_effect(rig, effect, [&](const auto& mine) { present = !mine.absent(); });
  return present;
}

Found find(plant::Rig& rig, std::string_view path) {
  Guide guide(path);
  plant::Rig::fields(rig, guide);
  if (guide.found.value == nullptr) throw std::invalid_argument("no parameter " + std::string(path));
  return guide.found;
}

double Parameter::unscaled(double number) const {
  return logarithmic ? std::exp(number) : origin + number * scale;
}
double Parameter::scaled(double value) const {
  return logarithmic ? std::log(value) : (value - origin) / scale;
}

double value_of(const plant::Rig& rig, std::string_view path) {
  plant::Rig copy = rig;
  return *find(copy, path).value;
}

std::vector<Parameter> nominal_parameters(const plant::Rig& nominal) {
  const double most_deviations = thresholds.parameter.most_deviations;
  std::vector<Parameter> list;
  plant::Rig rig = nominal;
  for (const Prior& prior : thresholds.parameter.priors) {
    const Found found = find(rig, prior.path);
    const double deviation = prior.relative * std::abs(*found.value) + prior.absolute;
    if (deviation <= 0.0) continue;
    list.push_back({.path = std::string(prior.path),
                    .origin = *found.value,
                    .scale = deviation,
                    .step = thresholds.parameter.step * deviation,
                    .lowest = std::max(found.lowest, *found.value - most_deviations * deviation),
                    .highest = std::min(found.highest, *found.value + most_deviations * deviation),
                    .has_prior = true});
  }
  for (const Candidate& candidate : catalogue()) {
    if (!candidate.carried(nominal)) continue;
    for (Parameter p : candidate.parameters(nominal)) {
      // Somebody has put it there: its size is a guess, good within a factor of a few.
      p.origin = value_of(nominal, p.path);
      const double size = p.origin - (p.path == candidate.amplitude ? candidate.absent : 0.0);
      p.scale = std::abs(size);
      if (p.logarithmic)
        p.step *= p.scale;
      else
        p.scale = std::max(p.scale, std::abs(candidate.typical));
      p.logarithmic = false;
      p.has_prior = true;
      p.lowest = std::max(std::min(p.lowest, p.origin), p.origin - most_deviations * p.scale);
      p.highest = std::min(std::max(p.highest, p.origin), p.origin + most_deviations * p.scale);
      list.push_back(std::move(p));
    }
  }
  return list;
}

plant::Rig Candidate::chosen(plant::Rig rig) const {
  with_effect(rig, effect, [&](auto& mine) {
    if constexpr (requires { mine.variant; }) {
      for (const auto& [law, name] : names(mine.variant))
        if (name == variant) mine.variant = law;
    }
  });
  return rig;
}

bool Candidate::carried(plant::Rig rig) const {
  bool present = false, same_law = true;
  with_effect(rig, effect, [&](const auto& mine) {
    present = !mine.absent();
    if constexpr (requires { mine.variant; }) {
      for (const auto& [law, name] : names(mine.variant))
        if (law == mine.variant) same_law = name == variant;
    }
  });
  return present && same_law;
}

std::vector<Parameter> Candidate::parameters(const plant::Rig& rig) const {
  plant::Rig copy = rig;
  const Found size = find(copy, amplitude);
  // Next to nothing is as good as nothing, and can be stiff: a supply line of no resistance, a lag of no
  // time.
  const double least = absent + thresholds.parameter.least_size * typical;
  std::vector<Parameter> list{{.path = amplitude,
                               .origin = absent,
                               .scale = std::abs(typical),
                               .step = step,
                               .lowest = either_sign || typical < 0.0 ? size.lowest : least,
                               .highest = either_sign || typical > 0.0 ? size.highest : least}};
  if (!shape.empty()) {
    const Found form = find(copy, shape);
    list.push_back({.path = shape,
                    .scale = 1.0,
                    .step = thresholds.parameter.shape_step,
                    .lowest = std::max(form.lowest, shapes.front() / thresholds.parameter.shape_range),
                    .highest = std::min(form.highest, shapes.back() * thresholds.parameter.shape_range),
                    .logarithmic = true});
  }
  return list;
}

std::vector<Candidate> catalogue() {
  std::vector<Candidate> list;
  const auto add = [&]<class E>(const E& effect) {
    for (const plant::Variant& law : E::variants) {
      const std::string prefix = "effects." + std::string(effect.name) + ".";
      Candidate c{.effect = std::string(effect.name),
                  .variant = std::string(law.name),
                  .amplitude = prefix + std::string(law.amplitude),
                  .shape = law.shape.empty() ? "" : prefix + std::string(law.shape),
                  .absent = law.absent,
                  .typical = law.typical,
                  .step = law.step,
                  .either_sign = law.sign == plant::Sign::either,
                  .shapes = {}};
      if (!law.shape.empty()) c.shapes = {law.low, law.middle, law.high};
      list.push_back(std::move(c));
    }
  };
  std::apply([&](const auto&... effect) { (add(effect), ...); }, plant::Effects::Table{});
  return list;
}

}  // namespace mckibben::diagnose
