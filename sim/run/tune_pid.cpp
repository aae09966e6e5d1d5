// The search: one coordinate for each open gain, the logarithm of it.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlopt.hpp>

#include <plant/valve.hpp>
#include <sim/run/tune_pid.hpp>

namespace mckibben::run {
namespace {

constexpr double very_bad = 1e12;  // finite, because the simplex computes with it

// Which gains are searched, and the best that was met on the way.
struct Search {
  const std::function<double(const Gains&)>& cost;
  std::vector<double Gains::*> open;
  Gains gains;
  Tuned best{{}, std::numeric_limits<double>::infinity()};
  std::vector<double> best_point{};
  std::string last_failure{};
  std::exception_ptr defect{};  // NLopt keeps no exception but its own

  double evaluate() {
    ++best.evaluations;
    double value = very_bad;
    try {
      value = cost(gains);
    } catch (const std::runtime_error& failure) {
      last_failure = failure.what();
      return very_bad;  // gains with which the simulation fails
    } catch (...) {
      defect = std::current_exception();
      throw;
    }
    if (!std::isfinite(value)) return very_bad;
    if (best.evaluations == 1) best.start_cost = value;
    if (value < best.cost) {
      best.cost = value;
      best.gains = gains;
    }
    return std::min(value, very_bad);
  }
};

double objective(const std::vector<double>& logarithms, std::vector<double>&, void* data) {
  auto& search = *static_cast<Search*>(data);
  for (std::size_t i = 0; i < search.open.size(); ++i) search.gains.*search.open[i] = std::exp(logarithms[i]);
  const double cost_before = search.best.cost;
  const double value = search.evaluate();
  if (search.best.cost < cost_before) search.best_point = logarithms;
  return value;
}

void descend(nlopt::opt& simplex, std::vector<double> point, Search& search) {
  double least = 0.0;
  try {
    simplex.optimize(point, least);
  } catch (const nlopt::roundoff_limited&) {
    // The best point met is still good.
  } catch (const std::exception&) {
    if (search.defect) std::rethrow_exception(search.defect);
    throw;
  }
}

/// From the gains that it has.
Tuned found_from(Search& search, const TuningOptions& options) {
  const auto logarithms = [&](const Gains& gains) {
    std::vector<double> values;
    for (double Gains::*gain : search.open) values.push_back(std::log(gains.*gain));
    return values;
  };
  nlopt::opt simplex(nlopt::LN_NELDERMEAD, static_cast<unsigned>(search.open.size()));
  simplex.set_min_objective(objective, &search);
  simplex.set_lower_bounds(logarithms(options.lowest));
  simplex.set_upper_bounds(logarithms(options.highest));
  simplex.set_initial_step(std::log(2.0));
  simplex.set_xtol_abs(options.tolerance);
  // A simplex can collapse on the rough cost of a counted position; a fresh one at the best point goes on.
  double cost_before = 0.0;
  auto point = logarithms(search.gains);
  do {
    cost_before = search.best.cost;
    simplex.set_maxeval(options.evaluations - search.best.evaluations);
    descend(simplex, point, search);
    point = search.best_point;
  } while (search.best.cost < (1.0 - options.tolerance) * cost_before &&
           search.best.evaluations < options.evaluations);
  return search.best;
}

/// With half the proportional gain, and half of that, for as long as it costs less: gains that make another
/// rig swing lead a simplex to the best of swings. Whether that costs less than `found`, before any search.
bool begins_lower(Search& search, const Tuned& found, const TuningOptions& options) {
  if (search.open.front() != &Gains::proportional_mA) return false;
  Gains lower = search.gains;
  double least = found.start_cost.value_or(very_bad);
  while ((lower.proportional_mA *= 0.5) > options.lowest.proportional_mA) {
    const Gains before = std::exchange(search.gains, lower);
    if (const double cost = search.evaluate(); cost < least) {
      least = cost;
      continue;
    }
    search.gains = before;
    break;
  }
  return least < found.cost;
}

}  // namespace

TuningOptions TuningOptions::for_span(double span_mA) {
  TuningOptions options;
  for (Gains* gains : {&options.start, &options.lowest, &options.highest})
    gains->proportional_mA *= span_mA / plant::thesis_span_mA;
  return options;
}

Tuned tune(const std::function<double(const Gains&)>& cost, const GivenGains& given,
           const TuningOptions& options) {
  Search search{cost, {}, options.start};
  const auto take = [&](const std::optional<double>& value, double Gains::*gain) {
    if (value)
      search.gains.*gain = *value;
    else
      search.open.push_back(gain);
  };
  take(given.proportional_mA, &Gains::proportional_mA);
  take(given.integral_time_s, &Gains::integral_time_s);
  take(given.derivative_time_s, &Gains::derivative_time_s);

  Tuned best;
  if (search.open.empty()) {
    search.evaluate();
    best = search.best;
  } else {
    Search lower = search;
    best = found_from(search, options);
    const bool begins = begins_lower(lower, best, options);
    const Tuned other = begins ? found_from(lower, options) : lower.best;
    if (other.cost < best.cost) best.cost = other.cost, best.gains = other.gains;
    best.evaluations += other.evaluations;
  }
  if (!std::isfinite(best.cost))
    throw std::runtime_error("tuning: no gains gave a run that could be simulated; the last one: " +
                             search.last_failure);
  return best;
}

}  // namespace mckibben::run
