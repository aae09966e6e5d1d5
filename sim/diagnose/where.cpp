// Binning and sign flips; see the header.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>
#include <span>
#include <string>

#include <fmt/format.h>

#include <sim/data/parts.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/diagnose/where.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const WhereThresholds& cells_by = thresholds.where;

/// One reading and the state the model was in.
struct Row {
  double residual = 0.0;  // of the judged reading
  std::size_t segment = 0;
  double load_kg = 0.0;
  double speed = 0.0;  // mm/s; of a joint deg/s
  double pressure_Pa = 0.0, opposite_pressure_Pa = 0.0;
  double contraction_ratio = 0.0, opposite_contraction_ratio = 0.0;
  double angle_rad = 0.0;  // of a joint
  double time_s = 0.0;
  double since_turn_s = 0.0;  // below 0: none yet
};

/// Time since the last turn at each row; -1 before the first. A turn is where the direction changed, known
/// once the load has come back by more than `count`.
std::vector<double> since_turn_s(const std::vector<plant::State<double>>& states, double count,
                                 double tick_s) {
  std::vector<std::size_t> turns;
  double direction = 0.0;  // none yet
  std::size_t low = 0, high = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const auto at = [&](std::size_t row) { return states[row].joint.contraction_ratio; };
    if (at(k) < at(low)) low = k;
    if (at(k) > at(high)) high = k;
    const bool down = direction >= 0.0 && at(high) - at(k) > count;
    const bool up = direction <= 0.0 && at(k) - at(low) > count;
    if (!down && !up) continue;
    if (direction != 0.0) turns.push_back(down ? high : low);
    direction = down ? -1.0 : 1.0;
    low = high = k;
  }
  std::vector<double> since_s(states.size(), -1.0);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const std::size_t end = i + 1 < turns.size() ? turns[i + 1] : states.size();
    for (std::size_t k = turns[i]; k < end; ++k) since_s[k] = static_cast<double>(k - turns[i]) * tick_s;
  }
  return since_s;
}

/// What a row says of the state that the model was in.
Row in_state(const Rig& rig, const plant::State<double>& state) {
  const auto& joint = state.joint;
  Row row{.speed = 1e3 * rig.muscle.rest_length_m * joint.contraction_speed_per_s,
          .pressure_Pa = state.side.muscle_pressure_Pa,
          .contraction_ratio = joint.contraction_ratio};
  const plant::Pair* pair = rig.pair();
  if (pair == nullptr) return row;
  const double length_m = rig.muscle.rest_length_m, radius_m = rig.joint.wheel_radius_m;
  row.angle_rad = (joint.contraction_ratio - pair->contraction_ratio) * length_m / radius_m;
  row.speed = joint.contraction_speed_per_s * length_m / radius_m / plant::degree_rad;
  row.opposite_pressure_Pa = state.opposite.muscle_pressure_Pa;
  row.opposite_contraction_ratio =
      pair->opposite_contraction_ratio - row.angle_rad * radius_m / pair->opposite.muscle.rest_length_m;
  return row;
}

/// The rows of all runs that count, and the number of segments.
std::vector<Row> rows_of(const Experiment& experiment, const Rig& rig, const Runs& runs,
                         std::size_t& segments) {
  const auto readings = experiment.readings(rig, runs);
  std::vector<Row> rows;
  const auto per_segment =
      static_cast<std::size_t>(std::lround(std::ceil(thresholds.tell.segment_s / experiment.data().row_s())));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto& states = readings[i].states;
    const Eigen::VectorXd residuals = experiment.residuals(readings[i], runs[i]);
    const auto since_s = since_turn_s(states, run::contraction_per_count(rig), experiment.data().row_s());
    for (std::size_t k = 0; k < states.size(); ++k) {
      const double residual = residuals[static_cast<Eigen::Index>(k)];
      if (residual == 0.0) continue;  // masked
      Row row = in_state(rig, states[k]);
      row.residual = experiment.floor().judged * residual;
      row.segment = segments + k / per_segment;
      row.load_kg = experiment.data().runs[runs[i]].load_kg;
      row.time_s = experiment.data().rows_begin_s() + static_cast<double>(k) * experiment.data().row_s();
      row.since_turn_s = since_s[k];
      rows.push_back(row);
    }
    segments += (states.size() + per_segment - 1) / per_segment;
  }
  return rows;
}

/// A way to sort rows into cells.
struct Factor {
  std::string name;
  std::vector<std::string> cells;
  std::function<std::ptrdiff_t(const Row&)> cell;  // -1: none
};

/// Bins between ascending edges; the first and the last are open.
Factor binned(std::string name, std::span<const double> between, double per_unit, const std::string& unit,
              std::function<double(const Row&)> value) {
  const std::vector<double> edges(between.begin(), between.end());
  Factor factor{std::move(name), {}, {}};
  factor.cells.push_back(fmt::format("below {:.3g} {}", edges.front() / per_unit, unit));
  for (std::size_t i = 1; i < edges.size(); ++i)
    factor.cells.push_back(
        fmt::format("{:.3g} to {:.3g} {}", edges[i - 1] / per_unit, edges[i] / per_unit, unit));
  factor.cells.push_back(fmt::format("above {:.3g} {}", edges.back() / per_unit, unit));
  for (std::string& cell : factor.cells)
    while (cell.back() == ' ') cell.pop_back();
  factor.cell = [edges, value = std::move(value)](const Row& row) {
    return std::distance(edges.begin(), std::upper_bound(edges.begin(), edges.end(), value(row)));
  };
  return factor;
}

