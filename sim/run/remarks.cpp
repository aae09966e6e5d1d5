// Words for limits and tunings; see the header.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/domain/number.hpp>
#include <sim/run/remarks.hpp>
#include <sim/run/robustness.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

constexpr double worth_saying = 0.01;
constexpr double no_gain = 0.95;  // of the cost without feedback
constexpr double missed = 0.2;    // of the target's range; five_loads ends within 0.17 of it
constexpr double rests_s = 0.5;   // at the end, before it is judged there
constexpr double misread = 0.1;   // of the mean absolute error
constexpr double jump = 0.1;      // of the way from where a run begins to the target's furthest value
constexpr double usual_skip_s = 2.0, skipped = 0.25;  // of the run: what a loop may need to get there

/// Whether errors count from the start of a run that begins elsewhere than its target.
bool begins_off_target(const TrackedRun& run, const Wanted& target, const plant::Rig& rig) {
  if (target.first != 0 || target.values.empty() || run.recording.samples.empty()) return false;
  const Sample& sample = run.recording.samples.front();
  const double start = rig.has_angle() ? sample.angle_rad : sample.state.joint.contraction_ratio;
  const auto [lowest, highest] = std::ranges::minmax(target.values);
  return std::abs(target.values.front() - start) > jump * std::max(highest - start, start - lowest);
}

/// Without the DAC's rounding, which would fill the text with digits.
std::string command(double value, const plant::Rig& rig) {
  return fmt::format("{} {}", domain::write_number(std::round(100.0 * value) / 100.0),
                     name_of(rig.command_unit()));
}

std::string place_and_share(bool low, const controllers::CurrentRange& limits, const plant::Rig& rig,
                            double share) {
  return fmt::format("at its {} {}, {}, for {:.0f} % of the time", low ? "lowest" : "highest",
                     plant::command_key(rig), command(low ? limits.lowest_mA : limits.highest_mA, rig),
                     100.0 * share);
}

/// Why it stood there, and the key to change: the controller's own limit, or the valve's.
std::string cause(bool low, const controllers::CurrentRange& limits, const plant::Rig& rig, bool calibrated) {
  const auto valve = controllers::working_range(knowledge_of(rig, {}));
  const double step_mA = (rig.dac.largest_command - rig.dac.lowest_command) / std::ldexp(1.0, rig.dac.bits);
  if (low && limits.lowest_mA > valve.lowest_mA + step_mA)
    return fmt::format("the rig's valve goes down to {}: lower lowest_command",
                       command(valve.lowest_mA, rig));
  if (!low && limits.highest_mA < valve.highest_mA - step_mA)
    return fmt::format("the rig's valve goes up to {}: raise highest_command",
                       command(valve.highest_mA, rig));
  return fmt::format(
      "the valve gives no {}{} would help",
      low ? "less pressure: a target that stays higher, a heavier load or a lower "
            "valve.zero_pressure"
          : "more pressure: a lower target, a lighter load or a higher valve.span_pressure (and "
            "supply_pressure)",
      calibrated ? ", or a calibration of this rig and load," : "");
}

std::string limit_warning(const Metrics& metrics, const std::optional<controllers::CurrentRange>& limits,
                          const plant::Rig& rig, bool calibrated) {
  const double lowest = metrics.at_lowest_current.value_or(0.0);
  const double highest = metrics.at_highest_current.value_or(0.0);
  if (!limits || lowest + highest < mostly) return "";
  const bool low = lowest >= highest;
  if (metrics.swings)
    return fmt::format(
        "it swings to and from the ends of its {}, where it stood for {:.0f} % of the time; lower gains "
        "(or a longer look_ahead, where the controller has one) or a slower target would help",
        plant::command_key(rig), 100.0 * (lowest + highest));
  return fmt::format("it stood {}; {}", place_and_share(low, *limits, rig, low ? lowest : highest),
                     cause(low, *limits, rig, calibrated));
}

/// "18.4 mm below".
std::string off_target(double error, const plant::Rig& rig) {
  return fmt::format("{:.1f} mm {}", 1e3 * std::abs(error) * rig.muscle.rest_length_m,
                     error > 0.0 ? "above" : "below");
}

bool rests_at_the_end(const std::vector<double>& target, double tick_s) {
  const auto ticks = static_cast<std::ptrdiff_t>(rests_s / tick_s);
  return std::ssize(target) > ticks && std::all_of(target.end() - ticks, target.end(),
                                                   [&](double ratio) { return ratio == target.back(); });
}

