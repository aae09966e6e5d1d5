// See the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/diagnose/repair.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::diagnose {
namespace {

std::string ticks(double number) {
  const double whole = std::abs(std::round(number));
  return fmt::format("{:.0f} tick{}", whole, whole == 1.0 ? "" : "s");
}

void shift(domain::Run& run, std::vector<bool>& masked, int late) {
  const auto rows = static_cast<int>(run.contraction_ratio.size());
  const auto move = [&](std::vector<double>& values) {
    const std::vector<double> was = values;
    for (int k = 0; k < rows; ++k) {
      const int from = std::clamp(k + late, 0, rows - 1);
      values[static_cast<std::size_t>(k)] = was[static_cast<std::size_t>(from)];
    }
  };
  move(run.contraction_ratio);
  if (run.muscle_pressure_Pa) move(*run.muscle_pressure_Pa);
  if (!run.force_N.empty()) move(run.force_N);
  const std::vector<bool> was = masked;
  for (int k = 0; k < rows; ++k) {
    const int from = k + late;
    masked[static_cast<std::size_t>(k)] = from < 0 || from >= rows || was[static_cast<std::size_t>(from)];
  }
}

/// By whole counts: readings that are counted stay so.
void take_out(domain::Run& run, double count, double at_begin, double at_end) {
  const auto rows = run.contraction_ratio.size();
  for (std::size_t k = 0; k < rows; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(rows, 2) - 1);
    run.contraction_ratio[k] -= count * std::round(std::lerp(at_begin, at_end, share) / count);
  }
}

}  // namespace

FaultyRun told(const domain::Dataset& data, const Fault& fault) {
  const domain::Run& run = data.runs[fault.run];
  const double count = run::contraction_per_count(data.rig);
  const double length_mm = 1e3 * data.rig.muscle.rest_length_m;
  const double at_s = static_cast<double>(fault.row) * data.row_s();
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
      faulty.size = std::round(fault.size);
      tell("late", "tick", fmt::format("is {} {}", ticks(fault.size), fault.size > 0.0 ? "late" : "early"));
      break;
    case FaultKind::current_scale:
      tell("current_scale", "1",
           fmt::format("has a current that is {:.3f} times what the valve had", 1.0 + fault.size));
      break;
    case FaultKind::current_offset:
      tell("current_offset", "mA",
           fmt::format("has a current that is {:.2f} mA {} than what the valve had", std::abs(fault.size),
                       fault.size > 0.0 ? "more" : "less"));
      break;
    case FaultKind::drift:
      faulty.size *= 1e-3 * length_mm;
      tell("drift", "m",
           fmt::format("drifts by {:.2g} mm from its beginning to its end", length_mm * fault.size));
      break;
    case FaultKind::zero:
      tell("zero", "1", fmt::format("has its zero moved by {:.1f} counts", fault.size / count));
      break;
    case FaultKind::slipped:
      tell("slipped", "1",
           fmt::format("slipped by {:.1f} counts at about {:.1f} s", fault.size / count, at_s));
      break;
    case FaultKind::reading_scale:
      tell("reading_scale", "1",
           fmt::format("has readings on another scale, {:.3f} times", 1.0 + fault.size));
      break;
    case FaultKind::rows_lost:
      tell("rows_lost", "tick",
           fmt::format("{} about {} of readings at about {:.1f} s (rows are missing or double)",
                       fault.size > 0.0 ? "lost" : "repeats", ticks(fault.size), at_s));
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
    const bool late = fault.kind == FaultKind::late, zero = fault.kind == FaultKind::zero;
    const bool common_drift = fault.kind == FaultKind::drift && fault.common;
    if (late) shift(run, checked.masked[fault.run], static_cast<int>(std::round(fault.size)));
    if (zero) take_out(run, count, fault.size, fault.size);
    if (common_drift) take_out(run, count, 0.0, fault.size);
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