/// The inner edges of equal bins.
std::vector<double> equal(double lowest, double highest, int bins) {
  std::vector<double> edges;
  for (int i = 1; i < bins; ++i) edges.push_back(std::lerp(lowest, highest, static_cast<double>(i) / bins));
  return edges;
}

/// Loads, each a cell.
Factor by_load(const Experiment& experiment, const Runs& runs) {
  std::vector<double> loads_kg;
  for (const std::size_t run : runs) loads_kg.push_back(experiment.data().runs[run].load_kg);
  std::sort(loads_kg.begin(), loads_kg.end());
  loads_kg.erase(std::unique(loads_kg.begin(), loads_kg.end()), loads_kg.end());
  Factor load{"load", {}, [loads_kg](const Row& row) {
                return std::distance(loads_kg.begin(),
                                     std::lower_bound(loads_kg.begin(), loads_kg.end(), row.load_kg));
              }};
  for (const double load_kg : loads_kg) load.cells.push_back(fmt::format("{:.6g} kg", load_kg));
  return load;
}

Factor by_direction(std::string forward, std::string back, double rest) {
  return {"direction",
          {std::move(forward), std::move(back), "at rest"},
          [rest](const Row& row) -> std::ptrdiff_t {
            if (std::abs(row.speed) < rest) return 2;
            return row.speed > 0.0 ? 0 : 1;
          }};
}

Factor by_speed(std::span<const double> between, const std::string& unit) {
  return binned("speed", between, 1.0, unit, [](const Row& row) { return std::abs(row.speed); });
}

Factor by_pressure(std::string name, const plant::Valve& valve, double Row::*pressure_Pa) {
  return binned(std::move(name), equal(valve.zero_pressure_Pa, valve.span_pressure_Pa, cells_by.pressures),
                plant::Pa_per_bar, "bar", [pressure_Pa](const Row& row) { return row.*pressure_Pa; });
}

/// By how one muscle moves, under its load.
std::vector<Factor> by_muscle(const Experiment& experiment, const Rig& rig, const Runs& runs) {
  std::vector<Factor> factors;
  factors.push_back(by_direction("contracting", "relaxing", cells_by.rest_mm_per_s));
  factors.push_back(by_speed(cells_by.speeds_mm_per_s, "mm/s"));
  if (!experiment.data().lengths_are_given()) factors.push_back(by_load(experiment, runs));
  factors.push_back(by_pressure("pressure", rig.valve, &Row::pressure_Pa));
  factors.push_back(
      binned("contraction",
             equal(0.0, run::knowledge_of(rig, {}).model.largest_contraction_ratio(), cells_by.contractions),
             1.0, "", [](const Row& row) { return row.contraction_ratio; }));
  return factors;
}

/// By how two muscles turn their joint.
std::vector<Factor> by_joint(const Rig& rig, const std::vector<Row>& rows) {
  std::vector<Factor> factors;
  factors.push_back(by_direction("towards muscle 1", "towards muscle 2", cells_by.rest_deg_per_s));
  factors.push_back(by_speed(cells_by.speeds_deg_per_s, "deg/s"));
  factors.push_back(by_pressure("pressure of muscle 1", rig.valve, &Row::pressure_Pa));
  factors.push_back(
      by_pressure("pressure of muscle 2", rig.pair()->opposite.valve, &Row::opposite_pressure_Pa));
  if (rows.empty()) return factors;
  const auto [low, high] = std::ranges::minmax(rows, {}, &Row::angle_rad);
  factors.push_back(binned("angle", equal(low.angle_rad, high.angle_rad, cells_by.contractions),
                           plant::degree_rad, "deg", [](const Row& row) { return row.angle_rad; }));
  return factors;
}

std::vector<Factor> factors_of(const Experiment& experiment, const Rig& rig, const Runs& runs,
                               const std::vector<Row>& rows) {
  double longest_s = 0.0;
  for (const std::size_t run : runs)
    longest_s = std::max(longest_s,
                         static_cast<double>(experiment.data().runs[run].rows()) * experiment.data().row_s());
  const bool pair = rig.pair() != nullptr;
  auto factors = pair ? by_joint(rig, rows) : by_muscle(experiment, rig, runs);
  if (!data::are_settled_points(experiment.data())) {
    factors.push_back(binned("time in run", equal(0.0, longest_s, cells_by.times), 1.0, "s",
                             [](const Row& row) { return row.time_s; }));
    factors.push_back(
        binned("start of run", cells_by.start_s, 1.0, "s", [](const Row& row) { return row.time_s; }));
  }
  factors.push_back(binned("time since reversal", cells_by.since_reversal_s, 1.0, "s",
                           [](const Row& row) { return row.since_turn_s; }));
  factors.back().cell = [bin = factors.back().cell](const Row& row) -> std::ptrdiff_t {
    return row.since_turn_s < 0.0 ? -1 : bin(row);
  };
  factors.push_back({"braid stop", {"touched", "free"}, [](const Row& row) -> std::ptrdiff_t {
                       return std::min(row.contraction_ratio, row.opposite_contraction_ratio) < 0.0 ? 0 : 1;
                     }});
  return factors;
}

