// The menu, and the power of each item; see the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <variant>

#include <Eigen/Core>
#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/diagnose/plan.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/engine/failure.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::diagnose {
namespace {

constexpr double lasting_s = thresholds.plan.lasting_s;

/// What one valve is commanded with.
struct Played {
  std::string words;
  domain::CampaignWaveform waveform;

  double at_mA(double time_s) const {
    return std::visit(
        [&](const auto& one) {
          if constexpr (requires { one.at(time_s); })
            return one.at(time_s);
          else
            return 0.0;  // a recorded current: not on the menu
        },
        waveform);
  }
};

/// An item of the menu: the current of one muscle, or of each of two.
struct Item {
  std::string words;
  domain::CampaignCurrent current;
  std::vector<Played> valves;
};

std::string name_of(const Played& played) {
  return std::visit([](const auto& one) { return one.name; }, played.waveform);
}

controllers::SineCurrent sine(std::string name, double low_mA, double high_mA, double period_s) {
  return {.name = std::move(name), .low_mA = low_mA, .high_mA = high_mA, .period_s = period_s};
}

template <class Current>
controllers::StepCurrent in_steps(std::string name, double each_s, const Current& mA_at) {
  controllers::StepCurrent steps{.name = std::move(name), .start_mA = mA_at(0.0), .moves = {}};
  double last_mA = *steps.start_mA;
  for (int k = 1; k * each_s < lasting_s; ++k)
    if (const double time_s = k * each_s, mA = mA_at(time_s); mA != last_mA)
      steps.moves.push_back({time_s, last_mA = mA});
  return steps;
}

/// In the tact of three ticks, as no waveform adds a triangle to a ramp.
controllers::StepCurrent triangles_on_a_ramp(double low_mA, double high_mA, double height_mA, double tick_s) {
  const controllers::TriangleCurrent triangle{.low_mA = 0.0, .high_mA = height_mA, .period_s = 1.25};
  return in_steps("triangles_on_a_ramp", 3.0 * tick_s, [&](double time_s) {
    return std::lerp(low_mA, high_mA - height_mA, time_s / lasting_s) + triangle.at(time_s);
  });
}

/// Lowest and highest command: all that the valve has; of a pair what keeps both muscles pulling.
std::array<double, 2> range_mA(const Rig& rig, bool pair) {
  const double low = rig.valve.zero_command;
  const double high = std::min(rig.valve.span_command, rig.dac.largest_command);
  if (!pair) return {low, high};
  const auto [least, most] = thresholds.plan.of_a_pair;
  return {std::lerp(low, high, least), std::lerp(low, high, most)};
}

std::vector<Played> waveforms(const Rig& rig, std::array<double, 2> range) {
  const auto [low, high] = range;
  const double span = high - low;
  const auto at = [low = low, span](double share) { return low + share * span; };
  controllers::StairCurrent stair{.name = "staircase", .low_mA = low, .high_mA = high, .steps = 6};
  stair.dwell_s = lasting_s / (2.0 * stair.steps + 1.0);
  const controllers::StepCurrent steps{
      .name = "long_holds", .start_mA = low, .moves = {{0.5, at(0.6)}, {3.6, at(0.15)}, {6.8, at(0.9)}}};
  const controllers::ChirpCurrent chirp{.name = "chirp",
                                        .low_mA = at(0.1),
                                        .high_mA = at(0.9),
                                        .first_frequency_Hz = 0.1,
                                        .last_frequency_Hz = 2.0,
                                        .lasting_s = lasting_s};
  std::vector<Played> all;
  const auto add = [&](const std::string& words, auto waveform) {
    all.push_back({in_unit(rig.command_unit(), words), std::move(waveform)});
  };
  add(fmt::format("one slow sine from {:g} to {:g} mA and back", low, high),
      sine("slow_sine", low, high, lasting_s));
  add(fmt::format("fast sine between {:g} and {:g} mA, 1.25 s each", low, high),
      sine("fast_sine", low, high, 1.25));
  add(fmt::format("small sine between {:.3g} and {:.3g} mA, 2.5 s each", at(0.4), at(0.6)),
      sine("small_sine", at(0.4), at(0.6), 2.5));
  add(fmt::format("staircase from {:g} to {:g} mA in {} steps and down again, {:.2g} s each", low, high,
                  stair.steps, stair.dwell_s),
      stair);
  add(fmt::format("small triangles of {:.2g} mA on a slow ramp from {:g} to {:g} mA", span / 16.0, low, high),
      triangles_on_a_ramp(low, high, span / 16.0, rig.tick_s));
  add(fmt::format("steps to {:.3g}, {:.3g} and {:.3g} mA, each held for 3 s", at(0.6), at(0.15), at(0.9)),
      steps);
  add(fmt::format("chirp between {:.3g} and {:.3g} mA, from 0.1 to 2 Hz", at(0.1), at(0.9)), chirp);
  return all;
}

/// Both muscles of a pair by the same waveform: alike, or muscle 2 by as much less as muscle 1 has more.
Item of_two(const Rig& rig, const Played& one, Played two, bool against) {
  const std::string of_2 = two.words == one.words ? "the same" : two.words;
  std::string words = fmt::format("muscle 1: {}; muscle 2: {}", one.words, of_2);
  if (against) {
    const auto [low, high] = range_mA(plant::opposite_rig(rig), true);
    const double both_mA = low + high;
    words = in_unit(rig.command_unit(),
                    fmt::format("muscle 1: {}; muscle 2: {:g} mA minus {}", one.words, both_mA, of_2));
    two.waveform = in_steps(name_of(two) + "_against", rig.tick_s,
                            [&](double time_s) { return both_mA - two.at_mA(time_s); });
  }
  return {fmt::format("{}, {:g} s", words, lasting_s),
          {.name = name_of(one) + (against ? "_against" : "_together"),
           .duration_s = lasting_s,
           .current_1 = one.waveform,
           .current_2 = two.waveform},
          {one, two}};
}

std::vector<Item> menu(const Rig& rig) {
  const bool pair = rig.pair() != nullptr;
  const std::vector<Played> ones = waveforms(rig, range_mA(rig, pair));
  std::vector<Item> items;
  if (!pair) {
    for (const Played& one : ones)
      items.push_back(
          {fmt::format("{}, {:g} s", one.words, lasting_s), {name_of(one), lasting_s, one.waveform}, {one}});
    return items;
  }
  const Rig opposite = plant::opposite_rig(rig);
  const std::vector<Played> twos = waveforms(opposite, range_mA(opposite, pair));
  for (std::size_t i = 0; i < ones.size(); ++i)
    for (const bool against : {true, false}) items.push_back(of_two(rig, ones[i], twos[i], against));
  return items;
}

/// The data set's loads, their halves and 1.3 times them, none within 8 % of another, none that the rig would
/// not lift by 5 % of its length. None hangs at a pair: what its link carries is the rig's.
std::vector<double> loads_kg(const domain::Dataset& data, const Rig& rig) {
  if (rig.pair() != nullptr) return {0.0};
  std::vector<double> wanted;
  for (const double factor : thresholds.plan.loads)
    for (const domain::Run& run : data.runs) wanted.push_back(std::round(1e3 * factor * run.load_kg) / 1e3);
  const auto force = run::knowledge_of(rig, {}).model;
  const double most_kg =
      force.force_N(thresholds.plan.least_rise, rig.valve.span_pressure_Pa) / plant::gravity_m_per_s2;
  std::vector<double> kept;
  for (const double load_kg : wanted) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](double other) {
      return std::abs(load_kg / other - 1.0) < thresholds.plan.same_load;
    });
    if (rig.pulled_kg(load_kg) < most_kg && !known) kept.push_back(load_kg);
  }
  return kept;
}

