// See the header.
#include "hidden_effects.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <controllers/waveform.hpp>
#include <plant/instruments.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/parameter.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::diagnose {
namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  double normal() { return std::normal_distribution(0.0, 1.0)(random_); }

 private:
  std::mt19937_64 random_;
};

/// Whether an effect's size may have either sign: even seeds hide the other one.
bool either_sign(const std::string& path) {
  for (const Candidate& c : catalogue())
    if (c.amplitude == path) return c.either_sign;
  return false;
}

struct Kind {
  std::string title;
  Verdict verdict;
  std::vector<std::string> effects;
  std::vector<Planted> plan;  ///< sizes, before the dice
  plant::Noise noise{};
  std::vector<plant::ForceTerm> law{};
  bool gauge = false;
};

/// Of each effect a size that is hard to see and one that is plain.
struct Size {
  const char *effect, *key;
  double absent, small, large;
  const char* shape;
  double form;
};
constexpr Size sizes[] = {{"viscous_damping", "damping", 0, 25, 120, nullptr, 0},
                          {"guide_friction", "coefficient", 0, 0.01, 0.04, nullptr, 0},
                          {"speed_dependent_friction", "ratio", 1, 0.85, 0.6, "speed", 0.02},
                          {"bladder_elasticity", "stiffness", 0, 60, 300, nullptr, 0},
                          {"bladder_creep", "stiffness", 0, 60, 250, "time", 1.5},
                          {"bladder_hysteresis", "force", 0, 3, 12, "stroke", 0.008},
                          {"isometric_hysteresis", "pressure", 0, 4e3, 1.5e4, "turn", 8e3},
                          {"end_cap_correction", "slope", 0, 0.004, 0.015, nullptr, 0},
                          {"pressure_threshold", "pressure", 0, 1e4, 4e4, nullptr, 0},
                          {"muscle_leak", "conductance", 0, 5e-11, 2e-10, nullptr, 0},
                          {"polytropic_gas", "exponent", 1, 1.08, 1.3, nullptr, 0},
                          {"gas_temperature", "time", 0, 0.05, 0.3, nullptr, 0},
                          {"valve_lag", "time", 0, 0.01, 0.04, nullptr, 0},
                          {"valve_dead_band", "half_width", 0, 2e3, 8e3, nullptr, 0},
                          {"valve_hysteresis", "half_width", 0, 2e3, 8e3, nullptr, 0},
                          {"supply_droop", "line_resistance", 0, 3e7, 1e8, "volume", 3e-4},
                          {"exhaust_restriction", "share", 0, 0.15, 0.5, nullptr, 0},
                          {"command_delay", "time", 0, 0.012, 0.05, nullptr, 0},
                          {"friction_warm_up", "change", 0, -0.12, -0.35, "time", 5.0},
                          {"encoder_backlash", "width", 0, 3e-4, 1.2e-3, nullptr, 0},
                          {"encoder_scale", "error", 0, 0.01, 0.03, nullptr, 0},
                          {"reading_delay", "time", 0, 0.012, 0.05, nullptr, 0},
                          {"gauge_error", "offset", 0, 3e3, 1.5e4, nullptr, 0}};

std::string path_of(const char* effect, const char* key) {
  return fmt::format("effects.{}.{}", effect, key);
}

std::vector<Kind> single_effects() {
  std::vector<Kind> kinds;
  for (const Size& s : sizes)
    for (const bool large : {false, true}) {
      Kind kind{fmt::format("{} {}", s.effect, large ? "large" : "small"),
                Verdict::missing_effect,
                {s.effect},
                {{path_of(s.effect, s.key), large ? s.large : s.small}}};
      if (s.shape != nullptr) kind.plan.push_back({path_of(s.effect, s.shape), s.form});
      kind.gauge = s.effect == plant::GaugeError::name;
      kinds.push_back(std::move(kind));
    }
  return kinds;
}

/// Effects together, all large.
Kind together(const std::vector<std::string>& effects) {
  Kind kind{fmt::format("{}", fmt::join(effects, " + ")), Verdict::missing_effect, effects, {}};
  std::vector<Planted> shapes;
  for (const std::string& name : effects) {
    const Size& s = *std::find_if(std::begin(sizes), std::end(sizes),
                                  [&](const Size& size) { return size.effect == name; });
    kind.plan.push_back({path_of(s.effect, s.key), s.large});
    if (s.shape != nullptr) shapes.push_back({path_of(s.effect, s.shape), s.form});
  }
  kind.plan.insert(kind.plan.end(), shapes.begin(), shapes.end());
  return kind;
}

std::vector<Kind> pairs_of_effects() {
  return {
      together({"polytropic_gas", "guide_friction"}), together({"muscle_leak", "speed_dependent_friction"}),
      together({"bladder_elasticity", "encoder_backlash"}), together({"valve_dead_band", "viscous_damping"})};
}