/// Share of random signs under which the sum of the segments' contributions is as large as it is.
double by_sign_flips(const std::vector<double>& contributions, std::mt19937_64& random) {
  const double sum = std::abs(std::accumulate(contributions.begin(), contributions.end(), 0.0));
  int as_large = 0;
  for (int flip = 0; flip < cells_by.flips; ++flip) {
    double flipped = 0.0;
    std::uint64_t bits = 0;
    for (std::size_t s = 0; s < contributions.size(); ++s) {
      if (s % 64 == 0) bits = random();
      flipped += (bits >> (s % 64) & 1U) != 0 ? contributions[s] : -contributions[s];
    }
    if (std::abs(flipped) >= sum * (1.0 - cells_by.same_sum)) ++as_large;
  }
  return (1.0 + as_large) / (1.0 + cells_by.flips);
}

/// The cells of one factor.
std::vector<Cell> map(const Factor& factor, const std::vector<Row>& rows, std::size_t segments, double floor,
                      std::mt19937_64& random) {
  struct Sum {
    double rows = 0.0, residuals = 0.0, squares = 0.0;
    void add(double residual) {
      rows += 1.0;
      residuals += residual;
      squares += residual * residual;
    }
  };
  const std::size_t count = factor.cells.size();
  std::vector<Sum> sums(count);
  Sum whole;
  std::vector<std::vector<Sum>> parts(count, std::vector<Sum>(segments));
  std::vector<Sum> wholes(segments);
  for (const Row& row : rows) {
    const std::ptrdiff_t cell = factor.cell(row);
    if (cell < 0) continue;
    const auto c = static_cast<std::size_t>(cell);
    sums[c].add(row.residual);
    parts[c][row.segment].add(row.residual);
    whole.add(row.residual);
    wholes[row.segment].add(row.residual);
  }
  std::vector<Cell> cells(count);
  double above = 0.0;  // the floor, of all cells
  const auto excess = [&](const Sum& sum) { return std::max(0.0, sum.squares - sum.rows * floor * floor); };
  for (const Sum& sum : sums) above += excess(sum);
  const auto visited = std::count_if(sums.begin(), sums.end(), [](const Sum& sum) { return sum.rows > 0.0; });
  for (std::size_t c = 0; c < count; ++c) {
    const Sum& sum = sums[c];
    Cell& cell = cells[c];
    cell.factor = factor.name;
    cell.cell = factor.cells[c];
    if (sum.rows == 0.0) continue;
    cell.rows = static_cast<std::size_t>(sum.rows);
    cell.mean = sum.residuals / sum.rows;
    cell.rms = std::sqrt(sum.squares / sum.rows);
    cell.share_of_gap = above > 0.0 ? excess(sum) / above : 0.0;
    // What each segment adds to the mean, or to its distance from the factor's mean: both its own rows and
    // those that moved the factor's mean.
    const double common = visited > 1 ? whole.residuals / whole.rows : 0.0;
    std::vector<double> contributions;
    for (std::size_t s = 0; s < segments; ++s) {
      const auto centred = [&](const Sum& part) { return part.residuals - part.rows * common; };
      double contribution = centred(parts[c][s]) / sum.rows;
      if (visited > 1) contribution -= centred(wholes[s]) / whole.rows;
      if (contribution != 0.0) contributions.push_back(contribution);
    }
    cell.p_value = by_sign_flips(contributions, random);
  }
  return cells;
}

/// Benjamini and Hochberg: all up to the largest rank k with p(k) <= k / n times the rate.
void mark_significant(std::vector<Cell>& cells) {
  std::vector<double> p;
  for (const Cell& cell : cells)
    if (cell.rows > 0) p.push_back(cell.p_value);
  std::sort(p.begin(), p.end());
  double limit = 0.0;
  for (std::size_t k = 0; k < p.size(); ++k)
    if (p[k] <= cells_by.false_discoveries * static_cast<double>(k + 1) / static_cast<double>(p.size()))
      limit = p[k];
  for (Cell& cell : cells) cell.significant = cell.rows > 0 && cell.p_value <= limit;
}

}  // namespace

std::vector<Cell> where(const Experiment& experiment, const Rig& recalibrated, const Runs& runs,
                        std::uint64_t seed) {
  std::size_t segments = 0;
  const auto rows = rows_of(experiment, recalibrated, runs, segments);
  std::mt19937_64 random(seed);
  std::vector<Cell> cells;
  for (const Factor& factor : factors_of(experiment, recalibrated, runs, rows))
    for (Cell& cell : map(factor, rows, segments, experiment.floor().judged, random))
      cells.push_back(std::move(cell));
  mark_significant(cells);
  return cells;
}

}  // namespace mckibben::diagnose
