// Checks of measured data; see the header.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <sim/diagnose/amount.hpp>
#include <sim/diagnose/check.hpp>
#include <sim/diagnose/labels.hpp>
#include <sim/diagnose/odd_readings.hpp>
#include <sim/diagnose/other_units.hpp>
#include <sim/diagnose/repair.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/judged.hpp>
#include <sim/run/sanity.hpp>
#include <sim/run/sanity_thresholds.hpp>
#include <sim/run/series.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::diagnose {
namespace {

using run::Line;
using run::range;

constexpr const CheckThresholds& of_check = thresholds.check;

class DatasetChecker {
 public:
  DatasetChecker(const domain::Dataset& data, unsigned threads, Runs sound)
      : data_(data),
        threads_(threads),
        bench_(data.force_is_judged()),
        pair_(data.rig.pair() != nullptr),
        count_(run::reading_grain(data.rig)),
        model_(data.runs.size()) {
    checked_.sound = std::move(sound);
    for (const domain::Run& run : data.runs) {
      checked_.masked.emplace_back(run.judged().size(), false);
      if (!run.missing.empty()) checked_.masked.back() = run.missing;
    }
    left_out_.assign(data.runs.size(), false);
    run::for_each_job(
        data.runs.size(), threads,
        [&](std::size_t i) {
          const Hanging hanging{data.rig, data.runs[i].load_kg};
          model_[i] = std::move(predict(data.runs[i], {&hanging, 1}, data.rig.integrator.method).front());
        },
        [](std::size_t) {});
  }

  Checked operator()() {
    if (hangs()) insane();
    refuse_other_units(data_, model_, checked_.masked);
    for (std::size_t i = 0; i < data_.runs.size(); ++i) {
      for (const domain::Beside which : domain::gauges) gauge(i, which);
      if (bench_)
        pulls(i);
      else if (moves(i))
        readings(i);
    }
    copies();
    if (hangs()) labels();
    enough();
    for (std::size_t i = 0; i < left_out_.size(); ++i)
      if (left_out_[i]) checked_.left_out.push_back(i);
    return std::move(checked_);
  }

 private:
  /// A load, so that its label and its height can be looked at.
  bool hangs() const { return !bench_ && !pair_; }
  /// The judged reading's column, and what shows it.
  const char* reading() const { return pair_ ? "angle_rad" : "contraction_ratio"; }
  const char* moving() const { return pair_ ? "joint" : "load"; }
  void warn(std::size_t run, std::string_view what) {
    checked_.warnings.push_back(fmt::format("run {}: {}", data_.runs[run].id, what));
  }
  void find(std::size_t run, std::string kind, std::string action, std::string words) {
    checked_.faulty.push_back({.run = data_.runs[run].id,
                               .kind = std::move(kind),
                               .action = std::move(action),
                               .words = std::move(words)});
  }
  void leave_out(std::size_t run, std::string_view why) {
    warn(run, fmt::format("{}; left out", why));
    find(run, "reading", "left out", fmt::format("was left out: {}", why));
    left_out_[run] = true;
  }
  void leave_out_for(const Fault& fault) {
    FaultyRun faulty = told(data_, fault);
    warn(fault.run, faulty.words + "; left out");
    faulty.words += " (left out)";
    checked_.faulty.push_back(std::move(faulty));
    left_out_[fault.run] = true;
  }
  std::string amount(double value) const { return amount_of(data_.judged(), value, data_.rig, 3); }
  double time_s(std::size_t row) const {
    return data_.rows_begin_s() + static_cast<double>(row) * data_.row_s();
  }
  Runs usable() const {
    Runs runs;
    for (std::size_t i = 0; i < left_out_.size(); ++i)
      if (!left_out_[i]) runs.push_back(i);
    return runs;
  }

  static bool too_many(std::size_t contradicted, std::size_t runs) {
    return static_cast<double>(contradicted) > of_check.most_contradicted * static_cast<double>(runs);
  }

  // Columns and loads that are not what they are called end it; labels that were exchanged cost their runs.
  void insane() {
    std::vector<run::Expected> expected;
    for (const Readings& readings : model_) expected.push_back({readings.judged, readings.pressure_Pa});
    const auto objections = run::sanity(data_, expected);
    run::raise(data_, objections);
    for (const domain::Objection& objection : objections) {
      const std::string text = domain::text_of(data_, objection);
      // More runs are weighed one against the others later, exactly.
      if (objection.exchanged.empty() && data_.runs.size() >= thresholds.label.least_runs) continue;
      for (const std::size_t i : objection.runs) left_out_[i] = true;
      for (const domain::SeemingLoad& one : objection.exchanged)
        find(one.run, "load", "left out",
             fmt::format("was left out: it has the label of another load and moves like {:.6g} kg",
                         one.load_kg));
      if (too_many(objection.runs.size(), data_.runs.size()) || usable().size() < of_check.least_runs)
        checked_.cannot_tell = text + ".";
      else
        checked_.warnings.push_back(text + "; left out");
    }
  }

