// Runs row by row; see the header.
#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/data/amount.hpp>
#include <sim/data/columns.hpp>
#include <sim/data/examine.hpp>
#include <sim/data/lost_rows.hpp>
#include <sim/data/odd_readings.hpp>
#include <sim/data/parts.hpp>
#include <sim/data/plausible.hpp>
#include <sim/data/series.hpp>
#include <sim/data/start.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/domain/number.hpp>
#include <sim/domain/rig_number.hpp>

namespace mckibben::data {
namespace {

constexpr const ReadingThresholds& of_readings = thresholds.reading;

/// The readings of runs whose columns are what they are called.
class Readings {
 public:
  Readings(const domain::Dataset& data, const std::vector<Expected>& expected, Examined& result)
      : data_(data),
        expected_(expected),
        result_(result),
        bench_(data.lengths_are_given()),
        pair_(data.rig.pair() != nullptr),
        angle_(data.rig.has_angle()),
        count_(reading_grain(data.judged(), data.rig)) {}

  void operator()() {
    for (std::size_t i = 0; i < data_.runs.size(); ++i) {
      if (data_.runs[i].rows() != expected_[i].judged().size()) continue;
      for (std::size_t reading = 1; reading < data_.runs[i].readings.size(); ++reading)
        if (data_.runs[i].readings[reading].channel.is_pressure()) gauge(i, reading);
      if (data_.judged() == domain::Judged::pressure)
        presses(i);
      else if (bench_)
        pulls(i);
      else if (moves(i))
        readings(i);
    }
    never_lifted();
    copies();
  }

 private:
  /// The judged reading's column, and what shows it.
  const char* reading() const { return angle_ ? "angle_rad" : "contraction_ratio"; }
  const char* moving() const { return angle_ ? "joint" : "load"; }
  bool of_points(std::size_t run) const {
    return data_.runs[run].measured && data_.runs[run].measured->point_s > 0.0;
  }
  void find(std::size_t run, Severity severity, std::string kind, std::string message) {
    result_.findings.push_back(
        {.runs = {run}, .message = std::move(message), .severity = severity, .kind = std::move(kind)});
  }
  void leave_out(std::size_t run, std::string why) {
    find(run, Severity::left_out, "reading", std::move(why));
    result_.left_out[run] = true;
  }
  std::string amount(double value) const { return amount_of(data_.judged(), value, data_.rig, 3); }
  double time_s(std::size_t row) const {
    return data_.rows_begin_s() + static_cast<double>(row) * data_.row_s();
  }

  void gauge(std::size_t i, std::size_t reading) {
    const auto& [channel, shown, missing] = data_.runs[i].readings[reading];
    const Series& model = expected_[i].readings[reading];
    const std::string name = channel.name_in_dataset();
    const bool constant = range(shown) == 0.0;
    const bool should_move = range(model) > of_readings.gauge_bar * plant::Pa_per_bar;
    if (!constant && (!should_move || Line(shown, model).slope > of_readings.gauge_slope)) {
      mask_spikes(i, name, shown, model, of_readings.gauge_step_Pa);
      return;
    }
    result_.dead_gauges.push_back({i, channel});
    find(i, Severity::ignored, "",
         fmt::format("{} {}", name,
                     constant ? fmt::format("is {:.4g} throughout", shown.front() / plant::Pa_per_bar)
                              : "does not follow the " + command_));
  }

  void mask(std::size_t run, const Stretch& stretch) {
    std::fill(result_.masked[run].begin() + static_cast<std::ptrdiff_t>(stretch.begin),
              result_.masked[run].begin() + static_cast<std::ptrdiff_t>(stretch.end), true);
  }

  void mask_spikes(std::size_t i, std::string_view column, const Series& values, const Series& model,
                   double step) {
    const auto outliers = spikes(values, sharpest_nearby(model, data_.row_s()), step, !of_points(i));
    if (outliers.empty()) return;
    std::string times;
    for (std::size_t n = 0; n < outliers.size(); ++n) {
      mask(i, outliers[n]);
      if (n < 3) times += fmt::format("{}{:.3f} s", n > 0 ? ", " : "", time_s(outliers[n].begin));
    }
    find(i, Severity::masked, "",
         fmt::format("{} outlier{} in {}, at {}{}", outliers.size(), outliers.size() > 1 ? "s" : "", column,
                     times, outliers.size() > 3 ? " and later" : ""));
  }