/// The currents as the DAC gives them, at each tick, and what would be judged; of a pair with as many
/// readings as the data have.
domain::Run played(const Item& item, const domain::Dataset& data, const Rig& rig, double load_kg) {
  domain::Run run;
  run.load_kg = load_kg;
  run.readings.push_back({data.runs.front().judged().channel});
  const auto each = static_cast<std::size_t>(std::max(1L, std::lround(data.row_s() / rig.tick_s)));
  for (std::size_t k = 0; static_cast<double>(k) * rig.tick_s < lasting_s; ++k) {
    const double time_s = static_cast<double>(k) * rig.tick_s;
    const auto given_mA = [&](const Played& valve) {
      return plant::dac_output_mA(rig.dac, valve.at_mA(time_s));
    };
    if (rig.pair() == nullptr) {
      run.current_mA.push_back(given_mA(item.valves.front()));
      continue;
    }
    if (!run.measured) run.measured.emplace();
    run.measured->time_s.push_back(time_s);
    if (k % each == 0) run.measured->rows.push_back(k);
    for (std::size_t muscle = 1; muscle <= 2; ++muscle)
      run.measured->give("command", muscle).push_back(given_mA(item.valves[muscle - 1]));
  }
  return run;
}

/// What a muscle's valve was commanded with, and when.
struct Commands {
  const std::vector<double>& mA;
  const std::vector<double>& time_s;  ///< empty: a row each tick
  double begins_s = 0.0;
};
std::vector<Commands> commands_of(const domain::Run& run, const Rig& rig) {
  if (rig.pair() == nullptr) return {{run.current_mA, run.time_s}};
  const domain::Measurement& measured = *run.measured;
  const double begins_s = measured.time_s.front();
  return {{measured.given("command", 1), measured.time_s, begins_s},
          {measured.given("command", 2), measured.time_s, begins_s}};
}

