// Checks of measured data; see the header. Thresholds are in counts of the encoder.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/diagnose/checks.hpp>
#include <sim/diagnose/labels.hpp>
#include <sim/diagnose/repair.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/sanity.hpp>
#include <sim/run/series.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::diagnose {
namespace {

using run::Line;
using run::range;
using Series = std::vector<double>;

/// To choose on some and judge on others.
constexpr std::size_t least_runs = 3;
/// What gauges cannot resolve anyway.
constexpr double gauge_step_Pa = 2e3;

/// Rows from `begin` to before `end`.
struct Stretch {
  std::size_t begin, end;
};

/// By how much the model's movement changes from one tick to the next at most, within 0.3 s of each row: what
/// a load can do there, also if a hidden effect makes it come early or late.
Series sharpest_nearby(const Series& model, double tick_s) {
  const auto reach = static_cast<std::size_t>(std::lround(0.3 / tick_s));
  Series sharpest(model.size(), 0.0);
  for (std::size_t k = 1; k + 1 < model.size(); ++k) {
    const double bend = std::abs(model[k + 1] - 2.0 * model[k] + model[k - 1]);
    const std::size_t last = std::min(model.size() - 1, k + reach);
    for (std::size_t near = k > reach ? k - reach : 0; near <= last; ++near)
      sharpest[near] = std::max(sharpest[near], bend);
  }
  return sharpest;
}

/// Readings that leave the line through their neighbours with a jump and come back to it with another, within
/// five ticks. At the ends of a run it must stand still: there one jump is all that is seen.
std::vector<Stretch> spikes(Series values, const Series& sharpest, double count) {
  constexpr std::size_t widest = 5;
  std::vector<Stretch> found;
  const std::size_t rows = values.size();
  for (std::size_t begin = 0; begin < rows && rows > 3; ++begin) {
    for (std::size_t end = begin + 1; end <= std::min(rows, begin + widest); ++end) {
      const bool first = begin == 0, last = end == rows;
      if ((first || last) && end - begin > 1) break;
      // Beyond the ends of the run the movement is taken to go on.
      const double before = first ? 3.0 * values[1] - 2.0 * values[2] : values[begin - 1];
      const double after = last ? 3.0 * values[rows - 2] - 2.0 * values[rows - 3] : values[end];
      const auto width = static_cast<double>(end - begin);
      const double limit = 5.0 * count + sharpest[begin] * (width + 1.0);
      const double slope = (after - before) / (width + 1.0);
      const double there = values[begin] - before - slope, back = after - values[end - 1] - slope;
      const double least = std::min(std::abs(there), std::abs(back));
      if ((first || last) && std::abs(slope) > 2.0 * count) continue;
      if (least < limit || there * back >= 0.0 || std::abs(there + back) > 0.5 * least) continue;
      const bool inside = begin > 1 && end + 1 < rows;
      const double alike = 3.0 * count + 2.0 * sharpest[begin];
      if (inside && (std::abs(values[begin - 1] - values[begin - 2] - slope) > alike ||
                     std::abs(values[end + 1] - values[end] - slope) > alike))
        continue;
      found.push_back({begin, end});
      for (std::size_t k = begin; k < end; ++k)  // must not make its neighbours look wrong
        values[k] = before + slope * static_cast<double>(k - begin + 1);
      break;
    }
  }
  return found;
}

/// A row at which the reading jumps and stays: the load moves before and after as if nothing had happened.
std::optional<std::size_t> lost_counts(const Series& values, const Series& sharpest,
                                       const std::vector<bool>& masked, double count) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < values.size(); ++k) steps.push_back(std::abs(values[k] - values[k - 1]));
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double noise = 8.0 * *middle;
  for (std::size_t k = 2; k + 1 < values.size(); ++k) {
    if (masked[k - 2] || masked[k - 1] || masked[k] || masked[k + 1]) continue;
    const double before = values[k - 1] - values[k - 2], after = values[k + 1] - values[k];
    const double jump = std::abs(values[k] - values[k - 1] - 0.5 * (before + after));
    if (jump > noise + 20.0 * count + 4.0 * sharpest[k] && std::abs(after - before) < 0.25 * jump) return k;
  }
  return std::nullopt;
}