/// Whether a load that oscillates stands still in between, as friction makes it: of a sine 3 % are so slow.
bool sticks_between(const std::vector<Sample>& samples, const std::vector<double>& target,
                    const LimitCycle& cycle, double tick_s) {
  constexpr double slow = 0.05, sticks = 0.25;
  auto end = static_cast<std::size_t>(std::lround(cycle.from_s / tick_s)) + 1;
  while (end < target.size() && target[end] == target[end - 1]) ++end;
  const auto ticks = std::min(static_cast<std::size_t>(std::lround(2.0 * cycle.period_s / tick_s)), end - 1);
  std::vector<double> steps;
  for (std::size_t k = end - ticks; k < end; ++k)
    steps.push_back(
        std::abs(samples[k].state.joint.contraction_ratio - samples[k - 1].state.joint.contraction_ratio));
  const double largest = std::ranges::max(steps);
  return static_cast<double>(std::ranges::count_if(steps, [&](double step) {
           return step < slow * largest;
         })) > sticks * static_cast<double>(ticks);
}

}  // namespace

double share_at_limit(const TrackedRun& run) {
  if (run.joint) return run.joint->at_limit;
  return run.metrics.at_lowest_current.value_or(0.0) + run.metrics.at_highest_current.value_or(0.0);
}

std::string limit_words(const Comparison& comparison, const plant::Rig& rig, std::string_view controller) {
  const TrackedRun* most = nullptr;
  double lowest = 0.0, highest = 0.0, runs = 0.0;
  for (const TrackedRun& run : comparison.runs) {
    if (run.controller != controller || !run.failure.empty() || !run.limits) continue;
    lowest += *run.metrics.at_lowest_current;
    highest += *run.metrics.at_highest_current;
    runs += 1.0;
    if (most == nullptr || share_at_limit(run) > share_at_limit(*most)) most = &run;
  }
  if (most == nullptr || (lowest + highest) / runs < worth_saying) return "";
  std::string words;
  if (lowest > 0.0) words = place_and_share(true, *most->limits, rig, lowest / runs);
  if (highest > 0.0)
    words += (words.empty() ? "" : " and ") + place_and_share(false, *most->limits, rig, highest / runs);
  if (runs > 1.0)
    words += fmt::format(" (with {} kg for {:.0f} %)", domain::write_kg(most->load_kg),
                         100.0 * share_at_limit(*most));
  return "stood " + words;
}

std::string cycle_words(const Comparison& comparison, const plant::Rig& rig, std::string_view controller) {
  const TrackedRun* widest = nullptr;
  std::size_t runs = 0;
  for (const TrackedRun& run : comparison.runs) {
    if (run.controller != controller) continue;
    ++runs;
    if (run.cycle && (widest == nullptr || run.cycle->amplitude > widest->cycle->amplitude)) widest = &run;
  }
  if (widest == nullptr) return "";
  return fmt::format("oscillates where its target rests, by ±{:.2g} mm{}",
                     1e3 * widest->cycle->amplitude * rig.muscle.rest_length_m,
                     runs > 1 ? fmt::format(" (with {} kg)", domain::write_kg(widest->load_kg)) : "");
}

std::string knowing_words(const domain::Scenario& scenario) {
  std::vector<std::string> names;
  bool others = false;
  for (const controllers::Settings& one : scenario.controllers) {
    const std::string name = controllers::name_of(one);
    const bool plans = controllers::part_of<controllers::PlansWithModel>(one) != nullptr;
    if (plans && !scenario.believed.contains(name)) names.push_back(name);
    others = others || (!plans && !domain::is_given(one));
  }
  if (names.empty() || !others) return "";
  return fmt::format(
      "{} know{} the simulated rig exactly; for a fair comparison: rig: FILE of the one you have",
      fmt::join(names, ", "), names.size() == 1 ? "s" : "");
}

std::string counted_words(const domain::Scenario& scenario, const Comparison& comparison) {
  const bool from_the_start =
      std::ranges::all_of(comparison.targets, [](const Wanted& target) { return target.first == 0; });
  if (scenario.skip_s) return from_the_start ? "" : fmt::format(", from {:g} s on", *scenario.skip_s);
  const bool with_the_way_there = std::ranges::any_of(comparison.runs, [&](const TrackedRun& run) {
    return run.followed() && run.target < comparison.targets.size() &&
           begins_off_target(run, comparison.targets[run.target], scenario.rig);
  });
  if (from_the_start && !with_the_way_there) return "";
  return fmt::format(", from {} on{}", from_the_start ? "0 s" : "the target's first move",
                     with_the_way_there
                         ? fmt::format(", the way from rest included (skip: {:.2g} s leaves it out)",
                                       std::min(usual_skip_s, skipped * scenario.duration_s))
                         : "");
}

