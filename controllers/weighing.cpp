// Friction from the calibrated coefficient and the contact surface (T 4.2, 4.3, 4.29), braid force from the
// data sheet (T 4.30), load from their difference (T 4.31), averaged.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

#include <controllers/weighing.hpp>

namespace mckibben::controllers {
namespace {

// A contraction counts from here on: before, the threads have not let go of the load in full.
constexpr std::int64_t counts_to_let_go = 5;
constexpr int fewest_samples = 5;

}  // namespace

void WeighingSettings::follow(const CurrentRange& range) {
  if (!speed_mA_per_s) speed_mA_per_s = 0.375 * range.width_mA();
  if (!low_mA) low_mA = range.lowest_mA;
  if (!high_mA) high_mA = range.lowest_mA + 0.25 * range.width_mA();
}

Weighing::Weighing(WeighingSettings settings, const Calibration& calibration, const Knowledge& knowledge)
    : friction_(calibration.contraction_friction),
      range_(calibration.range),
      tube_(calibration.tube_pull.value_or(TubePull{})),
      braid_(knowledge.model),
      valve_(knowledge.valve),
      contraction_per_count_(knowledge.contraction_per_count),
      middle_of_count_(knowledge.middle_of_count),
      tick_s_(knowledge.tick_s),
      contractions_(settings.contractions),
      seen_(static_cast<std::size_t>(settings.contractions)) {
  settings.follow(working_range(knowledge));
  speed_mA_per_s_ = *settings.speed_mA_per_s;
  low_mA_ = *settings.low_mA;
  high_mA_ = *settings.high_mA;
  ticks_each_ = std::llround(std::ceil(2.0 * (high_mA_ - low_mA_) / speed_mA_per_s_ / tick_s_));
}

double Weighing::current_mA(std::int64_t tick) const {
  const double rise_s = (high_mA_ - low_mA_) / speed_mA_per_s_;
  const double time_s = static_cast<double>(tick % ticks_each_) * tick_s_;
  const double from_top_mA = speed_mA_per_s_ * std::abs(time_s - rise_s);
  return std::clamp(high_mA_ - from_top_mA, low_mA_, high_mA_);
}

// The acceleration is left out of T 4.31, as T 4.3 says it may. Its mean over a contraction is the speed
// gained over the time taken, about 0.1 m/s2; from counts it cannot be had, since one count in one tick of 12
// ms looks like 0.9 m/s2.
void Weighing::see(std::int64_t tick, std::int64_t counts) {
  Contraction& one = seen_[static_cast<std::size_t>(tick / ticks_each_)];
  const std::int64_t into = tick % ticks_each_;
  if (into == 0) one.lowest_counts = one.highest_counts = counts;
  one.lowest_counts = std::min(one.lowest_counts, counts);
  one.highest_counts = std::max(one.highest_counts, counts);
  const bool rising_current = 2 * (into + 1) <= ticks_each_;
  const double e = (static_cast<double>(counts) + middle_of_count_) * contraction_per_count_;
  if (!rising_current || counts < one.lowest_counts + counts_to_let_go || e < range_.lowest_ratio ||
      e > range_.highest_ratio)
    return;
  const double pressure_Pa = valve_.pressure_Pa(current_mA(tick));
  const double friction_N =
      friction_.coefficient(e, speed_mA_per_s_) * braid_.contact_surface_m2(e) * pressure_Pa;
  const double pull_N = braid_.force_N(e, pressure_Pa) - tube_.pull_N(e, braid_.rest_length_m) - friction_N;
  one.sum_kg += pull_N / gravity_m_per_s2;
  ++one.samples;
}

WeighedLoad Weighing::result() const {
  double sum_kg = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const Contraction& one = seen_[i];
    if (one.samples < fewest_samples) {
      std::ostringstream text;
      text << "weighing failed: in contraction " << i + 1 << " of " << seen_.size() << " the load moved by "
           << one.highest_counts - one.lowest_counts << " counts, to a contraction ratio of "
           << static_cast<double>(one.highest_counts) * contraction_per_count_ << ", of which " << one.samples
           << (one.samples == 1 ? " sample" : " samples") << " can be used (at least " << fewest_samples
           << "; calibrated are contraction ratios from " << range_.lowest_ratio << " to "
           << range_.highest_ratio << "). A higher weighing.high (now " << high_mA_ << ' ' << valve_.unit
           << ") lifts it further, a lower weighing.speed gives more samples";
      throw ControllerFailure(text.str());
    }
    sum_kg += one.sum_kg / one.samples;
  }
  const auto n = static_cast<double>(seen_.size());
  const double mean_kg = sum_kg / n;
  for (const Contraction& one : seen_) squares += std::pow(one.sum_kg / one.samples - mean_kg, 2);
  return {mean_kg, std::sqrt(squares / (n - 1.0))};
}

}  // namespace mckibben::controllers