  void gauge(std::size_t i, domain::Beside which) {
    const auto* const shown = data_.runs[i].beside(which);
    if (shown == nullptr) return;
    const auto& model = model_[i].beside(which);
    const char* const name = !pair_                                     ? "muscle_pressure_bar"
                             : which == domain::Beside::muscle_pressure ? "muscle_pressure_1_bar"
                                                                        : "muscle_pressure_2_bar";
    const bool constant = range(*shown) == 0.0;
    const bool should_move = range(model) > of_check.gauge_bar * plant::Pa_per_bar;
    if (!constant && (!should_move || Line(*shown, model).slope > of_check.gauge_slope)) {
      mask_spikes(i, name, *shown, model, of_check.gauge_step_Pa);
      return;
    }
    (which == domain::Beside::muscle_pressure ? checked_.dead_gauges : checked_.dead_opposite_gauges)
        .push_back(i);
    warn(i, fmt::format("{} {}: the gauge is ignored", name,
                        constant ? fmt::format("is {:.4g} throughout", shown->front() / plant::Pa_per_bar)
                                 : "does not follow the current"));
  }

  void mask(std::size_t run, const Stretch& stretch) {
    std::fill(checked_.masked[run].begin() + static_cast<std::ptrdiff_t>(stretch.begin),
              checked_.masked[run].begin() + static_cast<std::ptrdiff_t>(stretch.end), true);
  }

  void mask_spikes(std::size_t i, std::string_view column, const Series& values, const Series& model,
                   double step) {
    const auto outliers = spikes(values, sharpest_nearby(model, data_.row_s()), step);
    if (outliers.empty()) return;
    std::string times;
    for (std::size_t n = 0; n < outliers.size(); ++n) {
      mask(i, outliers[n]);
      if (n < 3) times += fmt::format("{}{:.3f} s", n > 0 ? ", " : "", time_s(outliers[n].begin));
    }
    warn(i,
         fmt::format("{} outlier{} in {}, at {}{}; not used", outliers.size(), outliers.size() > 1 ? "s" : "",
                     column, times, outliers.size() > 3 ? " and later" : ""));
  }

  void pulls(std::size_t i) {
    const std::vector<bool>& masked = checked_.masked[i];
    if (std::find(masked.begin(), masked.end(), false) == masked.end())
      leave_out(i, "the cord hangs through all the time: no force was read");
  }

  bool moves(std::size_t i) {
    const domain::Run& run = data_.runs[i];
    const double largest_mA = run.current_mA.empty() || pair_ ? std::numeric_limits<double>::infinity()
                                                              : *std::ranges::max_element(run.current_mA);
    const double dead_mA =
        data_.rig.valve.zero_current_mA +
        of_check.dead_current * (data_.rig.valve.span_current_mA - data_.rig.valve.zero_current_mA);
    const double should = range(model_[i].judged);
    if (largest_mA <= dead_mA)
      leave_out(i, fmt::format("the current stays at or below {:.4g} mA and moves nothing", largest_mA));
    else if (range(run.judged()) > of_check.moving_counts * count_)
      return true;
    else if (should > of_check.should_move_counts * count_)
      leave_out(i, fmt::format("the reading never changes, though the {0} should move by {1} (is the "
                               "{2} connected, the {0} held?)",
                               moving(), amount(should), pair_ ? "sensor" : "encoder"));
    else
      leave_out(i, "nothing moves");
    return false;
  }

  void readings(std::size_t i) {
    const Series& values = data_.runs[i].judged();
    const Series& model = model_[i].judged;
    std::vector<bool>& masked = checked_.masked[i];
    const Series sharpest = sharpest_nearby(model, data_.row_s());
    range_ends(i);
    mask_spikes(i, reading(), values, model, count_);
    stand_still(i, stills(values, model, count_, data_.row_s()));
    if (left_out_[i]) return;
    const auto lost = std::count(masked.begin(), masked.end(), true);
    if (const auto row = lost_counts(values, sharpest, masked, count_))
      leave_out(i, lost_in_words(i, values[*row] - values[*row - 1], time_s(*row)));
    else if (static_cast<double>(lost) > of_check.most_masked * static_cast<double>(masked.size()))
      leave_out(i, "too little of it is left");
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
    const Series& values = data_.runs[i].judged();
    const double step = run::reading_per_count(data_.rig);
    std::size_t ended = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double own = values[k] / step * sensor.resolution, half = 0.5 * sensor.resolution;
      if (!(sensor.lowest && own <= *sensor.lowest + half) &&
          !(sensor.highest && own >= *sensor.highest - half))
        continue;
      checked_.masked[i][k] = true;
      ++ended;
    }
    if (ended == 0) return;
    const auto what = fmt::format("{} is at the end of the sensor's range in {} row{}; not used", reading(),
                                  ended, ended == 1 ? "" : "s");
    warn(i, what);
    find(i, "saturated", "masked", what);
  }

