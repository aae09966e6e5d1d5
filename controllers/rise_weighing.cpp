// The rise, and the secant over the load; see the header.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <controllers/rise_weighing.hpp>

namespace mckibben::controllers {
namespace {

constexpr std::int64_t fewest_counts = 20;  // that the load must have risen since the counter was reset
constexpr double short_of_start = 0.2;      // share of the way that the muscle, still filling, goes by itself
constexpr double after_s = 0.5;             // held at the top: the muscle is still filling
constexpr int most_fits = 20;
constexpr double fits_well = 1e-6;  // mean of counts less model [contraction ratio]
constexpr double lightest_kg = 0.01, heaviest_kg = 500.0;

}  // namespace

RiseWeighing::RiseWeighing(double speed_mA_per_s, int delay_ticks, const Knowledge& knowledge)
    : knowledge_(knowledge),
      range_(working_range(knowledge)),
      speed_mA_per_s_(speed_mA_per_s),
      delay_(static_cast<std::size_t>(delay_ticks)),
      rise_ticks_(std::llround(range_.width_mA() / speed_mA_per_s / knowledge.tick_s)),
      hold_ticks_(std::llround(after_s / knowledge.tick_s)),
      current_mA_(range_.lowest_mA) {
  counts_.reserve(static_cast<std::size_t>(ticks()));
  currents_mA_.reserve(static_cast<std::size_t>(ticks()));
}

double RiseWeighing::ratio(std::int64_t counts) const {
  return (static_cast<double>(counts) + knowledge_.middle_of_count) * knowledge_.contraction_per_count;
}

double RiseWeighing::step_mA(std::int64_t counts) {
  counts_.push_back(counts);
  const bool there =
      counts >= fewest_counts && ratio(counts) >= (1.0 - short_of_start) * knowledge_.target_at(0);
  const bool at_top = current_mA_ >= range_.highest_mA;
  if (held_ticks_ > 0 || there || at_top)
    ++held_ticks_;
  else
    current_mA_ = std::min(current_mA_ + speed_mA_per_s_ * knowledge_.tick_s, range_.highest_mA);
  currents_mA_.push_back(current_mA_);
  return current_mA_;
}

RiseWeighing::Fit RiseWeighing::fit(const ModelMaker& maker, double load_kg) const {
  Fit result{maker(load_kg, {rest_mA()}), 0.0, 0.0};
  std::vector<double> shown;
  for (std::size_t k = 0; k < counts_.size(); ++k) {
    shown.push_back(result.model->shown_ratio());
    const double misses = ratio(counts_[k]) - shown[k - std::min(k, delay_)];
    result.mean += misses;
    result.rms += misses * misses;
    result.model->step({result.model->given_mA(currents_mA_[k])}, 1);
  }
  const auto n = static_cast<double>(counts_.size());
  result.mean /= n;
  result.rms = std::sqrt(result.rms / n);
  return result;
}

/// What the braid would hold where the rise ended, less a tenth for friction.
double RiseWeighing::guess_kg() const {
  const double pressure_Pa = knowledge_.valve.pressure_Pa(current_mA_);
  return std::clamp(0.9 * knowledge_.model.force_N(ratio(counts_.back()), pressure_Pa) / gravity_m_per_s2,
                    lightest_kg, heaviest_kg);
}

std::unique_ptr<RigModel> RiseWeighing::weighed(const ModelMaker& maker) {
  if (counts_.back() < fewest_counts) {
    std::ostringstream text;
    text << "weighing: up to " << current_mA_ << ' ' << knowledge_.valve.unit << " the load rose by "
         << counts_.back() << " counts, to a contraction ratio of " << ratio(counts_.back()) << "; at least "
         << fewest_counts << " counts are needed. It is too heavy for this rig, or something holds it";
    throw ControllerFailure(text.str());
  }
  // The heavier, the less the model rises, down to none at all: between two loads that bracket the counts, by
  // regula falsi (Illinois).
  double light_kg = guess_kg(), heavy_kg = light_kg;
  Fit light = fit(maker, light_kg);
  double at_light = light.mean, at_heavy = light.mean;
  for (; at_light > 0.0 && light_kg > lightest_kg; at_light = (light = fit(maker, light_kg)).mean) {
    heavy_kg = light_kg;
    at_heavy = at_light;
    light_kg *= 0.8;
  }
  while (at_heavy < 0.0 && heavy_kg < heaviest_kg) at_heavy = fit(maker, heavy_kg *= 1.2).mean;
  if (at_light > 0.0 || at_heavy < 0.0)
    throw ControllerFailure(
        "weighing: with no load does the model rise as the counts did; its rig is another");
  double at_kg = light_kg;
  Fit best = std::move(light);
  for (int trial = 0, side = 0; trial < most_fits && std::abs(best.mean) > fits_well; ++trial) {
    at_kg = (light_kg * at_heavy - heavy_kg * at_light) / (at_heavy - at_light);
    best = fit(maker, at_kg);
    if (best.mean < 0.0) {
      light_kg = at_kg;
      at_light = best.mean;
      if (side == -1) at_heavy *= 0.5;
      side = -1;
    } else {
      heavy_kg = at_kg;
      at_heavy = best.mean;
      if (side == 1) at_light *= 0.5;
      side = 1;
    }
  }
  load_kg_ = at_kg;
  misfit_ = best.rms;
  return std::move(best.model);
}

}  // namespace mckibben::controllers