/// Where a reading stands still.
struct Still : Stretch {
  enum class Why { frozen, saturated, stuck } why;
};

/// Where the reading stays the same to the last bit although the model moves far. Friction may hold a load
/// that the model moves, and so may the braid stop: the reading must also stop as no friction could stop it,
/// or catch up with a jump, or miss a great deal. A load that comes to rest by itself is held by a valve that
/// is stuck; readings cut off on their way up and down, at the highest of the run, by the end of their range.
std::vector<Still> stills(const Series& values, const Series& model, double count, double tick_s) {
  const auto shortest = static_cast<std::size_t>(std::lround(0.5 / tick_s));
  constexpr std::size_t nearby = 5;
  const double highest = *std::max_element(values.begin(), values.end());
  std::vector<Still> found;
  for (std::size_t begin = 0, end; begin < values.size(); begin = end) {
    end = begin + 1;
    while (end < values.size() && values[end] == values[begin]) ++end;
    if (end - begin < shortest) continue;
    // Resting on the stop is no fault, and what leaves it is quick, but not as quick as that.
    const bool catches_up = end < values.size() && std::abs(values[end] - values[begin]) > 60.0 * count;
    if (values[begin] < 3.0 * count && !catches_up) continue;
    const double missed = range({model.data() + begin, end - begin});
    const bool inside = begin >= nearby && end + nearby <= values.size();
    const auto moves = [&](std::size_t from, std::size_t to) {
      return std::abs(values[from] - values[to]) > static_cast<double>(nearby) * count;
    };
    const bool cut_off = values[begin] == highest && inside && moves(begin - nearby, begin) &&
                         moves(end - 1, end + nearby - 1);
    const bool stops_dead = begin > 0 && std::abs(values[begin] - values[begin - 1]) > 10.0 * count;
    const bool jumps = end < values.size() && std::abs(values[end] - values[begin]) > 6.0 * count;
    if (cut_off && !jumps && missed > 80.0 * count)
      found.push_back({{begin + 1, end}, Still::Why::saturated});
    else if (missed > 100.0 * count && (stops_dead || jumps))
      found.push_back({{begin + 1, end}, Still::Why::frozen});
    else if (missed > 200.0 * count)
      found.push_back({{begin + 1, end}, Still::Why::stuck});
  }
  return found;
}

class Checker {
 public:
  Checker(const domain::Dataset& data, unsigned threads)
      : data_(data),
        threads_(threads),
        count_(run::contraction_per_count(data.rig)),
        model_(data.runs.size()) {
    for (const domain::Run& run : data.runs) doubts_.masked.emplace_back(run.current_mA.size(), false);
    left_out_.assign(data.runs.size(), false);
    run::for_each_job(
        data.runs.size(), threads,
        [&](std::size_t i) {
          const Hanging hanging{data.rig, data.runs[i].load_kg};
          model_[i] = std::move(predict(data.runs[i], {&hanging, 1}, data.rig.integrator.method).front());
        },
        [](std::size_t) {});
  }

  Doubts operator()() {
    insane();
    for (std::size_t i = 0; i < data_.runs.size(); ++i) {
      gauge(i);
      if (moves(i)) readings(i);
    }
    copies();
    labels();
    enough();
    for (std::size_t i = 0; i < left_out_.size(); ++i)
      if (left_out_[i]) doubts_.left_out.push_back(i);
    return std::move(doubts_);
  }

