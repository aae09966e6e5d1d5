// Settles, takes both sides of each kink, and does away with bristles; see the header.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include <controllers/current_range.hpp>
#include <sim/linear/point.hpp>
#include <sim/linear/rest.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::linear {
namespace {

using engine::Linear;

// So little that it only says on which side of a kink the rig stands; a valve that feeds a leak is open by
// more.
constexpr double hardly_per_s = 1e-100, hardly_open = 1e-4;

/// Where the rig stands, a hair beyond its kinks: load moving up or down, valves filling or venting.
Linear beside(const ride::Ride& ride, const std::array<double, 2>& commands, double way, double opens) {
  const plant::Plant& plant = ride.plant();
  engine::Flow flow = ride.flow();
  plant::Held held = ride.held();
  flow.state.joint.contraction_speed_per_s = way * hardly_per_s;
  flow.memory.side[plant::cord_end_speed] = way * hardly_per_s;
  flow.memory.opposite[plant::cord_end_speed] = -way * hardly_per_s;
  held.slip = way > 0.0 ? plant::Slip::rising : plant::Slip::falling;
  const auto open = [&](const plant::SideMoment<double>& now, const plant::Side& side,
                        const plant::SideState<double>& state, plant::SideMemory<double>& memory,
                        plant::HeldSide& of_side) {
    if (std::abs(now.valve_opening) > hardly_open) return;
    of_side.reference_pressure_Pa = state.valve_pressure_Pa + opens * hardly_Pa;
    if (!side.rig().effects.get<plant::ValveLag>().absent()) memory[lag_slot] = opens * hardly_open * 1e-6;
  };
  const plant::Moment<double> now = ride.moment();
  open(now, plant.side(), flow.state.side, flow.memory.side, held);
  if (plant.opposite())
    open(now.opposite, *plant.opposite(), flow.state.opposite, flow.memory.opposite, held.opposite);
  return engine::linearise(plant, flow, held, commands);
}

Eigen::Index index_of(const std::vector<engine::Signal>& signals, const std::string& name) {
  const auto found = std::ranges::find(signals, name, &engine::Signal::name);
  return found == signals.end() ? -1 : found - signals.begin();
}

/// With a row and a column of zeros for each state that only `other` has.
Linear with_states_of(Linear one, const Linear& other) {
  for (std::size_t i = 0; i < other.states.size(); ++i) {
    if (index_of(one.states, other.states[i].name) >= 0) continue;
    const Eigen::Index n = one.A.rows();
    one.A.conservativeResizeLike(Matrix::Zero(n + 1, n + 1));
    one.B.conservativeResizeLike(Matrix::Zero(n + 1, one.B.cols()));
    one.C.conservativeResizeLike(Matrix::Zero(one.C.rows(), n + 1));
    one.state.conservativeResizeLike(Eigen::VectorXd::Zero(n + 1));
    one.rate.conservativeResizeLike(Eigen::VectorXd::Zero(n + 1));
    one.states.push_back(other.states[i]);
  }
  return one;
}

Linear mean(const Linear& a, const Linear& b) {
  Linear one = with_states_of(a, b);
  const Linear other = with_states_of(b, a);
  std::vector<Eigen::Index> order;
  for (const auto& state : one.states) order.push_back(index_of(other.states, state.name));
  one.A = 0.5 * (one.A + other.A(order, order));
  one.B = 0.5 * (one.B + other.B(order, Eigen::all));
  one.C = 0.5 * (one.C + other.C(Eigen::all, order));
  one.state = 0.5 * (one.state + other.state(order));
  return one;
}

void keep(Linear& linear, const std::vector<Eigen::Index>& states) {
  std::vector<engine::Signal> names;
  for (const Eigen::Index i : states) names.push_back(linear.states[static_cast<std::size_t>(i)]);
  linear.states = names;
  linear.A = linear.A(states, states).eval();
  linear.B = linear.B(states, Eigen::all).eval();
  linear.C = linear.C(Eigen::all, states).eval();
  linear.state = linear.state(states).eval();
}

/// A bristle becomes a spring between threads, or goes.
void without_bristle(Linear& linear, const plant::Side& side, const std::string& suffix, double length_m,
                     Threads threads) {
  const Eigen::Index z = index_of(linear.states, "bristle" + suffix + "_m");
  const plant::Friction& friction = side.rig().friction;
  if (friction.memory == plant::FrictionMemory::lugre && threads == Threads::sticking) {
    linear.A.col(0) += length_m * linear.A.col(z);
    linear.C.col(0) += length_m * linear.C.col(z);
    const Eigen::Index stretch = index_of(linear.states, "cord_stretch" + suffix + "_m");
    if (stretch >= 0) linear.A.col(stretch) += linear.A.col(z);
  } else if (friction.memory == plant::FrictionMemory::lugre) {
    const double damping_s = friction.bristle_damping_N_s_per_m / friction.bristle_stiffness_N_per_m;
    const Eigen::RowVectorXd rate = linear.A.row(z);
    for (Eigen::Index i = 0; i < linear.A.rows(); ++i)
      if (i != z) linear.A.row(i) -= damping_s * linear.A(i, z) * rate;
  }
  std::vector<Eigen::Index> others;
  for (Eigen::Index i = 0; i < linear.A.rows(); ++i)
    if (i != z) others.push_back(i);
  keep(linear, others);
}

/// By how much the speeds slow down for each m/s over the friction [N] and the mass that it acts on.
Matrix dry_friction(const plant::Plant& plant, const plant::Moment<double>& now, double ratio,
                    const Linear& linear) {
  Matrix dry = Matrix::Zero(linear.A.rows(), linear.A.cols());
  dry(1, 1) =
      plant.rig().effects.get<plant::GuideFriction>().coefficient * plant.weight_N() / plant.moved_kg(ratio);
  const auto add = [&](const plant::Side& side, double level_N, const std::string& suffix) {
    const Eigen::Index end = index_of(linear.states, "cord_end_speed" + suffix + "_m_per_s");
    if (end >= 0)
      dry(end, end) += level_N / side.rig().muscle.cord.end_mass_kg;
    else
      dry(1, 1) += level_N / plant.moved_kg(ratio);
  };
  add(plant.side(), now.friction_level_N, plant.opposite() ? "_1" : "");
  if (plant.opposite()) add(*plant.opposite(), now.opposite.friction_level_N, "_2");
  return dry;
}

/// What is of interest: commands in, position and muscle pressures out.
void name_ends(Linear& linear, bool angle, double angle_per_ratio) {
  std::vector<Eigen::Index> inputs{0}, outputs{0, 1};
  if (linear.inputs.size() > 3) {
    inputs.push_back(2);
    outputs.push_back(3);
  } else if (angle) {  // a pair's is one already
    linear.C.row(0) *= angle_per_ratio;
    linear.outputs[0] = {"angle_rad", "rad"};
  }
  const auto pick = [](auto& signals, const std::vector<Eigen::Index>& kept) {
    std::vector<engine::Signal> some;
    for (const Eigen::Index i : kept) some.push_back(signals[static_cast<std::size_t>(i)]);
    signals = some;
  };
  pick(linear.inputs, inputs);
  pick(linear.outputs, outputs);
  linear.B = linear.B(Eigen::all, inputs).eval();
  linear.D = linear.D(outputs, inputs).eval();
  linear.C = linear.C(outputs, Eigen::all).eval();
  linear.input = linear.input(inputs).eval();
  linear.output = linear.output(outputs).eval();
}

/// What a place is given by, as messages tell it.
struct Shown {
  const char *named, *unit;
  double size;  ///< of the unit
};

/// The command that brings `what` of the settled rig to a value, between the ends of what the valve answers
/// to.
double command_for(const plant::Rig& rig, double load_kg, double value, const Shown& as, const auto& what) {
  const auto range = controllers::working_range(run::knowledge_of(rig, {}));
  const auto reached = [&](double current_mA) {
    return what(Settled(rig, load_kg, commands_of(rig, current_mA)));
  };
  double low = range.lowest_mA, high = range.highest_mA;
  const double lowest = reached(low), highest = reached(high);
  if (!(lowest <= value && value <= highest))
    throw OutOfReach(fmt::format("a {} of {:.4g}{} is out of reach: commands give {:.4g} to {:.4g}{}",
                                 as.named, value / as.size, as.unit, lowest / as.size, highest / as.size,
                                 as.unit));
  for (int i = 0; i < 36; ++i) {
    const double middle = 0.5 * (low + high);
    (reached(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double command_at(const plant::Rig& rig, double load_kg, const Place& place) {
  const auto range = controllers::working_range(run::knowledge_of(rig, {}));
  switch (place.of) {
    case Place::Of::middle:
      return 0.5 * (range.lowest_mA + range.highest_mA);
    case Place::Of::command:
      if (place.value < range.lowest_mA || place.value > range.highest_mA)
        throw OutOfReach(fmt::format("the valve answers to commands from {:g} to {:g} {}, not to {:g}",
                                     range.lowest_mA, range.highest_mA, name_of(rig.command_unit()),
                                     place.value));
      return place.value;
    case Place::Of::pressure:
      return command_for(rig, load_kg, place.value, {"muscle pressure", " bar", plant::Pa_per_bar},
                         [](const Settled& at) { return at.state().side.muscle_pressure_Pa; });
    case Place::Of::position:
      break;
  }
  return command_for(
      rig, load_kg, place.value,
      rig.has_angle() ? Shown{"joint angle", " deg", plant::degree_rad} : Shown{"contraction ratio", "", 1.0},
      [](const Settled& at) { return at.position(); });
}

/// How late the position is read, over many ticks.
double mean_delay_s(const plant::Rig& rig) {
  constexpr int ticks = 1000;
  double sum_s = 0.0;
  for (int k = 0; k < ticks; ++k) sum_s += rig.sensors.position().late_s(k * rig.tick_s);
  return rig.effects.reading_delay_s() + sum_s / ticks;
}

void require_slopes(const plant::Rig& rig, Threads threads) {
  if (rig.valve.seals() || rig.valve.is_on_off())
    throw std::invalid_argument(
        "its valve keeps no pressure that follows a command: there is nothing linear");
  if (threads == Threads::sticking && rig.friction.memory == plant::FrictionMemory::coulomb)
    throw std::invalid_argument(
        "threads of friction.memory: coulomb that stick do not move at all: take sliding");
}

}  // namespace

controllers::Command commands_of(const plant::Rig& rig, double current_mA) {
  if (rig.pair() == nullptr) return {current_mA};
  const controllers::Knowledge known = run::knowledge_of(rig, {});
  const controllers::ValveLine &one = known.valve, &two = known.pair->opposite_valve;
  const double middle_Pa = 0.5 * (std::max(one.zero_pressure_Pa, two.zero_pressure_Pa) +
                                  std::min(one.span_pressure_Pa, two.span_pressure_Pa));
  return {current_mA, two.current_mA(2.0 * middle_Pa - one.pressure_Pa(current_mA))};
}

Point point_at(const plant::Rig& described, double load_kg, const Place& place, Threads threads,
               Opening opening) {
  require_slopes(described, threads);
  plant::Rig rig = described;  // at rest inside a dead band nothing that is small would act
  const auto without_band = [](plant::Valve& valve, plant::Effects& effects) {
    valve.dead_band_Pa = 0.0;
    effects.get<plant::ValveDeadBand>() = {};
  };
  without_band(rig.valve, rig.effects);
  if (plant::Pair* pair = rig.pair()) without_band(pair->opposite.valve, pair->opposite.effects);
  Point point;
  point.load_kg = load_kg;
  const plant::Rig loose = without_friction(rig);
  point.command = commands_of(rig, command_at(loose, load_kg, place));
  plant::Rig smooth = rig;  // a load guide that slides pulls as it pulls, too
  if (threads == Threads::sliding) smooth.effects.get<plant::GuideFriction>() = {};
  const Settled at(loose, load_kg, point.command);
  const std::array commands{point.command.current_mA, point.command.opposite_mA};
  ride::Ride ride({rig, load_kg}, rig.integrator);
  ride.rider().now = at.ride().rider().now;
  ride.rider().now.flow.state.side.bristle_m = ride.rider().now.flow.state.opposite.bristle_m = 0.0;
  point.settled = calm(ride, commands) && at.settled;
  const plant::Plant& plant = ride.plant();
  const plant::State<double>& state = ride.flow().state;
  const plant::Moment<double> now = ride.moment();
  point.position = at.position();
  point.pressure_Pa = {state.side.muscle_pressure_Pa, state.opposite.muscle_pressure_Pa};
  point.has_angle = plant.has_angle();
  point.on_stop = now.stop_force_N > 0.0 || now.joint_stop_force_N != 0.0;
  const auto is_shut = [](const plant::Valve& valve, const plant::SideMoment<double>& moment) {
    return std::abs(moment.valve_opening) <= hardly_open && valve.is_servo();
  };
  point.shut = is_shut(rig.valve, now) || (rig.pair() && is_shut(rig.pair()->opposite.valve, now.opposite));

  ride::Ride sliding({smooth, load_kg}, smooth.integrator);
  sliding.rider().now = ride.rider().now;
  const double first = opening == Opening::venting ? -1.0 : 1.0,
               second = opening == Opening::filling ? 1.0 : -1.0;
  Linear& slopes = point.slopes =
      mean(beside(sliding, commands, 1.0, first), beside(sliding, commands, -1.0, second));
  const double l0 = plant.side().braid().rest_length_m(), arm_m = plant.arm_m(state.joint.contraction_ratio);
  if (plant.opposite()) {
    without_bristle(slopes, plant.side(), "_1", l0, threads);
    without_bristle(slopes, *plant.opposite(), "_2", -l0, threads);
  } else {
    without_bristle(slopes, plant.side(), "", l0, threads);
  }
  point.dry = threads == Threads::sliding ? dry_friction(plant, now, state.joint.contraction_ratio, slopes)
                                          : Matrix::Zero(slopes.A.rows(), slopes.A.cols());
  name_ends(slopes, point.has_angle, l0 / arm_m);
  point.direction = Eigen::VectorXd::Ones(slopes.B.cols());
  if (plant.opposite())
    point.direction[1] = -plant.side().reference_slope_Pa_per_mA(commands[0]) /
                         plant.opposite()->reference_slope_Pa_per_mA(commands[1]);
  const double guide_N = rig.effects.get<plant::GuideFriction>().coefficient * plant.weight_N();
  point.friction_N =
      guide_N + now.friction_level_N + (plant.opposite() ? now.opposite.friction_level_N : 0.0);
  point.shown = rig.effects.get<plant::EncoderScale>().reading_factor();
  point.command_delay_s = rig.effects.command_delay_s();
  point.reading_delay_s = mean_delay_s(rig);
  return point;
}

Point Point::swinging(double speed_m_per_s) const {
  Point point = *this;
  point.slopes.A -= 4.0 / (std::numbers::pi * speed_m_per_s) * dry;
  point.dry.setZero();
  return point;
}

Eigen::VectorXd Point::sizes() const {
  Eigen::VectorXd all = Eigen::VectorXd::Ones(slopes.A.rows());
  for (std::size_t i = 0; i < slopes.states.size(); ++i)
    if (slopes.states[i].unit == "Pa") all[static_cast<Eigen::Index>(i)] = 1e5;
  return all;
}

System Point::system(Eigen::Index output) const {
  const Eigen::VectorXd size = sizes(), inverse = size.cwiseInverse();
  return {inverse.asDiagonal() * slopes.A * size.asDiagonal(), inverse.asDiagonal() * slopes.B * direction,
          slopes.C.row(output) * size.asDiagonal(), Matrix::Zero(1, 1)};
}

}  // namespace mckibben::linear
