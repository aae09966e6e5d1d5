// See the header.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include <sim/data/series.hpp>
#include <sim/diagnose/noise.hpp>
#include <sim/identify/rows.hpp>

namespace mckibben::identify {
namespace {

/// The step on which readings lie; 0: on none. Least squares: whole numbers of it.
double grid_of(const std::vector<double>& readings) {
  std::vector<double> levels = readings;
  std::ranges::sort(levels);
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  double step = 0.0;
  std::size_t steps = 0;
  for (std::size_t i = 1; i < levels.size(); ++i)
    if (const double d = levels[i] - levels[i - 1]; d > 1e-7) {
      step = steps++ == 0 ? d : std::min(step, d);
    }
  if (steps < 5) return 0.0;
  double furthest = 0.0;
  for (int pass = 0; pass < 3; ++pass) {
    double along = 0.0, square = 0.0;
    furthest = 0.0;
    for (const double level : levels) {
      const double off = level - levels.front(), n = std::round(off / step);
      along += n * off;
      square += n * n;
      furthest = std::max(furthest, std::abs(off - n * step));
    }
    step = along / square;
  }
  return furthest < 0.02 * step ? step : 0.0;
}

}  // namespace

Rows::Rows(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked,
           const std::vector<std::size_t>& which)
    : runs(which), kinds{data.runs[which.front()].judged().channel}, row_s(data.row_s()), data_(&data) {
  const diagnose::NoiseFloor floor = diagnose::noise_floor(data, masked, runs);
  noise.push_back(std::max(floor.jitter, floor.judged));
  sensor_count = count = floor.count;
  for (const std::size_t run : runs)
    for (const domain::Reading& reading : data.runs[run].beside())
      if (std::ranges::find(kinds, reading.channel) == kinds.end()) {
        kinds.push_back(reading.channel);
        noise.push_back(std::max(floor.beside(reading.channel), 1e-12));
      }
  std::vector<double> values;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const domain::Run& run = data.runs[runs[i]];
      const auto at = kind == 0 ? run.readings.begin()
                                : std::ranges::find(run.readings, kinds[kind], &domain::Reading::channel);
      if (at == run.readings.end()) continue;
      const domain::Reading& reading = *at;
      const auto place = static_cast<std::size_t>(at - run.readings.begin());
      blocks.push_back(
          {i, kind, place, static_cast<Eigen::Index>(values.size()), std::ssize(reading.values)});
      longest_s = std::max(longest_s, row_s * static_cast<double>(reading.values.size()));
      for (std::size_t k = 0; k < reading.values.size(); ++k) {
        known.push_back(!reading.is_missing(k) && !masked[runs[i]][k] ? 1 : 0);
        values.push_back(reading.values[k] + (kind == 0 ? floor.middle : 0.0));
        if (!std::isfinite(values.back())) {
          values.back() = 0.0;
          known.back() = 0;
        }
      }
    }
  read = Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
  find_counts();
  find_what_stays();
}

void Rows::find_counts() {
  std::vector<double> steps;
  for (const std::size_t run : runs) {
    const domain::Run& one = data_->runs[run];
    if (one.measured && one.measured->point_s > 0.0)
      continue;  // even steps of what was set make even readings
    if (const double step = grid_of(one.judged().values); step > 0.0) steps.push_back(step);
  }
  const double grid = 2 * steps.size() > runs.size() ? data::median(std::move(steps)) : 0.0;
  // Readings that were written more coarsely than they were counted.
  if (grid > 1.1 * sensor_count && grid > noise.front()) count = grid;
  unit = count > 0.0 ? count : noise.front();
}

// What counting adds stays as long as the load does: E[r(x) r(x + s)]/E[r^2] = 1 - 6 s (1 - s), s in counts a
// row, to its zero at 0.21 (of a phase within the count that is as likely as any other).
void Rows::find_what_stays() {
  stays = Eigen::VectorXd::Zero(size());
  if (!(count > 0.0)) return;
  // The speed is taken over 25 rows either way, or over all of a rest: it is one reading, however long.
  constexpr Eigen::Index far = 25;
  for (const Block& block : blocks) {
    if (!is_judged(block)) continue;
    const auto y = read.segment(block.begin, block.rows) / count;
    for (Eigen::Index i = 0; i < block.rows; ++i) {
      Eigen::Index up = i, low = i;
      while (up < block.rows - 1 && (up < i + far || std::abs(y[up + 1] - y[i]) < 1.5)) ++up;
      while (low > 0 && (low > i - far || std::abs(y[low - 1] - y[i]) < 1.5)) --low;
      const double s =
          std::max(std::abs(y[up] - y[low]), 0.5) / static_cast<double>(std::max<Eigen::Index>(up - low, 1));
      if (s < 0.2113) stays[block.begin + i] = 1.0 - 6.0 * s * (1.0 - s);
    }
  }
}

double Rows::rms(const Eigen::VectorXd& left, std::optional<std::size_t> run, std::size_t kind) const {
  double square = 0.0, known_rows = 0.0;
  for (const Block& block : blocks)
    if (block.kind == kind && (!run || block.run == *run))
      for (Eigen::Index i = block.begin; i < block.begin + block.rows; ++i)
        if (known[static_cast<std::size_t>(i)] != 0) {
          square += left[i] * left[i];
          known_rows += 1.0;
        }
  return std::sqrt(square / std::max(known_rows, 1.0));
}

}  // namespace mckibben::identify