std::vector<Kind> triples_of_effects() {
  return {together({"muscle_leak", "guide_friction", "bladder_elasticity"}),
          together({"polytropic_gas", "valve_dead_band", "viscous_damping"}),
          together({"speed_dependent_friction", "bladder_creep", "encoder_backlash"}),
          together({"valve_lag", "bladder_hysteresis", "supply_droop"}),
          together({"pressure_threshold", "exhaust_restriction", "friction_warm_up"})};
}

/// Nothing that has a name: other numbers, only noise, laws of no catalogue.
std::vector<Kind> without_effects() {
  std::vector<Kind> kinds;
  const auto moved = [&](const char* path, double value) {
    kinds.push_back({fmt::format("recalibrate {}", path), Verdict::recalibrate, {}, {{path, value}}});
  };
  moved("muscle.rest_radius", 7.5e-3 * 1.017);
  moved("muscle.end_correction", 1.30 * 0.984);
  moved("friction.scale", 1.2);
  moved("hose.conductance", 1.5e-8 * 0.8);
  const auto null = [&](const char* title, plant::Noise noise) {
    kinds.push_back({title, Verdict::nothing_missing, {}, {}, noise});
  };
  null("nothing, white", {});
  null("nothing, much jitter", {.encoder_jitter = 2e-4});
  null("nothing, ripple", {.ripple_Pa = 400.0, .ripple_period_s = 7.0});
  null("nothing, strong ripple", {.ripple_Pa = 900.0, .ripple_period_s = 4.0});
  null("nothing, wander", {.wander_Pa = 400.0, .wander_time_s = 5.0});
  const auto law = [&](const char* title, std::vector<plant::ForceTerm> terms) {
    kinds.push_back({title, Verdict::unknown_effect, {}, {}, {}, std::move(terms)});
  };
  using plant::Basis;
  law("unknown, force along the stroke",
      {{.of = Basis::sine, .coefficient_N = 6.0, .wavelength_m = 0.011, .phase_rad = 1.0}});
  law("unknown, longer wave",
      {{.of = Basis::sine, .coefficient_N = 5.0, .wavelength_m = 0.025, .phase_rad = 0.4}});
  law("unknown, two waves", {{.of = Basis::sine, .coefficient_N = 5.0, .wavelength_m = 0.017},
                             {.of = Basis::sine, .coefficient_N = 3.0, .wavelength_m = 0.0075}});
  law("unknown, friction along the stroke", {{.of = Basis::direction_ratio, .coefficient_N = -60.0}});
  return kinds;
}

/// Some of them again, with a gauge.
std::vector<Kind> gauged(const std::vector<Kind>& all) {
  std::vector<Kind> kinds;
  for (const char* title :
       {"muscle_leak small", "valve_hysteresis small", "polytropic_gas + guide_friction",
        "muscle_leak + speed_dependent_friction", "nothing, ripple", "unknown, longer wave"}) {
    Kind kind = *std::find_if(all.begin(), all.end(), [&](const Kind& k) { return k.title == title; });
    kind.title = "gauge: " + kind.title;
    kind.gauge = true;
    kinds.push_back(std::move(kind));
  }
  return kinds;
}

const std::vector<Kind>& all_kinds() {
  static const std::vector<Kind> list = [] {
    std::vector<Kind> all;
    const auto add = [&all](const std::vector<Kind>& kinds) {
      all.insert(all.end(), kinds.begin(), kinds.end());
    };
    add(single_effects());
    add(pairs_of_effects());
    add(without_effects());
    add(gauged(all));
    add(triples_of_effects());
    return all;
  }();
  return list;
}

/// A current of a kind of its own for each run: two sines, steps, stairs, triangle, chirp.
std::vector<double> current_mA(std::size_t run, std::size_t rows, Dice& dice) {
  std::vector<double> list;
  const double low = dice.between(3.0, 5.0), high = dice.between(17.0, 20.0), period = dice.between(2.0, 5.0);
  double level = 4.0;
  std::size_t until = 100;
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = 0.012 * static_cast<double>(k);
    const double phase = t / period;
    switch (run % 5) {
      case 0:
        list.push_back(low + 0.5 * (high - low) * (1.0 - std::cos(2.0 * std::numbers::pi * phase)));
        break;
      case 1:
        if (k == until) {
          level = dice.between(4.0, 19.0);
          until += static_cast<std::size_t>(dice.between(50.0, 130.0));
        }
        list.push_back(level);
        break;
      case 2: {
        const double steps = std::floor(t / 0.9);
        list.push_back(4.0 + 16.0 * (steps <= 5.0 ? steps / 5.0 : std::max(0.0, (10.0 - steps) / 5.0)));
        break;
      }
      case 3: {
        const double saw = phase - std::floor(phase);
        list.push_back(low + (high - low) * (saw < 0.5 ? 2.0 * saw : 2.0 - 2.0 * saw));
        break;
      }
      default:
        list.push_back(12.0 - 7.0 * std::cos(2.0 * std::numbers::pi * (0.1 * t + 0.04 * t * t)));
    }
  }
  return list;
}

