// A load cell on the cord of a hanging load: on average it reads the weight, whatever moves it.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <sim/data/gains.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/domain/number.hpp>

namespace mckibben::data {
namespace {

constexpr const ColumnThresholds& of_cells = thresholds.column;

/// What a cell reads: `zero_N` and `factor` times what hangs.
struct Cell {
  double zero_N = 0.0, factor = 1.0;

  double off_N(double hangs_N) const { return zero_N + (factor - 1.0) * hangs_N; }
};

/// Where cell and labels agree but in one run: its label, which the cell knows better than the motion does.
std::optional<Finding> label_off(const domain::Dataset& data, const std::string& key,
                                 const std::vector<std::size_t>& runs, const std::vector<double>& read_N,
                                 const std::vector<double>& hangs_N, double least_N) {
  if (runs.size() < of_cells.least_labels) return std::nullopt;
  std::vector<double> offs_N;
  for (std::size_t k = 0; k < runs.size(); ++k) offs_N.push_back(std::abs(read_N[k] - hangs_N[k]));
  const auto k = static_cast<std::size_t>(std::ranges::max_element(offs_N) - offs_N.begin());
  const double most_N = std::exchange(offs_N[k], 0.0);
  if (most_N < least_N || std::ranges::max(offs_N) > of_cells.same_zero * most_N) return std::nullopt;
  return Finding{
      .quantity = "load",
      .runs = {runs[k]},
      .message = fmt::format(
          "{} reads {:.3g} N {} than hangs there, in no other run so: is load: {:.4g} kg meant?", key, most_N,
          read_N[k] > hangs_N[k] ? "more" : "less", data.runs[runs[k]].load_kg * read_N[k] / hangs_N[k]),
      .severity = Severity::doubtful};
}

}  // namespace

std::optional<Finding> load_cell_off(const domain::Dataset& data, const std::vector<Compared>& runs,
                                     const std::string& key, domain::ColumnPlace place, double unit_N,
                                     double accuracy_N) {
  std::vector<double> read_N, hangs_N, offs_N, factors;
  Finding found{.quantity = key, .message = {}, .severity = Severity::doubtful};
  for (const Compared& run : runs) {
    if (run.measured.empty() || !(mean(run.model) > 0.0)) continue;
    found.runs.insert(found.runs.end(), run.runs.begin(), run.runs.end());
    hangs_N.push_back(mean(run.model));
    read_N.push_back(mean(run.measured));
    offs_N.push_back(read_N.back() - hangs_N.back());
    factors.push_back(read_N.back() / hangs_N.back());
  }
  if (offs_N.empty()) return std::nullopt;
  const auto [least_N, most_N] = std::ranges::minmax(hangs_N);
  const double sure_N = of_cells.zero_accuracies * accuracy_N;
  // What is left of a run may be a fourth of what it is off by; friction and impacts are in it.
  const auto worst = [&](const Cell& cell) {
    double most = 0.0;
    for (std::size_t k = 0; k < offs_N.size(); ++k)
      most = std::max(most, std::abs(offs_N[k] / cell.off_N(hangs_N[k]) - 1.0));
    return most;
  };
  const double least_zero_N = std::max(of_cells.zero_of_load_cell * most_N, sure_N);
  const auto is_zero = [&](const Cell& cell) { return std::abs(cell.zero_N) >= least_zero_N; };
  const auto is_factor = [&](const Cell& cell) {
    return std::abs(cell.factor - 1.0) >= std::max(of_cells.gain_of_load_cell, sure_N / least_N);
  };
  const bool several = most_N >= of_cells.other_load * least_N;
  const Cell zero{.zero_N = median(offs_N)}, factor{.factor = median(factors)};
  const Line line(read_N, hangs_N);
  const Cell both{mean(read_N) - line.slope * mean(hangs_N), line.slope};
  const bool by_zero = is_zero(zero) && worst(zero) <= of_cells.same_zero && several;
  const bool by_factor =
      is_factor(factor) && worst(factor) <= of_cells.same_zero && (!by_zero || worst(factor) < worst(zero));
  // Two loads are on a line whatever they are.
  std::vector<double> loads_N = hangs_N;
  std::ranges::sort(loads_N);
  const double middle_N = loads_N[loads_N.size() / 2];
  const bool three = middle_N > (1.0 + of_cells.zero_of_load_cell) * least_N &&
                     middle_N < (1.0 - of_cells.zero_of_load_cell) * most_N;
  const bool by_both = !by_zero && !by_factor && several && three && is_zero(both) && is_factor(both) &&
                       worst(both) <= of_cells.same_zero;
  if (!by_zero && !by_factor && !by_both)
    return found.runs.size() == offs_N.size()
               ? label_off(data, key, found.runs, read_N, hangs_N, least_zero_N)
               : std::nullopt;
  const Cell& cell = by_factor ? factor : by_zero ? zero : both;
  place.zero = domain::significant(place.zero + cell.zero_N / unit_N / place.factor, 3);
  place.factor = domain::significant(place.factor / cell.factor, 3);
  const std::string meant = line_of(key, place);
  const double more = 100.0 * (cell.factor - 1.0);
  if (by_factor)
    found.message = fmt::format(
        "{} reads {:.3g} times what hangs there{}: is a factor of the load cell left out? Then columns: "
        "{{{}}}; or {} {:.0f} % {} than written{}",
        key, cell.factor, several ? ", under every load" : "", meant,
        several ? "all loads are" : "the load is", std::abs(more), more > 0.0 ? "more" : "less",
        several ? "" : ", or its zero is another: one load does not separate them");
  else if (by_zero)
    found.message = fmt::format(
        "{} reads {:.3g} N {} than hangs there, whatever the load: is its zero what the load cell reads with "
        "nothing on it? About columns: {{{}}}",
        key, std::abs(cell.zero_N), cell.zero_N > 0.0 ? "more" : "less", meant);
  else
    found.message = fmt::format(
        "{} reads {:.3g} times what hangs there and {:.3g} N {}, under every load: are factor and zero of "
        "the load cell others? About columns: {{{}}}",
        key, cell.factor, std::abs(cell.zero_N), cell.zero_N > 0.0 ? "more" : "less", meant);
  return found;
}

}  // namespace mckibben::data