  void pulls(std::size_t i) {
    const std::vector<bool>& masked = result_.masked[i];
    if (std::find(masked.begin(), masked.end(), false) == masked.end())
      leave_out(i, "the cord was slack all the time: no force was read");
  }

  void presses(std::size_t i) {
    const Series& values = data_.runs[i].judged().values;
    if (range(values) == 0.0)
      leave_out(i, fmt::format("the pressure is {:.4g} bar throughout: is the gauge connected?",
                               values.front() / plant::Pa_per_bar));
    else
      mask_spikes(i, "the pressure", values, expected_[i].judged(), of_readings.gauge_step_Pa);
  }

  /// Runs whose load stayed on its stop, as the force of the rig says: then the number may be wrong, of the
  /// load or of the rig.
  void never_lifted() {
    if (data_.judged() != domain::Judged::contraction) return;
    struct Stayed {
      std::vector<std::size_t> runs;
      double most_Pa = 0.0;
    };
    std::map<double, Stayed> by_load;
    std::vector<double> loads_kg;
    for (const domain::Run& run : data_.runs) loads_kg.push_back(run.load_kg);
    for (std::size_t i = 0; i < data_.runs.size(); ++i) {
      const domain::Run& run = data_.runs[i];
      const Series& pressure_Pa = expected_[i].pressure_Pa;
      const auto stays = [](const Series& ratios) {
        return !ratios.empty() && *std::ranges::max_element(ratios) < domain::hardly_lifted;
      };
      if (pressure_Pa.empty() || range(pressure_Pa) < of_readings.gauge_bar * plant::Pa_per_bar ||
          !stays(run.judged().values) || !stays(expected_[i].judged()))
        continue;
      const double highest_Pa = *std::ranges::max_element(pressure_Pa);
      if (domain::never_lifted(run.load_kg, data_.rig, highest_Pa).empty()) continue;
      Stayed& stayed = by_load[run.load_kg];
      stayed.runs.push_back(i);
      stayed.most_Pa = std::max(stayed.most_Pa, highest_Pa);
    }
    for (auto& [load_kg, stayed] : by_load)
      result_.findings.push_back(
          {.runs = std::move(stayed.runs),
           .message =
               fmt::format("the load hardly leaves its stop: load = {} kg is {}", domain::write_kg(load_kg),
                           domain::never_lifted(load_kg, data_.rig, stayed.most_Pa, loads_kg)),
           .severity = Severity::doubtful});
  }

  bool moves(std::size_t i) {
    const domain::Run& run = data_.runs[i];
    const double largest_mA = run.current_mA.empty() || pair_ ? std::numeric_limits<double>::infinity()
                                                              : *std::ranges::max_element(run.current_mA);
    const double dead_mA =
        data_.rig.valve.zero_command +
        of_readings.dead_current * (data_.rig.valve.span_command - data_.rig.valve.zero_command);
    const double should = range(expected_[i].judged());
    if (largest_mA <= dead_mA)
      leave_out(i, fmt::format("the {} stays at or below {:.4g} {} and moves nothing", command_, largest_mA,
                               name_of(data_.rig.command_unit())));
    else if (range(run.judged().values) > of_readings.moving_counts * count_)
      return true;
    else if (should > of_readings.should_move_counts * count_)
      leave_out(i, fmt::format("the reading never changes, though the {0} should move by {1} (is the "
                               "{2} connected, the {0} held?)",
                               moving(), amount(should), angle_ ? "sensor" : "encoder"));
    else
      leave_out(i, "nothing moves");
    return false;
  }

