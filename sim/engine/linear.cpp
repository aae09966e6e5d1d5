// Seeds state, memories and what is held, and reads off the slopes; see the header.
#include <algorithm>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

#include <sim/engine/jacobian.hpp>
#include <sim/engine/linear.hpp>

namespace mckibben::engine {
namespace {

/// A memory that a rig may have, and by how much the number that integrators carry is to be multiplied.
struct Remembered {
  Signal signal;
  double size = 1.0;
};

/// Of one side, by their places among all that it remembers.
std::vector<Remembered> memories_of(const plant::SideOf<double>& side, const std::string& suffix) {
  using plant::Effects;
  std::vector<Remembered> all(plant::all_memories);
  const Effects& effects = side.rig().effects;
  std::size_t next = 0;
  const auto add = [&]<class E>(const E&) {
    const std::string name(E::name);
    if constexpr (plant::Remembers<E>) all[next++] = {{name + suffix, std::string(E::memory_unit)}};
    if constexpr (plant::RemembersMore<E>)
      for (std::size_t i = 0; i < E::further_memories; ++i)
        all[Effects::further_from<E> + i] = {
            {fmt::format("{}_{}{}", name, i + 2, suffix), std::string(E::memory_unit)}};
  };
  std::apply([&](const auto&... effect) { (add(effect), ...); }, effects.all);
  all[plant::regulator_memory] = {{"regulator_error" + suffix + "_Pa", "Pa"}};
  std::fill_n(&all[Effects::from_laws], plant::law_slots, Remembered{{"time" + suffix + "_s", "s"}});
  for (const auto& law : effects.laws.list) {
    if (law.absent()) continue;
    for (std::size_t i = 0; i < law.text->memories.size(); ++i) {
      const auto& memory = law.text->memories[i];
      all[Effects::from_laws + law.place + i] = {{law.text->name + "." + memory.name + suffix, memory.unit},
                                                 memory.size};
    }
  }
  all[plant::cord_stretch] = {{"cord_stretch" + suffix + "_m", "m"}};
  all[plant::cord_end_speed] = {{"cord_end_speed" + suffix + "_m_per_s", "m s-1"}};
  return all;
}

template <class L>
class Linearising {
  static constexpr int held_inputs = 2 * L::sides;
  using Seeds = Unknowns<L, held_inputs>;
  using Number = typename Seeds::Number;

 public:
  Linearising(const plant::Plant& plant, const Flow& at, const plant::Held& held,
              const std::array<double, 2>& current_mA)
      : plant_(plant), current_mA_(current_mA) {
    differentiate(at, held);
    drop_unused();
  }

  Linear result;

 private:
  using Index = Eigen::Index;

  static std::string suffix(int side) { return L::sides == 1 ? "" : "_" + std::to_string(side + 1); }
  const plant::SideOf<double>& side(int i) const { return i == 0 ? plant_.side() : *plant_.opposite(); }