/// Whether a run of the data had these currents under about this load.
bool is_made(const domain::Dataset& data, const domain::Run& wanted, const Rig& rig) {
  const PlanThresholds& same = thresholds.plan;
  const double most_mA = same.same_current * (rig.valve.span_command - rig.valve.zero_command);
  const std::vector<Commands> asked = commands_of(wanted, rig);
  const auto off = [&](const Commands& had, const std::vector<double>& wanted_mA, double begins_s) {
    double square = 0.0;
    std::size_t at = 0;
    for (std::size_t k = 0; k < wanted_mA.size(); ++k) {
      const double time_s = begins_s + static_cast<double>(k) * rig.tick_s;
      const auto row_s = [&](std::size_t row) {
        return had.time_s.empty() ? static_cast<double>(row) * data.row_s() : had.time_s[row] - had.begins_s;
      };
      while (at + 1 < had.mA.size() && row_s(at + 1) <= time_s + 1e-9) ++at;
      square += std::pow(had.mA[at] - wanted_mA[k], 2);
    }
    return std::sqrt(square / static_cast<double>(wanted_mA.size()));
  };
  return std::ranges::any_of(data.runs, [&](const domain::Run& run) {
    const std::vector<Commands> had = commands_of(run, rig);
    if (std::ranges::any_of(had, [](const Commands& one) { return one.mA.empty(); }) ||
        std::abs(run.load_kg / wanted.load_kg - 1.0) >= same.same_load)  // where none hangs, not a number
      return false;
    for (double begins_s = 0.0; begins_s < same.begins_s; begins_s += rig.tick_s) {
      bool all = true;
      for (std::size_t i = 0; i < had.size() && all; ++i) all = off(had[i], asked[i].mA, begins_s) < most_mA;
      if (all) return true;
    }
    return false;
  });
}

/// Sum of squares of the difference between two readings that no offset and no gain takes away.
double unexplained(const std::vector<double>& one, const std::vector<double>& other) {
  const auto rows = static_cast<Eigen::Index>(one.size());
  Eigen::VectorXd shape = Eigen::Map<const Eigen::VectorXd>(one.data(), rows);
  Eigen::VectorXd difference = Eigen::Map<const Eigen::VectorXd>(other.data(), rows) - shape;
  shape.array() -= shape.mean();
  difference.array() -= difference.mean();
  if (shape.squaredNorm() > 0.0) difference -= shape * (shape.dot(difference) / shape.squaredNorm());
  return difference.squaredNorm();
}

/// The places of the largest values, largest first.
std::vector<std::size_t> largest(const std::vector<double>& values, std::size_t most) {
  std::vector<std::size_t> places(values.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::ranges::stable_sort(places, std::ranges::greater(), [&](std::size_t i) { return values[i]; });
  places.resize(std::min(places.size(), most));
  return places;
}

}  // namespace

std::optional<NextExperiment> plan(const domain::Dataset& data, unsigned threads, const Rig& one,
                                   const Rig& other, std::vector<std::string> names, const Power& power_of) {
  const std::vector<Item> items = menu(one);
  const std::vector<double> loads = loads_kg(data, one);
  const auto run_of = [&](std::size_t job) {
    return played(items[job % items.size()], data, one, loads[job / items.size()]);
  };
  // What cannot be simulated stays at 0.
  const auto for_each = [&](std::size_t count, const std::function<double(std::size_t)>& value) {
    std::vector<double> values(count, 0.0);
    run::for_each_job(
        count, threads,
        [&](std::size_t i) {
          try {
            values[i] = value(i);
          } catch (const engine::NumericalFailure&) {
            // Not an experiment to propose.
          }
        },
        [](std::size_t) {});
    return values;
  };
  const auto apart = for_each(items.size() * loads.size(), [&](std::size_t job) {
    const auto run = run_of(job);
    if (is_made(data, run, one)) return 0.0;  // it was of no help
    const Loaded both[] = {{one, run.load_kg}, {other, run.load_kg}};
    const auto readings = predict(run, both, data.rig.integrator.method);
    return unexplained(readings[0].judged(), readings[1].judged());
  });
  const auto promising = largest(apart, thresholds.plan.refitted);
  const auto powers = for_each(promising.size(), [&](std::size_t i) {
    return apart[promising[i]] > 0.0 ? power_of(run_of(promising[i])) : 0.0;
  });
  const auto best = std::ranges::max_element(powers);
  if (best == powers.end() || *best < thresholds.plan.least_power) return std::nullopt;
  const std::size_t job = promising[static_cast<std::size_t>(best - powers.begin())];
  const Item& chosen = items[job % items.size()];
  return NextExperiment{
      .separates = std::move(names),
      .current = chosen.words,
      .waveform = std::visit([](const auto& waveform) { return std::string(waveform.kind); },
                             chosen.valves.front().waveform),
      .load_kg = loads[job / items.size()],
      .expected_power = *best,
      .measurement = chosen.current};
}

}  // namespace mckibben::diagnose