  // What ends at the same value again and again is told once.
  void stand_still(std::size_t i, const std::vector<Still>& stills) {
    const auto value = [&](const Still& still) { return data_.runs[i].judged()[still.begin]; };
    for (auto still = stills.begin(); still != stills.end(); ++still) {
      if (still->why == Still::Why::stuck) {
        stuck(i, *still);
        continue;
      }
      mask(i, *still);
      const auto same = [&](const Still& one) {
        return one.why == still->why && value(one) == value(*still);
      };
      if (std::find_if(stills.begin(), still, same) != still) continue;
      const auto times = std::count_if(still, stills.end(), same);
      const std::string why = still->why == Still::Why::frozen ? "frozen" : "saturated";
      const auto what =
          fmt::format("{} is {} at {:.4g}{} from {:.3f} s to {:.3f} s though the {} should move; not used",
                      reading(), why, value(*still), times > 1 ? fmt::format(" {} times, first", times) : "",
                      time_s(still->begin - 1), time_s(still->end - 1), moving());
      warn(i, what);
      find(i, why, "masked", what);
    }
  }

  void stuck(std::size_t i, const Still& still) {
    if (left_out_[i]) return;
    leave_out(i, fmt::format("the {0} stands still from {1:.3f} s to {2:.3f} s though the {3} should "
                             "move it: {4}something held the {0}",
                             moving(), time_s(still.begin - 1), time_s(still.end - 1),
                             data_.pressure_is_given() ? "pressure" : "current",
                             data_.pressure_is_given() ? "" : "the valve was stuck, or "));
  }

  static bool same_inputs(const domain::Measurement& one, const domain::Measurement& other) {
    return std::ranges::equal(one.sides, other.sides, [](const auto& a, const auto& b) {
      return a.current_mA == b.current_mA && a.muscle_pressure_Pa == b.muscle_pressure_Pa;
    });
  }

  // The same file twice says nothing new, and would stand on both sides of the split.
  void copies() {
    for (std::size_t i = 0; i < data_.runs.size(); ++i) {
      const auto same = [&](const domain::Run& run) {
        return run.judged() == data_.runs[i].judged() && run.current_mA == data_.runs[i].current_mA &&
               (!bench_ || run.measured->contraction_ratio == data_.runs[i].measured->contraction_ratio) &&
               (!pair_ || same_inputs(*run.measured, *data_.runs[i].measured));
      };
      const auto last = data_.runs.begin() + static_cast<std::ptrdiff_t>(i);
      const auto first = std::find_if(data_.runs.begin(), last, same);
      if (first != last && !left_out_[i])
        leave_out(i, fmt::format("equal to run {} in every reading: a copy", first->id));
    }
  }

  void labels() {
    if (checked_.cannot_tell) return;
    const Runs runs = usable();
    if (runs.size() >= of_check.least_runs && runs.size() < thresholds.label.least_runs)
      checked_.warnings.push_back(fmt::format(
          "{} usable runs: their loads are in order, but too few to weigh each against the others",
          runs.size()));
    const auto [wrong, common_ratio] = check_labels(data_, checked_.masked, runs, threads_);
    if (std::abs(common_ratio / run::pound_kg - 1.0) < thresholds.label.pounds) {
      throw domain::UnfitData(
          data_,
          fmt::format("load: all runs fit best at {:.2f} times their loads; these look like pounds, not kg",
                      common_ratio));
    }
    for (const WrongLabel& label : wrong) {
      if (checked_.is_sound(label.run)) continue;
      checked_.contradicted.push_back(label.run);
      if (label.other)
        leave_out_for(*label.other);
      else
        leave_out(label.run,
                  fmt::format("the load is labelled {:.6g} kg, but everything else says about {:.1f} kg",
                              data_.runs[label.run].load_kg, label.load_kg));
    }
    if (too_many(wrong.size(), runs.size()))
      checked_.cannot_tell =
          "too many runs contradict the others about their load: weigh the loads again, or give the rig's "
          "parameters more exactly.";
  }

  void enough() {
    if (checked_.cannot_tell) return;
    const Runs runs = usable();
    if (runs.size() < of_check.least_runs) {
      checked_.cannot_tell = fmt::format(
          "{} usable run{}: too few to choose on some and judge on others; at least four runs would help, "
          "with {}.",
          runs.size(), runs.size() == 1 ? "" : "s",
          bench_  ? "each its own length"
          : pair_ ? "each another course of the two pressures"
                  : "two loads and two kinds of current");
      return;
    }
    const double first_kg = data_.runs[runs.front()].load_kg;
    if (hangs() && std::all_of(runs.begin(), runs.end(), [&](std::size_t i) {
          return std::abs(data_.runs[i].load_kg - first_kg) < of_check.same_load * first_kg;
        }))
      checked_.warnings.push_back(
          fmt::format("all runs have the same load, {:.6g} kg: what grows with the load cannot be told from "
                      "what does not",
                      first_kg));
  }

  const domain::Dataset& data_;
  unsigned threads_;
  bool bench_;  ///< lengths are given, and forces judged
  bool pair_;   ///< two muscles turn a joint, and its angle is judged
  double count_;
  std::vector<Readings> model_;
  std::vector<bool> left_out_;
  Checked checked_;
};

}  // namespace

Checked check(const domain::Dataset& data, unsigned threads, Runs sound) {
  return DatasetChecker(data, threads, std::move(sound))();
}

}  // namespace mckibben::diagnose