std::string limit_warning(const TrackedRun& run, const plant::Rig& rig, bool calibrated) {
  if (run.joint && run.followed() && run.failure.empty() && run.joint->at_limit >= mostly)
    return fmt::format(
        "some {} stood at an end of what its valve answers to for {:.0f} % of the time: the stiffness, "
        "or "
        "co_contraction, leaves the angle nothing, or both need more than the valves have",
        plant::command_key(rig), 100.0 * run.joint->at_limit);
  return limit_warning(run.metrics, run.limits, rig, calibrated);
}

std::string missed_warning(const TrackedRun& run, const Wanted& wanted, const controllers::Settings& settings,
                           const plant::Rig& rig) {
  const auto* terms = controllers::part_of<controllers::CalibratedSettings>(settings);
  const auto* open = std::get_if<controllers::OpenLoopSettings>(&settings);
  const bool to_one_point = open != nullptr && open->mode == controllers::OpenLoopMode::triangle;
  const bool no_tube = std::holds_alternative<controllers::StaticInverseSettings>(settings) &&
                       run.metrics.final_error < 0.0 && !rig.effects.get<plant::BladderElasticity>().absent();
  if ((terms == nullptr && !no_tube) || to_one_point || rig.has_angle() || !run.failure.empty() ||
      run.recording.samples.empty() || !rests_at_the_end(wanted.ratios, rig.tick_s))
    return "";
  const auto [lowest, highest] = std::ranges::minmax(wanted.ratios);
  const auto is_off = [&, range = highest - lowest](double error) {
    return std::abs(error) > missed * range;
  };
  if (lowest == highest || !is_off(run.metrics.final_error)) return "";

  std::string text = "it ends " + off_target(run.metrics.final_error, rig) + " its target";
  if (const double start =
          run.recording.samples.front().state.joint.contraction_ratio - wanted.ratios.front();
      is_off(start))
    text += fmt::format(" and began {} target.start, to which no feedback brings it", off_target(start, rig));
  if (no_tube)
    return text +
           "; its law has no rubber tube (effects.bladder_elasticity), and this rig has one: kind: "
           "model_inverse has it, too, and feedback helps";
  if (open != nullptr && moves_in_steps(wanted.ratios))
    return text +
           "; its model gives commands for speeds, and its target moves in steps: a target of kind: "
           "minimum_jerk or ramps, open_loop_limited, which slows it, or feedback (kind: feedforward_pid)";
  const auto& found = run.recording.findings;
  const auto outside = controllers::value_of(found, "ticks_outside_calibrated_speed");
  if (const auto& range = terms->model.range; outside > 0.0 && !terms->extrapolate_target)
    text += fmt::format(
        "; at {:.0f} of {} ticks its command should change slower or faster than those of the calibration, "
        "{:.3g} to {:.3g} {}/s, and it takes the nearest: extrapolate_target: true, or calibrate with such "
        "commands",
        outside, wanted.ratios.size(), range.lowest_speed_mA_per_s, range.highest_speed_mA_per_s,
        name_of(rig.command_unit()));
  return text +
         "; feedback (kind: feedforward_pid) would help and, if its calibration is of another rig, one of "
         "this rig";
}

std::string load_warning(const TrackedRun& run, const controllers::Settings& settings) {
  const auto* terms = controllers::part_of<controllers::CalibratedSettings>(settings);
  if (terms == nullptr || !run.failure.empty()) return "";
  const double believed_kg =
      terms->assumed_load_kg.value_or(controllers::value_of(run.recording.findings, "believed_load"));
  if (std::abs(believed_kg - run.load_kg) <= controllers::weighing_tolerance * run.load_kg) return "";
  const std::string load = domain::write_kg(run.load_kg);
  return fmt::format("it takes its load of {} kg for {:.3g} kg: write assumed_load: {} kg{}", load,
                     believed_kg, load,
                     terms->assumed_load_kg ? "" : ", or a weighing or calibration that fits this rig");
}