  void differentiate(const Flow& at, const plant::Held& held) {
    std::array<double, L::size> y;
    Problem<L>::store(at, y.data());
    Seeds seeds(at.state, y.data());
    plant::HeldOf<Number> inputs;
    inputs.slip = held.slip;
    const auto seed = [&](const plant::HeldSide& given, plant::HeldSideOf<Number>& seeded) {
      seeded.reference_pressure_Pa = seeds.next(given.reference_pressure_Pa);
      seeded.current_speed_mA_per_s = seeds.next(given.current_speed_mA_per_s);
      seeded.fills = Number(given.fills);
      seeded.vents = Number(given.vents);
    };
    seed(held, inputs);
    if constexpr (L::sides == 2) seed(held.opposite, inputs.opposite);
    auto now = plant_.template moment<L::sides>(seeds.state, seeds.memory, inputs);
    if (!plant_.remembers()) now.memory_rates.fill(Number(0.0));
    const auto rates = plant_.template rates<L::sides>(seeds.state, now);

    constexpr Index states = L::steering, count = held_inputs + 1, outputs = 1 + 2 * L::sides;
    result.states.resize(states);
    result.inputs.resize(count);
    result.state = result.rate = Eigen::VectorXd::Zero(states);
    result.input = Eigen::VectorXd::Zero(count);
    result.output = Eigen::VectorXd::Zero(outputs);
    result.A = Eigen::MatrixXd::Zero(states, states);
    result.B = Eigen::MatrixXd::Zero(states, count);
    result.C = Eigen::MatrixXd::Zero(outputs, states);
    result.D = Eigen::MatrixXd::Zero(outputs, count);

    state({"contraction_ratio", "1"}, seeds.state.joint.contraction_ratio, rates.joint.contraction_ratio);
    state({"contraction_speed_per_s", "s-1"}, seeds.state.joint.contraction_speed_per_s,
          rates.joint.contraction_speed_per_s);
    output(L::sides == 1 ? Signal{"contraction_ratio", "1"} : Signal{"angle_rad", "rad"},
           position(seeds.state));
    of_side(0, seeds.state.side, rates.side, seeds.memory.side, now);
    if constexpr (L::sides == 2)
      of_side(1, seeds.state.opposite, rates.opposite, seeds.memory.opposite, now.opposite);
    inputs_of_side(0, held, inputs);
    if constexpr (L::sides == 2) inputs_of_side(1, held.opposite, inputs.opposite);
    result.inputs.back() = L::sides == 1 ? Signal{"load_force_N", "N"} : Signal{"torque_N_m", "N m"};
    const double arm_m = L::sides == 1 ? 1.0 : plant_.rig().joint.wheel_radius_m;  // of a torque
    result.B(place(seeds.state.joint.contraction_speed_per_s), held_inputs) =
        1.0 /
        (plant_.moved_kg(at.state.joint.contraction_ratio) * arm_m * plant_.side().braid().rest_length_m());
  }

  void of_side(int i, const plant::SideState<Number>& at, const plant::SideState<Number>& rates,
               const plant::SideMemory<Number>& memory, const plant::SideMoment<Number>& now) {
    const std::string s = suffix(i);
    state({"valve_pressure" + s + "_Pa", "Pa"}, at.valve_pressure_Pa, rates.valve_pressure_Pa);
    state({"muscle_pressure" + s + "_Pa", "Pa"}, at.muscle_pressure_Pa, rates.muscle_pressure_Pa);
    state({"bristle" + s + "_m", "m"}, at.bristle_m, rates.bristle_m);
    output({"muscle_pressure" + s + "_Pa", "Pa"}, at.muscle_pressure_Pa);
    output({(L::sides == 1 ? "force" : "tension") + s + "_N", "N"}, now.cord_force_N());
    const std::vector<Remembered> remembered = memories_of(side(i), s);
    for (std::size_t k = 0; k < remembered.size(); ++k)
      state(remembered[k].signal, memory[k], now.memory_rates[k], remembered[k].size);
  }

  /// From the pressure that the valve follows to the current.
  void inputs_of_side(int i, const plant::HeldSide& held, const plant::HeldSideOf<Number>& seeded) {
    const auto named = [&](const std::string& text) { return in_unit(plant_.rig().command_unit(), text); };
    const double current_mA = current_mA_[static_cast<std::size_t>(i)];
    input({named("current" + suffix(i) + "_mA"), named("mA")}, seeded.reference_pressure_Pa, current_mA,
          side(i).reference_slope_Pa_per_mA(current_mA));
    input({named("current_speed" + suffix(i) + "_mA_per_s"), named("mA s-1")}, seeded.current_speed_mA_per_s,
          held.current_speed_mA_per_s);
  }

  // One of each: its name, its value and its slopes.

  void state(const Signal& name, const Number& seeded, const Number& rate, double size = 1.0) {
    const Index at = place(seeded);
    result.states[static_cast<std::size_t>(at)] = name;
    result.state[at] = seeded.value;
    result.rate[at] = rate.value;
    sizes_[at] = size;
    put(rate, at, result.A, result.B);
  }

