// What of the plant needs no dual numbers: constants, start, domain, stick and slip, balances for audits.
#include <algorithm>

#include <plant/plant.hpp>

namespace mckibben::plant {

template <class P>
State<double> PlantOf<P>::at_rest(const HeldOf<P>& held) const {
  const auto full = [](const HeldSide& side) {
    return SideState<double>{side.reference_pressure_Pa, side.reference_pressure_Pa, 0.0};
  };
  const double length_m = side_.braid().rest_length_m();
  const double stands_m = std::clamp(0.0, lowest_m_, std::max(lowest_m_, highest_m_));
  return {{stops_ ? mounted_ + stands_m / length_m : mounted_, 0.0}, full(held), full(held.opposite)};
}

template <class P>
double PlantOf<P>::event_margin(const State<double>& state, const Memory<double>& memory,
                                const HeldOf<P>& held) const {
  // Break-away margin while sticking (a guard on the speed would rest at zero). While slipping the speed,
  // with a little to spare: a load that starts from rest the wrong
  // way would begin at zero and never cross it.
  constexpr double spare_per_s = 1e-9;
  if (held.length_is_given) return spare_per_s;  // the bench decides
  if (held.slip == Slip::rising) return spare_per_s + state.joint.contraction_speed_per_s;
  if (held.slip == Slip::falling) return spare_per_s - state.joint.contraction_speed_per_s;
  const auto now = moment(state, memory, held);
  return friction_level_N(now) - std::abs(friction_force_N(now));
}

template <class P>
Slip PlantOf<P>::slip_from_rest(State<double>& state, const Memory<double>& memory,
                                const HeldOf<P>& held) const {
  state.joint.contraction_speed_per_s = 0.0;
  Held stuck = held;
  stuck.slip = Slip::sticking;
  const auto now = moment(state, memory, stuck);
  const double pulled_N = -friction_force_N(now);  // all other forces
  // An event is located to rounding only: a margin that is zero but for that means the load has broken away.
  const bool holds = std::abs(pulled_N) < friction_level_N(now) * (1.0 - 1e-9);
  if (holds) return Slip::sticking;
  return pulled_N > 0.0 ? Slip::rising : Slip::falling;
}

template <class P>
void PlantOf<P>::take_speed(double speed_per_s, State<double>& state, Ledger<double>& books) const {
  const double before_J = mechanical_energy_J(state);
  state.joint.contraction_speed_per_s = speed_per_s;
  books.bench_work_J += mechanical_energy_J(state) - before_J;
}

template <class P>
std::string_view PlantOf<P>::law_without_number(const State<double>& state) const {
  const double e = state.joint.contraction_ratio, w = state.joint.contraction_speed_per_s;
  for (const double off : {0.0, 1e-6, -1e-6, 1e-4, -1e-4}) {
    const std::string_view here = side_.law_without_number({e + off, w + off}, state.side);
    if (!here.empty()) return here;
    if (!opposite_) continue;
    const Stroke<double> other = opposite_stroke(state);
    const std::string_view there = opposite_->law_without_number(
        {other.contraction_ratio + off, other.speed_per_s + off}, state.opposite);
    if (!there.empty()) return there;
  }
  return {};
}

template <class P>
double PlantOf<P>::gas_mass_kg(const State<double>& state, const Memory<double>& memory) const {
  const double one_kg = side_.air_kg(joint_stroke(state), state.side, memory.side);
  return opposite_ ? one_kg + opposite_->air_kg(opposite_stroke(state), state.opposite, memory.opposite)
                   : one_kg;
}

template <class P>
double PlantOf<P>::mechanical_energy_J(const State<double>& state, const Memory<double>& memory) const {
  const auto cord_J = [](const SideOf<P>& side, const SideMemory<double>& of) {
    return side.rig().muscle.cord.energy_J(of[cord_stretch], of[cord_end_speed]);
  };
  double cords_J = cord_J(side_, memory.side);
  if (opposite_) cords_J += cord_J(*opposite_, memory.opposite);
  const double length = side_.braid().rest_length_m();
  const double speed = length * state.joint.contraction_speed_per_s;
  const double rise = rise_m(state.joint.contraction_ratio);
  if (lever_) {
    const Stand<double> stand = turning_->at(rise);
    const double turning = speed / stand.arm_m;
    return cords_J + 0.5 * (mass_kg_ * speed * speed + inertia_kg_m2_ * turning * turning) +
           lever_->spring().energy_J(stand.angle_rad) +
           weight_moment_N_m_ * (1.0 - std::cos(stand.angle_rad - lever_->hangs_at_rad));
  }
  const double moving_J = cords_J + 0.5 * mass_kg_ * speed * speed + rig().joint.spring().energy_J(rise);
  if (!opposite_) return moving_J + weight_N() * length * state.joint.contraction_ratio;
  const double lean_rad = angle_rad(state.joint.contraction_ratio) - link_.hangs_at_rad;
  return moving_J + link_.mass_kg * gravity_m_per_s2 * link_.length_m * (1.0 - std::cos(lean_rad));
}

template <class P>
Ledger<double> PlantOf<P>::opened(const State<double>& state, const Memory<double>& memory) const {
  Ledger<double> books{};
  books.valve_air_kg = side_.valve_air_kg(state.side);
  books.muscle_air_kg = side_.air_kg(joint_stroke(state), state.side, memory.side) - books.valve_air_kg;
  if (opposite_) {
    books.opposite_valve_air_kg = opposite_->valve_air_kg(state.opposite);
    books.opposite_muscle_air_kg =
        opposite_->air_kg(opposite_stroke(state), state.opposite, memory.opposite) -
        books.opposite_valve_air_kg;
  }
  return books;
}

template <class P>
Imbalance PlantOf<P>::imbalance(const State<double>& from, const State<double>& to,
                                const Ledger<double>& books, const Memory<double>& memory_from,
                                const Memory<double>& memory_to) const {
  const double first_kg = gas_mass_kg(from, memory_from), last_kg = gas_mass_kg(to, memory_to);
  const double all_kg = first_kg + books.air_drawn_kg;
  const double net_kg = books.air_drawn_kg - books.air_vented_kg - books.air_leaked_kg;
  double lost_kg = net_kg - (last_kg - first_kg);
  if (polytropic_) {
    // p V changes by n R T of what flows in, by (1 - n) of the work done and by what the muscle's temperature
    // adds; what flows is mass as well.
    const double n = rig().effects.gas_exponent();
    lost_kg = (n * books.air_inflow_J - (n - 1.0) * books.gas_work_J + books.gas_heat_J) /
                  side_.gas_energy_J_per_kg() -
              (last_kg - first_kg);
    const double missing_kg =
        net_kg - (books.valve_air_kg + books.muscle_air_kg + books.opposite_valve_air_kg +
                  books.opposite_muscle_air_kg - first_kg);
    lost_kg = std::max(std::abs(lost_kg), std::abs(missing_kg));
  }

  const double lost_J = books.braid_work_J + books.stop_work_J + books.effects_work_J -
                        books.thread_friction_work_J - books.guide_work_J + books.bench_work_J -
                        (mechanical_energy_J(to, memory_to) - mechanical_energy_J(from, memory_from));
  // A load that hardly moved did no work to speak of: count at least that of a hundredth of the length.
  const double hanging_N = opposite_ ? link_.mass_kg * gravity_m_per_s2
                           : lever_  ? weight_moment_N_m_ / turning_->at(0.0).arm_m
                                     : weight_N();
  const double least_J = 0.01 * hanging_N * side_.braid().rest_length_m();
  const double work_J = std::abs(books.braid_work_J) + std::abs(books.stop_work_J) +
                        std::abs(books.effects_work_J) + std::abs(books.thread_friction_work_J) +
                        std::abs(books.guide_work_J) + std::abs(books.bench_work_J);
  const double whole_J = std::max(work_J, least_J);  // 0 where nothing hangs and nothing moved
  return {std::abs(lost_kg) / all_kg, whole_J > 0.0 ? std::abs(lost_J) / whole_J : 0.0};
}

template class PlantOf<double>;

}  // namespace mckibben::plant