/// The rig as its owner describes it.
plant::Rig described(const Surroundings& surroundings, Dice& dice) {
  plant::Rig rig;
  if (surroundings.bench == Bench::other_size) {
    rig.muscle.rest_radius_m *= dice.between(0.85, 1.2);
    rig.muscle.rest_length_m *= dice.between(0.7, 1.4);
    rig.valve.conductance_m3_per_s_Pa *= dice.between(0.7, 1.5);
    rig.hose.conductance_m3_per_s_Pa *= dice.between(0.7, 1.5);
  }
  if (surroundings.bench == Bench::badly_known)
    for (const Parameter& p : nominal_parameters(rig))
      if (p.path != "muscle.dead_volume" && !p.logarithmic) rig.spreads[p.path] = 3.0 * p.scale;
  return rig;
}

/// By how many of its deviations each of so many numbers of a rig is off.
std::vector<double> off_by(const Kind& kind, const Surroundings& surroundings, std::size_t count,
                           Dice& dice) {
  const double by = surroundings.bench == Bench::badly_known
                        ? 1.0
                        : surroundings.off_by.value_or(kind.verdict == Verdict::nothing_missing ? 0.0 : 0.1);
  std::vector<double> off;
  while (off.size() < count) off.push_back(by * dice.normal());
  if (surroundings.off_sheet == OffSheet::each_by_one)
    for (double& one : off) one = std::copysign(1.0, dice.normal());
  if (surroundings.off_sheet == OffSheet::two_by_three)
    for (int i = 0; i < 2; ++i)
      off[static_cast<std::size_t>(dice.between(0.0, static_cast<double>(count)))] =
          std::copysign(3.0, dice.normal());
  return off;
}

/// A rig that has it; notes in `hidden` what was planted.
plant::Rig rig_with(const Kind& kind, std::uint64_t seed, const Surroundings& surroundings, Dice& dice,
                    Hidden& hidden) {
  const plant::Rig nominal = described(surroundings, dice);
  hidden.data.rig = nominal;
  plant::Rig truth = nominal;
  // Rigs are off their data sheets; where nothing is to be found, as told only.
  const std::vector<Parameter> known = nominal_parameters(nominal, nominal.spreads);
  const std::vector<double> off = off_by(kind, surroundings, known.size(), dice);
  for (std::size_t i = 0; i < known.size(); ++i)
    *find(truth, known[i].path).value =
        std::clamp(known[i].unscaled(off[i]), known[i].lowest, known[i].highest);
  for (const Planted& planted : kind.plan) {
    const Found found = find(truth, planted.path);
    const bool number = !planted.path.starts_with("effects.");
    const double of_thesis = value_of(plant::Rig{}, planted.path);
    const bool shape = &planted != &kind.plan.front() && kind.effects.size() < 2;
    const double factor = dice.between(0.8, 1.25) * (shape ? 1.0 : surroundings.share);
    const double sign = seed % 2 == 0 && either_sign(planted.path) ? -1.0 : 1.0;
    *found.value = number  ? planted.value / of_thesis * value_of(nominal, planted.path)
                   : shape ? planted.value * factor
                           : of_thesis + sign * factor * (planted.value - of_thesis);
    if (!number) hidden.truth.push_back({planted.path, *found.value});
  }
  for (const Parameter& p : nominal_parameters(nominal, nominal.spreads))
    hidden.numbers.push_back({p.path, value_of(truth, p.path)});
  auto& bladder = truth.effects.get<plant::BladderElasticity>();
  if (bladder.stiffness_N_per_m > 0.0 && seed % 3 == 0) {
    bladder.variant = plant::BladderLaw::saturating;
    bladder.force_N = bladder.stiffness_N_per_m * 0.03;
    bladder.ratio = 0.06;
    bladder.stiffness_N_per_m = 0.0;
    std::erase_if(hidden.truth, [](const Planted& p) { return p.path.ends_with("stiffness"); });
    hidden.truth.push_back({"effects.bladder_elasticity.force", bladder.force_N});
    hidden.truth.push_back({"effects.bladder_elasticity.ratio", bladder.ratio});
  }
  auto& gauge = truth.effects.get<plant::GaugeError>();
  if (!gauge.absent() && seed % 3 == 0) {
    gauge = {.variant = plant::GaugeLaw::gain, .gain = gauge.offset_Pa / 3e5};
    hidden.truth = {{"effects.gauge_error.gain", gauge.gain}};
  }
  truth.effects.get<plant::GuideFriction>().slip_speed_m_per_s = 1e-3 * dice.between(0.6, 1.5);
  truth.effects.get<plant::ResidualForce>().terms = kind.law;
  put(surroundings.other_law, truth);
  if (kind.gauge) truth.sensors.put(plant::gauge());
  return truth;
}

