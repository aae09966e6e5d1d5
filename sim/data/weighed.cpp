// See the header.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <plant/geometry.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/data/weighed.hpp>

namespace mckibben::data {
namespace {

using Series = std::vector<double>;

constexpr const LoadThresholds& of_weights = thresholds.load;

/// Whether the reading stands still round row `k` though the simulated load moves.
bool stands_still(const Series& measured, const Series& simulated, std::size_t k) {
  const std::size_t end = std::min({k + of_weights.still_rows, measured.size(), simulated.size()});
  const auto of = [&](const Series& series) {
    return std::span(series).subspan(k - std::min(k, of_weights.still_rows),
                                     end - k + std::min(k, of_weights.still_rows));
  };
  if (!std::ranges::all_of(of(measured), [&](double m) { return m == measured[k]; })) return false;
  return range(of(simulated)) > of_weights.moving;
}

/// What the braid carries beside a return spring and the rubber tube at what was measured, in the middle of
/// what friction makes of it. Where the simulated load hangs as well, by how much more it carries than that
/// one: what the simulation is off by in friction and inertia, the measurement is too.
std::optional<Weighed> weigh(const plant::Rig& rig, const plant::Braid& braid, std::size_t index,
                             const domain::Run& run, const Expected& expected) {
  const auto& tube = rig.effects.get<plant::BladderElasticity>();
  const auto carried_kg = [&](double contraction_ratio, std::size_t k) {
    plant::Instant<double> now{};
    now.contraction_ratio = contraction_ratio;
    now.rise_m = braid.rest_length_m() * contraction_ratio;
    const double tube_N = tube.absent() ? 0.0 : tube.pull_N(now, 0.0);
    return (braid.force_N(contraction_ratio, expected.pressure_Pa[k]) + tube_N -
            rig.joint.spring().pull(now.rise_m)) /
           plant::gravity_m_per_s2;
  };
  const Series& read = run.judged().values;
  if (range(read) == 0.0) return std::nullopt;  // a dead reading weighs nothing
  Series plain_kg, compared_kg;
  for (std::size_t k = 0; k < std::min(read.size(), expected.pressure_Pa.size()); ++k) {
    const double measured = read[k], simulated = expected.judged()[k];
    if (measured < of_weights.lifted || !braid.in_domain(measured)) continue;
    if (stands_still(read, expected.judged(), k)) continue;
    plain_kg.push_back(carried_kg(measured, k));
    if (simulated > of_weights.lifted)
      compared_kg.push_back(run.load_kg + plain_kg.back() - carried_kg(simulated, k));
  }
  if (plain_kg.size() < of_weights.least_rows) return std::nullopt;
  const bool both = static_cast<double>(compared_kg.size()) >
                    of_weights.compared_share * static_cast<double>(plain_kg.size());
  return Weighed{index, run.load_kg, upper_median(std::move(both ? compared_kg : plain_kg))};
}

}  // namespace

std::vector<Weighed> weigh(const domain::Dataset& data, const std::vector<Expected>& expected, bool loaded) {
  const plant::Braid braid(data.rig.muscle);
  std::vector<Weighed> list;
  if (data.rig.has_angle()) return list;  // what hangs on a lever pulls by its angle
  for (std::size_t i = 0; i < data.runs.size(); ++i)
    if ((data.runs[i].load_kg > 0.0) == loaded)
      if (const auto one = weigh(data.rig, braid, i, data.runs[i], expected[i])) list.push_back(*one);
  return list;
}

double common_ratio(const std::vector<Weighed>& list) {
  Series ratios;
  for (const Weighed& one : list) ratios.push_back(one.seems_kg / one.label_kg);
  return upper_median(std::move(ratios));
}

double far_off(const Weighed& one, double scale) {
  return one.seems_kg > 0.0 && scale > 0.0 ? std::abs(std::log(one.seems_kg / one.label_kg / scale))
                                           : std::numeric_limits<double>::infinity();
}

bool all_are_off(const std::vector<Weighed>& list, const Weighed& one) {
  constexpr double as_well = 0.5;
  const auto off_kg = [](const Weighed& each) { return each.seems_kg - each.label_kg; };
  const auto is_other = [&](const Weighed& each) { return each.label_kg != one.label_kg; };
  const auto agrees = [&](const Weighed& each) {
    return !is_other(each) || off_kg(each) / off_kg(one) > as_well;
  };
  return std::ranges::any_of(list, is_other) && std::ranges::all_of(list, agrees);
}

std::vector<MisplacedPoint> misplaced_points_in(const std::vector<Weighed>& list) {
  std::vector<MisplacedPoint> found;
  if (list.empty()) return found;
  const double scale = common_ratio(list);
  for (const Weighed& one : list)
    for (const double factor : {10.0, 0.1, 1e3, 1e-3})
      if (far_off(one, scale * factor) < std::log(of_weights.sure_tenth)) found.push_back({one, factor});
  return found;
}

}  // namespace mckibben::data
