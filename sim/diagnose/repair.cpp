// See the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/data/series.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/diagnose/repair.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::diagnose {
namespace {

/// Ticks of a rig that has any; else a time.
std::string ticks(const domain::Dataset& data, double number) {
  if (data.own_clock) return fmt::format("{:.3g} ms", 1e3 * std::abs(number) * data.row_s());
  const double whole = std::abs(std::round(number));
  return fmt::format("{:.0f} tick{}", whole, whole == 1.0 ? "" : "s");
}

/// Counts of an encoder; of another sensor the load's way.
std::string moved(const domain::Dataset& data, const domain::Run& run, double ratio) {
  if (data::counts(data, run))
    return fmt::format("{:.1f} counts", ratio / run::contraction_per_count(data.rig));
  return fmt::format("{:.2g} mm", 1e3 * data.rig.muscle.rest_length_m * ratio);
}

/// What drives the muscle, as the data set has it.
struct Input {
  std::string kind, of, unit;
};
Input input_of(const domain::Dataset& data) {
  if (data.pressure_is_given()) return {"pressure", "the muscle", "bar"};
  return {plant::command_key(data.rig), "the valve", std::string(name_of(data.rig.command_unit()))};
}

std::vector<double> shifted(const std::vector<double>& values, int late) {
  const auto last = static_cast<int>(values.size()) - 1;
  std::vector<double> moved(values.size());
  for (int k = 0; k <= last; ++k)
    moved[static_cast<std::size_t>(k)] = values[static_cast<std::size_t>(std::clamp(k + late, 0, last))];
  return moved;
}

/// What was read beside is shifted with the readings where it then goes with the model: a recorder may be
/// late, or the one sensor.
void shift(const Rig& rig, domain::Run& run, std::vector<bool>& masked, int late) {
  const bool beside = run.muscle_pressure_Pa || !run.force_N.empty();
  run.contraction_ratio = shifted(run.contraction_ratio, late);
  const std::vector<bool> was = masked;
  const auto rows = static_cast<int>(was.size());
  for (int k = 0; k < rows; ++k) {
    const int from = k + late;
    masked[static_cast<std::size_t>(k)] = from < 0 || from >= rows || was[static_cast<std::size_t>(from)];
  }
  if (!beside) return;
  const Loaded hanging{rig, run.load_kg};
  const Readings model = predict(run, {&hanging, 1}, rig.integrator.method).front();
  const auto move = [&](std::vector<double>& read, const std::vector<double>& expected) {
    std::vector<double> moved = shifted(read, late);
    if (data::Line(moved, expected).correlation > data::Line(read, expected).correlation)
      read = std::move(moved);
  };
  if (run.muscle_pressure_Pa) move(*run.muscle_pressure_Pa, model.pressure_Pa);
  if (!run.force_N.empty()) move(run.force_N, model.force_N);
}

/// Readings that are counted stay so: by whole counts.
void take_out(domain::Run& run, bool counted, double count, double at_begin, double at_end) {
  const auto rows = run.contraction_ratio.size();
  for (std::size_t k = 0; k < rows; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(rows, 2) - 1);
    const double off = std::lerp(at_begin, at_end, share);
    run.contraction_ratio[k] -= counted ? count * std::round(off / count) : off;
  }
}

}  // namespace

FaultyRun told(const domain::Dataset& data, const Fault& fault) {
  const domain::Run& run = data.runs[fault.run];
  const Input input = input_of(data);
  const double length_mm = 1e3 * data.rig.muscle.rest_length_m;
  const double at_s = data.rows_begin_s() + static_cast<double>(fault.row) * data.row_s();
  FaultyRun faulty{.run = run.id,
                   .kind = "",
                   .size = fault.size,
                   .action = "left out",
                   .words = "",
                   .common = fault.common};
  const auto tell = [&](std::string kind, std::string unit, std::string words) {
    faulty.kind = std::move(kind);
    faulty.unit = std::move(unit);
    faulty.words = std::move(words);
  };
  switch (fault.kind) {
    case FaultKind::late:
      faulty.size = data.own_clock ? fault.size * data.row_s() : std::round(fault.size);
      tell("late", data.own_clock ? "s" : "tick",
           fmt::format("is {} {}", ticks(data, fault.size), fault.size > 0.0 ? "late" : "early"));
      break;
    case FaultKind::current_scale:
      tell(input.kind + "_scale", "1",
           fmt::format("has a {} that is {:.3f} times what {} had", input.kind, 1.0 + fault.size, input.of));
      break;
    case FaultKind::current_offset:
      tell(input.kind + "_offset", input.unit,
           fmt::format("has a {} that is {:.2f} {} {} than what {} had", input.kind, std::abs(faulty.size),
                       input.unit, faulty.size > 0.0 ? "more" : "less", input.of));
      break;
    case FaultKind::drift:
      faulty.size *= 1e-3 * length_mm;
      tell("drift", "m",
           fmt::format("drifts by {:.2g} mm from its beginning to its end", length_mm * fault.size));
      break;
    case FaultKind::zero:
      tell("zero", "1", fmt::format("has its zero moved by {}", moved(data, run, fault.size)));
      break;
    case FaultKind::slipped:
      tell("slipped", "1",
           fmt::format("slipped by {} at about {:.1f} s", moved(data, run, fault.size), at_s));
      break;
    case FaultKind::reading_scale:
      tell("reading_scale", "1",
           fmt::format("has readings on another scale, {:.3f} times", 1.0 + fault.size));
      break;
    case FaultKind::rows_lost:
      tell("rows_lost", "tick",
           fmt::format("{} about {} of readings at about {:.1f} s (rows are missing or double)",
                       fault.size > 0.0 ? "lost" : "repeats", ticks(data, fault.size), at_s));
      break;
    case FaultKind::another_rig:
      tell("another_rig", "",
           "fits no model that the other runs fit (another rig, another load, something held it?)");
      break;
  }
  return faulty;
}

void mend(domain::Dataset& data, Checked& checked, const std::vector<Fault>& faults) {
  const double count = run::contraction_per_count(data.rig);
  for (const Fault& fault : faults) {
    FaultyRun faulty = told(data, fault);
    domain::Run& run = data.runs[fault.run];
    const int rows = static_cast<int>(std::round(fault.size));  // 0 if it is late by part of one
    const bool late = fault.kind == FaultKind::late && rows != 0, zero = fault.kind == FaultKind::zero;
    const bool common_drift = fault.kind == FaultKind::drift && fault.common;
    if (late) shift(data.rig, run, checked.masked[fault.run], rows);
    if (zero) take_out(run, data::counts(data, run), count, fault.size, fault.size);
    if (common_drift) take_out(run, data::counts(data, run), count, 0.0, fault.size);
    if (late || zero || common_drift) {
      faulty.action = "corrected";
      faulty.words += late ? " and was shifted" : " (corrected)";
    } else {
      faulty.words += " (left out)";
      checked.left_out.push_back(fault.run);
    }
    checked.faulty.push_back(std::move(faulty));
  }
  std::sort(checked.left_out.begin(), checked.left_out.end());
}

}  // namespace mckibben::diagnose