  void output(const Signal& name, const Number& value) {
    const auto at = static_cast<Index>(result.outputs.size());
    result.outputs.push_back(name);
    result.output[at] = value.value;
    put(value, at, result.C, result.D);
  }

  /// `slope`: of what was seeded in its place.
  void input(const Signal& name, const Number& seeded, double value, double slope = 1.0) {
    const Index at = place(seeded) - L::steering;
    result.inputs[static_cast<std::size_t>(at)] = name;
    result.input[at] = value;
    result.B.col(at) *= slope;
    result.D.col(at) *= slope;
  }

  /// Of an unknown among all.
  static Index place(const Number& unknown) {
    Index at = 0;
    unknown.slopes.maxCoeff(&at);
    return at;
  }

  static void put(const Number& value, Index row, Eigen::MatrixXd& by_state, Eigen::MatrixXd& by_input) {
    by_state.row(row) = value.slopes.template head<L::steering>().transpose();
    by_input.row(row).template head<held_inputs>() = value.slopes.template tail<held_inputs>().transpose();
  }

  Number position(const plant::State<Number>& state) const {
    if constexpr (L::sides == 1) return state.joint.contraction_ratio;
    return (state.joint.contraction_ratio - plant_.link().contraction_ratio) *
           (plant_.side().braid().rest_length_m() / plant_.rig().joint.wheel_radius_m);
  }

  /// Memories of what is not at work neither move nor do anything.
  void drop_unused() {
    std::vector<Eigen::Index> kept;
    std::vector<Signal> names;
    for (Eigen::Index i = 0; i < L::steering; ++i) {
      const bool memory = i >= L::states;
      const bool used = !memory || result.rate[i] != 0.0 || !result.A.row(i).isZero(0.0) ||
                        !result.A.col(i).isZero(0.0) || !result.C.col(i).isZero(0.0);
      if (!used) continue;
      kept.push_back(i);
      names.push_back(result.states[static_cast<std::size_t>(i)]);
    }
    result.states = names;
    const Eigen::VectorXd inverse = sizes_.cwiseInverse();
    result.A = (sizes_.asDiagonal() * result.A * inverse.asDiagonal())(kept, kept).eval();
    result.B = (sizes_.asDiagonal() * result.B)(kept, Eigen::all).eval();
    result.C = (result.C * inverse.asDiagonal())(Eigen::all, kept).eval();
    result.state = result.state.cwiseProduct(sizes_)(kept).eval();
    result.rate = result.rate.cwiseProduct(sizes_)(kept).eval();
  }

  const plant::Plant& plant_;
  std::array<double, 2> current_mA_;
  Eigen::VectorXd sizes_ = Eigen::VectorXd::Ones(L::steering);  ///< of states
};

}  // namespace

Linear linearise(const plant::Plant& plant, const Flow& at, const plant::Held& held,
                 const std::array<double, 2>& current_mA) {
  constexpr auto none = plant::GivenPressure::none;
  if (held.length_is_given || held.given != none || held.opposite.given != none)
    throw std::invalid_argument("linearise: a pressure or the length is given; it wants currents alone");
  if (plant.has_events() && held.slip == plant::Slip::sticking)
    throw std::invalid_argument("linearise: the load sticks (Coulomb friction), and has no slopes");
  if (!plant.in_domain(at.state, at.memory))
    throw std::invalid_argument("linearise: outside the domain of the laws");
  // Only the calculation of one kind of rig has to be compiled for each number of muscles: what is not at
  // work is dropped.
  if (plant.opposite())
    return Linearising<Layout<2, plant::Memories::all, Books::none>>(plant, at, held, current_mA).result;
  return Linearising<Layout<1, plant::Memories::all, Books::none>>(plant, at, held, current_mA).result;
}

}  // namespace mckibben::engine