  void readings(std::size_t i) {
    const Series& values = data_.runs[i].judged().values;
    const Series& model = expected_[i].judged();
    std::vector<bool>& masked = result_.masked[i];
    const Series sharpest = sharpest_nearby(model, data_.row_s());
    const auto absent = std::count(masked.begin(), masked.end(), true);  // no fault: read at other stamps
    range_ends(i);
    const double count = bench_ ? count_ : std::max(count_, coarse_step(data_, data_.runs[i], values));
    mask_spikes(i, reading(), values, model, count);
    stand_still(i, stills(values, model, count, data_.row_s()));
    if (result_.left_out[i]) return;
    const auto lost = std::count(masked.begin(), masked.end(), true) - absent;
    const auto read = static_cast<std::ptrdiff_t>(masked.size()) - absent;
    if (const auto rows = after_lost_rows(data_.runs[i], data_.rig.tick_s); !rows.empty()) {
      leave_out(i, fmt::format("rows are missing before {:.3f} s", time_s(rows.front())));
      result_.findings.back().told = true;
    } else if (const auto row = lost_counts(values, sharpest, with_gaps(i, masked), count, data_.row_s()))
      leave_out(i, lost_in_words(i, values[*row] - values[*row - 1], time_s(*row)));
    else if (static_cast<double>(lost) > of_readings.most_masked * static_cast<double>(read) || read == 0)
      leave_out(i, "too little of it is left");
  }

  /// With the rows after a gap in the stamps: what lies between was not seen.
  std::vector<bool> with_gaps(std::size_t i, std::vector<bool> masked) const {
    if (!data_.runs[i].measured) return masked;
    const domain::Measurement& stamps = *data_.runs[i].measured;
    for (std::size_t k = 1; k < std::min(masked.size(), stamps.rows.size()); ++k)
      if (stamps.time_s[stamps.rows[k]] - stamps.time_s[stamps.rows[k - 1]] >
          of_readings.gap_rows * data_.row_s())
        masked[k] = true;
    return masked;
  }

  std::string lost_in_words(std::size_t i, double jump, double at_s) const {
    if (counts(data_, data_.runs[i]))
      return fmt::format("{} jumps by {:.3g} at {:.3f} s and stays there: counts were lost", reading(), jump,
                         at_s);
    return fmt::format(
        "{} jumps by {} at {:.3f} s and stays there: the sensor was moved, or what it looks at", reading(),
        amount(jump), at_s);
  }

  // What a sensor reads at the end of its range is no position.
  void range_ends(std::size_t i) {
    const plant::Sensor& sensor = data_.rig.sensors.position();
    const Series& values = data_.runs[i].judged().values;
    const double step = reading_per_count(data_.rig);
    std::size_t ended = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double own = values[k] / step * sensor.resolution, half = 0.5 * sensor.resolution;
      if (!(sensor.lowest && own <= *sensor.lowest + half) &&
          !(sensor.highest && own >= *sensor.highest - half))
        continue;
      result_.masked[i][k] = true;
      ++ended;
    }
    if (ended == 0) return;
    find(i, Severity::masked, "saturated",
         fmt::format("{} is at the end of the sensor's range in {} row{}", reading(), ended,
                     ended == 1 ? "" : "s"));
  }

  // What ends at the same value again and again is told once, and so is what is held again and again. A held
  // load is no reason to leave its run out: it may be the friction that the model lacks.
  void stand_still(std::size_t i, const std::vector<Still>& stills) {
    const auto value = [&](const Still& still) { return data_.runs[i].judged().values[still.begin]; };
    for (auto still = stills.begin(); still != stills.end(); ++still) {
      mask(i, *still);
      const bool held = still->why == Still::Why::stuck;
      const auto same = [&](const Still& one) {
        return one.why == still->why && (held || value(one) == value(*still));
      };
      if (std::find_if(stills.begin(), still, same) != still) continue;
      const auto times = std::count_if(still, stills.end(), same);
      const std::string when =
          fmt::format("{} from {:.3f} s to {:.3f} s", times > 1 ? fmt::format(" {} times, first", times) : "",
                      time_s(still->begin - 1), time_s(still->end - 1));
      if (held) {
        find(i, Severity::masked, "stuck",
             fmt::format(
                 "the {} stands still{} where the rig as described moves: {}something that held it, or "
                 "friction that the rig file lacks",
                 moving(), when, data_.pressure_is_given() ? "" : "a stuck valve, "));
        continue;
      }
      const std::string why = still->why == Still::Why::frozen ? "frozen" : "saturated";
      find(i, Severity::masked, why,
           fmt::format("{} is {} at {:.4g}{} though the {} should move", reading(), why, value(*still), when,
                       moving()));
    }
  }

