// See the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/data/series.hpp>
#include <sim/data/stamps.hpp>

namespace mckibben::data {
namespace {

using domain::Measurement;

constexpr std::array mains_hz{50.0, 60.0};
constexpr std::array<double, 4> beside_hz{-20.0, -15.0, 15.0, 20.0};
constexpr double window_s = 0.2;          // whole periods of both, and no drift of the mains matters
constexpr double in_a_period = 3.0;       // readings, at least
constexpr double stands_out = 4.0;        // over the median of what is beside
constexpr double share_of_scatter = 0.1;  // of what the windows scatter by, that a tone is worth telling
constexpr std::size_t least_windows = 5, least_in_window = 12;
constexpr std::size_t around = 2;          // windows before and after
constexpr std::size_t least_cut_off = 20;  // readings in a row
constexpr double scatters = 0.2;           // of neighbours are equal, at most, in a column that scatters
constexpr double turns_back = 0.05;        // of its moves go back, at least: else it moves and then rests
constexpr std::size_t beside_cut_off = 5;  // readings: their noise is cut off on one side

/// A wave in a window, beside a cubic for what the rig does; what the cubic leaves, and what both leave.
struct Wave {
  double cosine = 0.0, sine = 0.0, mean_square_beside = 0.0, mean_square_left = 0.0;
  double amplitude() const { return std::hypot(cosine, sine); }
};

/// Calls visit(first, last) for each window of stamps.
void each_window(const std::vector<double>& time_s, const auto& visit) {
  for (std::size_t first = 0; first < time_s.size();) {
    const auto end = std::lower_bound(time_s.begin() + static_cast<std::ptrdiff_t>(first), time_s.end(),
                                      time_s[first] + window_s);
    const auto last = static_cast<std::size_t>(end - time_s.begin());
    if (last < time_s.size()) visit(first, last);  // what is over at the end is no whole window
    first = last;
  }
}

Wave wave_in(const std::vector<double>& time_s, const std::vector<double>& values, std::size_t first,
             std::size_t last, double hz) {
  using Vector = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Vector right = Vector::Zero();
  std::size_t count = 0;
  const auto shape = [&](std::size_t k) {
    const double x = (time_s[k] - time_s[first]) / window_s - 0.5,
                 turn = 2.0 * std::numbers::pi * hz * time_s[k];
    return Vector{1.0, x, x * x, x * x * x, std::cos(turn), std::sin(turn)};
  };
  for (std::size_t k = first; k < last; ++k) {
    if (std::isnan(values[k])) continue;
    const Vector row = shape(k);
    normal += row * row.transpose();
    right += row * values[k];
    ++count;
  }
  if (count < least_in_window) return {};
  const Vector fitted = normal.ldlt().solve(right);
  Wave wave{fitted[4], fitted[5]};
  for (std::size_t k = first; k < last; ++k) {
    if (std::isnan(values[k])) continue;
    const Vector row = shape(k);
    const double beside = values[k] - row.head<4>().dot(fitted.head<4>());
    const double left = beside - row.tail<2>().dot(fitted.tail<2>());
    wave.mean_square_beside += beside * beside / static_cast<double>(count);
    wave.mean_square_left += left * left / static_cast<double>(count);
  }
  return wave;
}

/// In the middle one of all windows, so that jumps of what the rig does count for nothing.
struct Level {
  double amplitude = 0.0, mean_square = 0.0;
};
Level level(const std::vector<double>& time_s, const std::vector<double>& values, double hz) {
  std::vector<double> amplitudes, squares;
  each_window(time_s, [&](std::size_t first, std::size_t last) {
    const Wave wave = wave_in(time_s, values, first, last, hz);
    if (!(wave.mean_square_beside > 0.0)) return;
    amplitudes.push_back(wave.amplitude());
    squares.push_back(wave.mean_square_beside);
  });
  if (amplitudes.size() < least_windows) return {};
  return {median(std::move(amplitudes)), median(std::move(squares))};
}

/// Window by window; in each as those around it have it, the more by how much less they leave: where the load
/// starts or stops, a cubic leaves much, and a part of it looks like a wave.
void take_out(const Tone& tone, const std::vector<double>& time_s, std::vector<double>& values) {
  std::vector<Wave> waves;
  std::vector<std::size_t> begins;
  each_window(time_s, [&](std::size_t first, std::size_t last) {
    waves.push_back(wave_in(time_s, values, first, last, tone.hz));
    begins.push_back(first);
  });
  begins.push_back(time_s.size());  // the last window goes on to the end
  for (std::size_t i = 0; i < waves.size(); ++i) {
    double cosine = 0.0, sine = 0.0, weights = 0.0;
    for (std::size_t near = i > around ? i - around : 0; near < std::min(waves.size(), i + around + 1);
         ++near) {
      if (!(waves[near].mean_square_left > 0.0)) continue;
      const double weight = 1.0 / waves[near].mean_square_left;
      cosine += weight * waves[near].cosine;
      sine += weight * waves[near].sine;
      weights += weight;
    }
    if (!(weights > 0.0)) continue;
    for (std::size_t k = begins[i]; k < begins[i + 1]; ++k) {
      const double turn = 2.0 * std::numbers::pi * tone.hz * time_s[k];
      values[k] -= (cosine * std::cos(turn) + sine * std::sin(turn)) / weights;
    }
  }
}

/// A column of what was read or given, and how it is called and told.
struct Told {
  std::string name, unit;
  double per_unit;
  bool given;
  std::vector<double>* values;
};

std::vector<Told> columns_of(Measurement& measured, const plant::Rig& rig) {
  std::vector<Told> list;
  for (domain::MeasuredColumn& column : measured.columns) {
    if (column.is_command() || column.values.empty()) continue;
    const plant::Unit& unit = column.channel.signal->unit;
    auto [shown, per_unit] = std::pair{std::string(unit.name), 1.0 / unit.size};
    if (unit.name == plant::units::ratio.name) shown = "mm", per_unit = 1e3 * rig.muscle.rest_length_m;
    if (unit.name == plant::units::rad.name) shown = "deg", per_unit = 1.0 / plant::degree_rad;
    if (column.channel.is_pressure()) shown = "mbar", per_unit = 1e3 / plant::Pa_per_bar;
    list.push_back({column.channel.key_in_dataset(), shown, per_unit, column.given, &column.values});
  }
  return list;
}

/// Runs in which the same was found in a column.
struct Hum {
  std::vector<std::string> runs{};
  double largest = 0.0;
};

}  // namespace

Tone hum_of(const std::vector<double>& time_s, const std::vector<double>& values) {
  std::vector<double> gaps;
  for (std::size_t k = 1; k < time_s.size(); ++k) gaps.push_back(time_s[k] - time_s[k - 1]);
  if (gaps.empty()) return {};
  const double gap_s = upper_median(std::move(gaps));
  Tone best;
  for (const double hz : mains_hz) {
    if (in_a_period * gap_s * hz > 1.0) continue;
    const auto [amplitude, mean_square] = level(time_s, values, hz);
    if (amplitude <= best.amplitude || 0.5 * amplitude * amplitude < share_of_scatter * mean_square) continue;
    std::vector<double> beside(std::size(beside_hz));
    std::ranges::transform(beside_hz, beside.begin(),
                           [&](double off_hz) { return level(time_s, values, hz + off_hz).amplitude; });
    if (amplitude > stands_out * median(std::move(beside))) best = {hz, amplitude};
  }
  return best;
}

CutOff leave_out_cut_off(std::vector<double>& values) {
  std::vector<double> known;
  for (const double value : values)
    if (!std::isnan(value)) known.push_back(value);
  if (known.size() < 2) return {};
  const auto [lowest, highest] = std::ranges::minmax(known);
  std::size_t equal = 0, inside = 0, turns = 0;
  for (std::size_t k = 1; k < known.size(); ++k) {
    if (known[k] == lowest || known[k] == highest) continue;
    ++inside;
    if (known[k] == known[k - 1]) ++equal;
    if (k > 1 && (known[k] - known[k - 1]) * (known[k - 1] - known[k - 2]) < 0.0) ++turns;
  }
  const auto of_inside = [inside](double share) { return share * static_cast<double>(inside); };
  if (inside == 0 || static_cast<double>(equal) > of_inside(scatters) ||
      static_cast<double>(turns) < of_inside(turns_back))
    return {};
  CutOff cut_off;
  const std::vector<double> was = values;
  for (const double end : {lowest, highest}) {
    std::size_t in_a_row = 0, longest = 0;
    for (const double value : was) {
      in_a_row = value == end ? in_a_row + 1 : 0;
      longest = std::max(longest, in_a_row);
    }
    if (longest < least_cut_off) continue;
    cut_off.at = end;
    for (std::size_t k = 0; k < was.size(); ++k) {
      if (was[k] != end) continue;
      ++cut_off.readings;
      const std::size_t from = k > beside_cut_off ? k - beside_cut_off : 0,
                        to = std::min(was.size(), k + beside_cut_off + 1);
      std::fill(values.begin() + static_cast<std::ptrdiff_t>(from),
                values.begin() + static_cast<std::ptrdiff_t>(to), std::nan(""));
    }
  }
  return cut_off;
}

std::vector<Finding> mend_at_stamps(domain::Dataset& data) {
  std::vector<Finding> findings;
  std::map<std::pair<std::string, double>, Hum> hums;
  std::map<std::string, std::string> units;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    domain::Run& run = data.runs[i];
    if (!run.measured || run.measured->point_s > 0.0 || run.measured->counted) continue;
    for (const Told& column : columns_of(*run.measured, data.rig)) {
      if (const CutOff cut_off = column.given ? CutOff{} : leave_out_cut_off(*column.values);
          cut_off.readings > 0)
        findings.push_back({.runs = {i},
                            .message = fmt::format(
                                "{} stays at {:.4g} {} to the last digit in {} of {} readings, and scatters "
                                "elsewhere: the end of the sensor's range",
                                column.name, cut_off.at * column.per_unit, column.unit, cut_off.readings,
                                column.values->size()),
                            .severity = Severity::masked});
      const Tone tone = hum_of(run.measured->time_s, *column.values);
      if (tone.amplitude == 0.0) continue;
      take_out(tone, run.measured->time_s, *column.values);
      Hum& hum = hums[{column.name, tone.hz}];
      hum.runs.push_back(run.id);
      hum.largest = std::max(hum.largest, tone.amplitude * column.per_unit);
      units[column.name] = column.unit;
    }
  }
  for (const auto& [of, hum] : hums) {
    const auto& [name, hz] = of;
    const std::string in =
        hum.runs.size() == data.runs.size() ? "every run" : fmt::format("run {}", fmt::join(hum.runs, ", "));
    findings.push_back({.message = fmt::format("{}: a tone of {:g} Hz, {:.2g} {} in amplitude, in {}: hum of "
                                               "the mains",
                                               name, hz, hum.largest, units[name], in),
                        .severity = Severity::taken_out});
  }
  return findings;
}

}  // namespace mckibben::data