 private:
  void warn(std::size_t run, std::string_view what) {
    doubts_.warnings.push_back(fmt::format("run {}: {}", data_.runs[run].id, what));
  }
  void find(std::size_t run, std::string kind, std::string action, std::string words) {
    doubts_.findings.push_back({.run = data_.runs[run].id,
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
    Finding finding = told(data_, fault);
    warn(fault.run, finding.words + "; left out");
    finding.words += " (left out)";
    doubts_.findings.push_back(std::move(finding));
    left_out_[fault.run] = true;
  }
  double time_s(std::size_t row) const { return static_cast<double>(row) * data_.rig.tick_s; }
  Runs usable() const {
    Runs runs;
    for (std::size_t i = 0; i < left_out_.size(); ++i)
      if (!left_out_[i]) runs.push_back(i);
    return runs;
  }

  // Columns and loads that are not what they are called end it; labels that were exchanged cost their runs.
  void insane() {
    std::vector<run::Expected> expected;
    for (const Readings& readings : model_)
      expected.push_back({readings.contraction_ratio, readings.pressure_Pa});
    const auto findings = run::sanity(data_, expected);
    run::raise(data_, findings);
    for (const domain::Objection& finding : findings) {
      const std::string text = domain::text_of(data_, finding);
      // More runs are weighed one against the others later, exactly.
      if (finding.exchanged.empty() && data_.runs.size() >= least_labels) continue;
      for (const std::size_t i : finding.runs) left_out_[i] = true;
      for (const domain::SeemingLoad& one : finding.exchanged)
        find(one.run, "load", "left out",
             fmt::format("was left out: it has the label of another load and moves like {:.6g} kg",
                         one.load_kg));
      if (3 * finding.runs.size() > data_.runs.size() || usable().size() < least_runs)
        doubts_.cannot_tell = text + ".";
      else
        doubts_.warnings.push_back(text + "; left out");
    }
  }

  void gauge(std::size_t i) {
    const auto& shown = data_.runs[i].muscle_pressure_Pa;
    if (!shown) return;
    const bool constant = range(*shown) == 0.0;
    const bool should_move = range(model_[i].pressure_Pa) > 0.3 * plant::Pa_per_bar;
    if (!constant && (!should_move || Line(*shown, model_[i].pressure_Pa).slope > 0.1)) {
      mask_spikes(i, "muscle_pressure_bar", *shown, model_[i].pressure_Pa, gauge_step_Pa);
      return;
    }
    doubts_.dead_gauges.push_back(i);
    warn(i, fmt::format("muscle_pressure_bar {}: the gauge is ignored",
                        constant ? fmt::format("is {:.4g} throughout", shown->front() / plant::Pa_per_bar)
                                 : "does not follow the current"));
  }

  void mask(std::size_t run, const Stretch& stretch) {
    std::fill(doubts_.masked[run].begin() + static_cast<std::ptrdiff_t>(stretch.begin),
              doubts_.masked[run].begin() + static_cast<std::ptrdiff_t>(stretch.end), true);
  }

  void mask_spikes(std::size_t i, std::string_view column, const Series& values, const Series& model,
                   double step) {
    const auto outliers = spikes(values, sharpest_nearby(model, data_.rig.tick_s), step);
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

  bool moves(std::size_t i) {
    const domain::Run& run = data_.runs[i];
    const double largest_mA = *std::max_element(run.current_mA.begin(), run.current_mA.end());
    const double dead_mA = data_.rig.valve.zero_current_mA +
                           1e-3 * (data_.rig.valve.span_current_mA - data_.rig.valve.zero_current_mA);
    const double should_m = range(model_[i].contraction_ratio) * data_.rig.muscle.rest_length_m;
    if (largest_mA <= dead_mA)
      leave_out(i, fmt::format("the current stays at or below {:.4g} mA and moves nothing", largest_mA));
    else if (range(run.contraction_ratio) > 1.5 * count_)
      return true;
    else if (range(model_[i].contraction_ratio) > 20.0 * count_)
      leave_out(i, fmt::format("the reading never changes, though the load should move by {:.3g} mm (is the "
                               "encoder connected, the load held?)",
                               1e3 * should_m));
    else
      leave_out(i, "nothing moves");
    return false;
  }

  void readings(std::size_t i) {
    const Series& values = data_.runs[i].contraction_ratio;
    const Series& model = model_[i].contraction_ratio;
    std::vector<bool>& masked = doubts_.masked[i];
    const Series sharpest = sharpest_nearby(model, data_.rig.tick_s);
    mask_spikes(i, "contraction_ratio", values, model, count_);
    for (const Still& still : stills(values, model, count_, data_.rig.tick_s)) stands_still(i, still);
    if (left_out_[i]) return;
    const auto lost = std::count(masked.begin(), masked.end(), true);
    if (const auto row = lost_counts(values, sharpest, masked, count_))
      leave_out(i,
                fmt::format("contraction_ratio jumps by {:.3g} at {:.3f} s and stays there: counts were lost",
                            values[*row] - values[*row - 1], time_s(*row)));
    else if (static_cast<double>(lost) > 0.3 * static_cast<double>(masked.size()))
      leave_out(i, "too little of it is left");
  }

  void stands_still(std::size_t i, const Still& still) {
    const double from_s = time_s(still.begin - 1), to_s = time_s(still.end - 1);
    if (still.why == Still::Why::stuck) {
      if (!left_out_[i])
        leave_out(i, fmt::format("the load stands still from {:.3f} s to {:.3f} s though the current should "
                                 "move it: the valve was stuck, or something held the load",
                                 from_s, to_s));
      return;
    }
    mask(i, still);
    const auto what =
        fmt::format("contraction_ratio is {} from {:.3f} s to {:.3f} s though the load should move; not used",
                    still.why == Still::Why::frozen ? "frozen" : "saturated", from_s, to_s);
    warn(i, what);
    find(i, still.why == Still::Why::frozen ? "frozen" : "saturated", "masked", what);
  }

  // The same file twice says nothing new, and would stand on both sides of the split.
  void copies() {
    for (std::size_t i = 0; i < data_.runs.size(); ++i) {
      const auto same = [&](const domain::Run& run) {
        return run.contraction_ratio == data_.runs[i].contraction_ratio &&
               run.current_mA == data_.runs[i].current_mA;
      };
      const auto last = data_.runs.begin() + static_cast<std::ptrdiff_t>(i);
      const auto first = std::find_if(data_.runs.begin(), last, same);
      if (first != last && !left_out_[i])
        leave_out(i, fmt::format("equal to run {} in every reading: a copy", first->id));
    }
  }

  void labels() {
    if (doubts_.cannot_tell) return;
    const Runs runs = usable();
    if (runs.size() >= least_runs && runs.size() < least_labels)
      doubts_.warnings.push_back(fmt::format(
          "{} usable runs: their loads are in order, but too few to weigh each against the others",
          runs.size()));
    const auto [wrong, common_ratio] = check_labels(data_, doubts_.masked, runs, threads_);
    constexpr double pound_kg = 0.45359237;
    if (std::abs(common_ratio / pound_kg - 1.0) < 0.06) {
      throw domain::UnfitData(
          data_,
          fmt::format("load: all runs fit best at {:.2f} times their loads; these look like pounds, not kg",
                      common_ratio));
    }
    for (const WrongLabel& label : wrong) {
      if (label.other)
        leave_out_for(*label.other);
      else
        leave_out(label.run,
                  fmt::format("the load is labelled {:.6g} kg, but everything else says about {:.1f} kg",
                              data_.runs[label.run].load_kg, label.load_kg));
    }
    if (3 * wrong.size() > runs.size())
      doubts_.cannot_tell =
          "too many runs contradict the others about their load: weigh the loads again, or give the rig's "
          "parameters more exactly.";
  }

  void enough() {
    if (doubts_.cannot_tell) return;
    const Runs runs = usable();
    if (runs.size() < least_runs) {
      doubts_.cannot_tell = fmt::format(
          "{} usable run{}: too few to choose on some and judge on others; at least four runs would help, "
          "with two loads and two kinds of current.",
          runs.size(), runs.size() == 1 ? "" : "s");
      return;
    }
    const double first_kg = data_.runs[runs.front()].load_kg;
    if (std::all_of(runs.begin(), runs.end(), [&](std::size_t i) {
          return std::abs(data_.runs[i].load_kg - first_kg) < 0.01 * first_kg;
        }))
      doubts_.warnings.push_back(
          fmt::format("all runs have the same load, {:.6g} kg: what grows with the load cannot be told from "
                      "what does not",
                      first_kg));
  }

  const domain::Dataset& data_;
  unsigned threads_;
  double count_;
  std::vector<Readings> model_;
  std::vector<bool> left_out_;
  Doubts doubts_;
};

}  // namespace

Doubts check(const domain::Dataset& data, unsigned threads) {
  return Checker(data, threads)();
}

}  // namespace mckibben::diagnose
