// Pressures of both sides, and what they make of the joint; see the header. The stiffness of nominal muscles
// at pressures that are kept, from T 2.8:
//   K = -d/dtheta R (F_1 - F_2) = sum of R^2/l0_i (-dF_i/de_i)
// and both forces are proportional to their pressures: K = c1 (P0 + dP) + c2 (P0 - dP).
#include <algorithm>
#include <stdexcept>

#include <controllers/co_contraction.hpp>

namespace mckibben::controllers {
namespace {

const PairKnowledge& pair_of(const Knowledge& known) {
  if (!known.pair) throw std::invalid_argument("co-contraction takes two muscles");
  return *known.pair;
}

}  // namespace

CoContraction::CoContraction(const JointTerms& terms, const Knowledge& known)
    : terms_(terms),
      known_(known),
      pair_(pair_of(known)),
      slope_Pa_per_mA_(known.valve.slope_Pa_per_mA()),
      middle_Pa_(0.0),
      now_Pa_(0.0) {
  const Pressures one = reach(known_.valve, std::nullopt), two = reach(pair_.opposite_valve, std::nullopt);
  const double lowest_Pa = std::max(one.lowest_Pa, two.lowest_Pa),
               highest_Pa = std::min(one.highest_Pa, two.highest_Pa);
  middle_Pa_ = 0.5 * (lowest_Pa + highest_Pa);
  width_mA_ = (highest_Pa - lowest_Pa) / slope_Pa_per_mA_;
  begin_tick(0, 0.0);
}

CoContraction::Pressures CoContraction::reach(const ValveLine& valve,
                                              const std::optional<double>& before_mA) const {
  CurrentRange range = working_range(valve, known_.largest_current_mA);
  if (before_mA && terms_.largest_current_speed_mA_per_s) {
    const double step_mA = *terms_.largest_current_speed_mA_per_s * known_.tick_s;
    range = {std::clamp(*before_mA - step_mA, range.lowest_mA, range.highest_mA),
             std::clamp(*before_mA + step_mA, range.lowest_mA, range.highest_mA)};
  }
  return {valve.pressure_Pa(range.lowest_mA), valve.pressure_Pa(range.highest_mA)};
}

// Where P0 lies between the means of what both sides can have at least and at most, some difference goes with
// it: each side's range for dP then reaches into the other's.
void CoContraction::begin_tick(std::int64_t tick, double difference_mA, double further_Pa) {
  std::optional<double> before_1_mA, before_2_mA;
  if (before_) before_1_mA = before_->current_mA, before_2_mA = before_->opposite_mA;
  const Pressures one = reach(known_.valve, before_1_mA), two = reach(pair_.opposite_valve, before_2_mA);
  now_Pa_ = std::clamp(wanted_Pa(tick, difference_mA) + further_Pa, 0.5 * (one.lowest_Pa + two.lowest_Pa),
                       0.5 * (one.highest_Pa + two.highest_Pa));
  const double lowest_Pa = std::max(one.lowest_Pa - now_Pa_, now_Pa_ - two.highest_Pa),
               highest_Pa = std::min(one.highest_Pa - now_Pa_, now_Pa_ - two.lowest_Pa);
  differences_ = {lowest_Pa / slope_Pa_per_mA_, std::max(lowest_Pa, highest_Pa) / slope_Pa_per_mA_};
}

double CoContraction::wanted_Pa(std::int64_t tick, double difference_mA) const {
  if (terms_.co_contraction_Pa) return *terms_.co_contraction_Pa;
  const auto wanted = wanted_N_m_per_rad(tick);
  if (!wanted) return middle_Pa_;
  const double ratio = known_.target_at(tick), c1 = of_muscle_1(ratio), c2 = of_muscle_2(ratio);
  return (*wanted - (c1 - c2) * slope_Pa_per_mA_ * difference_mA) / (c1 + c2);
}

Command CoContraction::command(double difference_mA) const {
  const double difference_Pa = slope_Pa_per_mA_ * difference_mA;
  const auto within = [&](double current_mA) { return std::min(current_mA, known_.largest_current_mA); };
  return {within(known_.valve.current_mA(now_Pa_ + difference_Pa)),
          within(pair_.opposite_valve.current_mA(now_Pa_ - difference_Pa))};
}

std::optional<double> CoContraction::wanted_N_m_per_rad(std::int64_t tick) const {
  const auto& wanted = pair_.stiffness_N_m_per_rad;
  if (wanted.empty()) return std::nullopt;
  const auto last = static_cast<std::int64_t>(wanted.size()) - 1;
  return wanted[static_cast<std::size_t>(std::clamp<std::int64_t>(tick, 0, last))];
}

double CoContraction::of_muscle_1(double ratio) const {
  const double radius_m = known_.wheel_radius_m, l0_m = known_.model.rest_length_m;
  return radius_m * radius_m / l0_m * known_.model.force_drop_N(pair_.mounted_ratio + ratio, 1.0);
}

double CoContraction::of_muscle_2(double ratio) const {
  const double radius_m = known_.wheel_radius_m, l0_m = pair_.opposite.rest_length_m;
  const double stretched = ratio * known_.model.rest_length_m / l0_m;
  return radius_m * radius_m / l0_m *
         pair_.opposite.force_drop_N(pair_.opposite_mounted_ratio - stretched, 1.0);
}

}  // namespace mckibben::controllers