  static bool same_inputs(const domain::Measurement& one, const domain::Measurement& other) {
    return std::ranges::equal(one.columns, other.columns, {}, &domain::MeasuredColumn::values,
                              &domain::MeasuredColumn::values);
  }

  // The same file twice says nothing new, and would stand on both sides of the split.
  void copies() {
    for (std::size_t i = 0; i < data_.runs.size(); ++i) {
      const auto same = [&](const domain::Run& run) {
        return run.judged().values == data_.runs[i].judged().values &&
               run.judged().missing == data_.runs[i].judged().missing &&
               run.current_mA == data_.runs[i].current_mA &&
               ((!bench_ && !pair_) || same_inputs(*run.measured, *data_.runs[i].measured));
      };
      const auto last = data_.runs.begin() + static_cast<std::ptrdiff_t>(i);
      const auto first = std::find_if(data_.runs.begin(), last, same);
      if (first != last && !result_.left_out[i])
        leave_out(i, fmt::format("equal to run {} in every reading: a copy", first->id));
    }
  }

  const domain::Dataset& data_;
  const std::string command_ = plant::command_key(data_.rig);
  const std::vector<Expected>& expected_;
  Examined& result_;
  bool bench_;         ///< lengths are given, and forces or pressures judged
  bool pair_, angle_;  ///< two muscles turn a joint; its angle is judged, or a lever's
  double count_;
};

}  // namespace

Examined examine(const domain::Dataset& data, const std::vector<Expected>& expected) {
  Examined result;
  for (const domain::Run& run : data.runs)
    result.masked.push_back(run.judged().missing.empty() ? std::vector<bool>(run.rows(), false)
                                                         : run.judged().missing);
  result.left_out.assign(data.runs.size(), false);
  check_columns(data, expected, result.findings);
  check_supply(data, expected, result.findings);
  if (!result.findings.empty()) return result;  // the wrong numbers would weigh wrong
  if (data.judged() == domain::Judged::contraction) check_loads(data, expected, result.findings);
  if (auto found = begins_moving(data, expected)) result.findings.push_back(std::move(*found));
  const auto refused = [](const Finding& one) { return one.severity == Severity::refused; };
  if (std::ranges::none_of(result.findings, refused)) Readings(data, expected, result)();
  return result;
}

std::string runs_that_would_help(const domain::Dataset& data) {
  const domain::Judged judged = data.judged();
  return std::string("at least four runs would help, with ") +
         (judged == domain::Judged::force      ? "each its own length"
          : judged == domain::Judged::pressure ? "other pressures, fast and slow"
          : data.rig.pair() != nullptr         ? "each with other trajectories of the two pressures"
                                               : "two loads and two kinds of current");
}

void require_enough(const domain::Dataset& data, const std::vector<bool>& left_out,
                    std::vector<Finding>& findings) {
  std::vector<double> loads_kg;
  for (std::size_t i = 0; i < data.runs.size(); ++i)
    if (!left_out[i]) loads_kg.push_back(data.runs[i].load_kg);
  const domain::Judged judged = data.judged();
  if (loads_kg.empty())
    findings.push_back({.message =
                            "no run is usable: mend what is said of each, name another file or column, "
                            "or measure again",
                        .severity = Severity::unusable});
  else if (loads_kg.size() < of_readings.least_runs && !has_parts(data))
    findings.push_back(
        {.message = fmt::format("{} usable run{}: too few to choose on some and test on others; {}.",
                                loads_kg.size(), loads_kg.size() == 1 ? "" : "s", runs_that_would_help(data)),
         .severity = Severity::undecidable});
  else if (judged == domain::Judged::contraction &&
           range(loads_kg) < of_readings.same_load * loads_kg.front())
    findings.push_back({.message = fmt::format("all runs have the same load, {:.6g} kg: effects that grow "
                                               "with the load cannot be separated from others",
                                               loads_kg.front()),
                        .severity = Severity::limited});
}

bool counts(const domain::Dataset& data, const domain::Run& run) {
  return run.measured ? run.measured->counted : data.rig.sensors.position().counts_pulses();
}

}  // namespace mckibben::data