/// What is read of it while a current drives it under a load.
template <class Waveform>
domain::Run read(const Hidden& hidden, const Waveform& current, double load_kg, std::size_t ticks,
                 std::uint64_t stream) {
  const auto controller = current.make(run::knowledge_of(hidden.rig, std::vector<double>(ticks)));
  plant::Rig rig = hidden.rig;
  rig.integrator = {solver::Method::cvode, 1e-8};
  const auto recording = run::simulate({.rig = rig,
                                        .load_kg = load_kg,
                                        .ticks = ticks,
                                        .noise = hidden.noise,
                                        .seed = hidden.seed,
                                        .stream = stream},
                                       *controller);
  domain::Run measured;
  measured.id = fmt::format("r{:02}", hidden.data.runs.size() + 1);
  measured.load_kg = load_kg;
  const bool gauge = hidden.rig.sensors.of(plant::Sensed::muscle_pressure) != nullptr;
  measured.read("contraction");
  if (gauge) measured.read("muscle_pressure");
  for (const auto& sample : recording.samples) {
    measured.current_mA.push_back(sample.current_mA);
    measured.judged().values.push_back(static_cast<double>(sample.counts) *
                                       run::contraction_per_count(hidden.rig));
    if (gauge)
      measured.find("muscle_pressure")->values.push_back(sample.shown[plant::Sensed::muscle_pressure]);
  }
  return measured;
}

/// Load and kind of current differ from run to run; of poor data there are only sines.
domain::Run measured_run(const Hidden& hidden, std::size_t run, const Surroundings& surroundings,
                         std::uint64_t stream, Dice& dice) {
  const double larger = std::pow(hidden.rig.muscle.rest_radius_m / plant::Rig{}.muscle.rest_radius_m, 2);
  constexpr double loads_kg[] = {11.138, 11.138, 16.138, 16.138, 23.406, 23.406, 13.870, 18.870, 18.870};
  constexpr std::size_t currents[] = {0, 1, 2, 3, 0, 1, 4, 3, 1};
  const auto rows = static_cast<std::size_t>(surroundings.lasting * dice.between(600.0, 900.0));
  controllers::RecordedCurrent recorded;
  recorded.samples_mA = current_mA(surroundings.poor ? 0 : currents[run], rows, dice);
  return read(hidden, recorded, larger * loads_kg[run], rows, stream);
}

}  // namespace

std::size_t kinds() {
  return all_kinds().size();
}

const std::string& title(std::size_t kind) {
  return all_kinds()[kind].title;
}

std::size_t kind_titled(std::string_view wanted) {
  const auto place = std::ranges::find(all_kinds(), wanted, &Kind::title);
  if (place == all_kinds().end()) throw std::invalid_argument(fmt::format("no data set hides {}", wanted));
  return static_cast<std::size_t>(place - all_kinds().begin());
}

Hidden hide(std::size_t index, std::uint64_t seed, const Surroundings& surroundings) {
  const Kind& kind = all_kinds()[index];
  Dice dice(1000 * seed + index);
  Hidden hidden{.title = kind.title,
                .verdict = kind.verdict,
                .effects = kind.effects,
                .noise = kind.noise,
                .seed = seed};
  hidden.other_law = surroundings.other_law != OtherLaw::none;
  if (hidden.noise.encoder_jitter == 0.0) hidden.noise.encoder_jitter = 5e-5;
  if (kind.gauge) hidden.noise.gauge_Pa = 400.0;
  hidden.rig = rig_with(kind, seed, surroundings, dice, hidden);
  if (kind.gauge) hidden.data.rig.sensors.put(plant::gauge());
  for (std::size_t run = 0; run < surroundings.runs; ++run)
    hidden.data.runs.push_back(measured_run(hidden, run, surroundings, 100 * index + run, dice));
  return hidden;
}

domain::Run measured_as(const NextExperiment& wanted, const Hidden& hidden) {
  const auto ticks = static_cast<std::size_t>(std::lround(wanted.measurement.duration_s / hidden.rig.tick_s));
  constexpr std::uint64_t stream = 100'000;  // beyond those of all kinds
  return std::visit([&](const auto& current) { return read(hidden, current, wanted.load_kg, ticks, stream); },
                    wanted.measurement.current.value());
}

}  // namespace mckibben::diagnose