std::string reading_warning(const TrackedRun& run, const controllers::Settings& settings,
                            const plant::Rig& rig) {
  const auto* weighs = controllers::part_of<controllers::CalibratedSettings>(settings);
  const bool reads = controllers::part_of<controllers::PidForm>(settings) != nullptr ||
                     controllers::part_of<controllers::GuestTerms>(settings) != nullptr ||
                     (weighs != nullptr && !weighs->assumed_load_kg);  // others know the rig, or read nothing
  std::string keys;
  if (rig.joint.reading_offset_m != 0.0) keys = "joint.reading_offset";
  if (!rig.effects.get<plant::EncoderScale>().absent())
    keys += std::string(keys.empty() ? "" : " and ") + "effects.encoder_scale.error";
  if (!reads || keys.empty() || !run.failure.empty() || run.recording.samples.empty()) return "";
  double too_high = 0.0;
  for (const Sample& sample : run.recording.samples) too_high += sample.misread_ratio;
  too_high /= static_cast<double>(run.recording.samples.size());
  if (rig.has_angle()) too_high *= rig.muscle.rest_length_m / rig.joint.wheel_radius_m;
  if (std::abs(too_high) <= misread * run.metrics.mae) return "";
  return fmt::format(
      "it reads {:.2g} {} too {} in the mean ({}), which it cannot see: the errors, which are true ones, "
      "have that in them, as on a bench that reads so; for one that reads right take it out of the rig",
      std::abs(too_high) * (rig.has_angle() ? 1.0 / plant::degree_rad : 1e3 * rig.muscle.rest_length_m),
      rig.has_angle() ? "deg" : "mm", too_high > 0.0 ? "high" : "low", keys);
}

bool follows_nothing(const domain::Scenario& scenario, const Comparison& comparison) {
  return !scenario.controllers.empty() && std::ranges::all_of(scenario.controllers, domain::is_given) &&
         std::ranges::all_of(comparison.targets, [](const Wanted& target) {
           return std::ranges::all_of(target.values, [](double value) { return value == 0.0; });
         });
}

std::string cycle_warning(const TrackedRun& run, const Wanted& wanted, const controllers::Settings& settings,
                          const plant::Rig& rig) {
  const auto& cycle = run.cycle;
  if (!cycle || (run.metrics.swings && !limit_warning(run, rig).empty())) return "";
  std::string text = fmt::format(
      "it oscillates where its target rests from {:.3g} s on, by ±{:.2g} mm with a period of {:.2g} s",
      cycle->from_s, 1e3 * cycle->amplitude * rig.muscle.rest_length_m, cycle->period_s);
  if (const auto* pid = controllers::part_of<controllers::PidTerms>(settings))
    text += fmt::format(
        "; a lower proportional{}{} would help: linearise shows the margins",
        pid->proportional_mA
            ? fmt::format(" (it is {:.4g} {})", *pid->proportional_mA, name_of(rig.command_unit()))
            : "",
        sticks_between(run.recording.samples, wanted.ratios, *cycle, rig.tick_s)
            ? fmt::format(
                  ", a longer integral_time or, as friction holds it in between, a dead_zone of {:.2g}",
                  2.0 * cycle->amplitude)
            : " or a longer integral_time");
  return text;
}

bool gained_nothing(const TunedController& tuned) {
  return tuned.failure.empty() && tuned.idle_cost && tuned.tuned.cost > no_gain * *tuned.idle_cost;
}

bool in_doubt(const Comparison& comparison, std::string_view controller) {
  const auto has = [&](const auto& list, const auto& is_bad) {
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& one) { return one.controller == controller && is_bad(one); });
  };
  return has(comparison.runs,
             [](const TrackedRun& run) {
               return !run.failure.empty() || run.cycle || share_at_limit(run) >= mostly;
             }) ||
         has(comparison.tuned, gained_nothing);
}

std::string tuning_warning(const TunedController& tuned, const plant::Rig& rig) {
  const std::string limit = limit_warning(tuned.metrics, tuned.limits, rig, false);
  return fmt::format(
      "its tuning gained nothing: the cost is {:.3g}, without any feedback {:.3g}; {}", tuned.tuned.cost,
      *tuned.idle_cost,
      limit.empty() ? "feedback does not help with this target: can the load follow it (tuning_load), is the "
                      "delay too long (feedback_delay_ticks)?"
                    : limit);
}

}  // namespace mckibben::run
