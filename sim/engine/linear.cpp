// Seeds state, memories and what is held, and reads off the slopes; see the header.
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

/// Of one side, in the order in which integrators carry them.
std::vector<Remembered> memories_of(const plant::SideOf<double>& side, const std::string& suffix) {
  std::vector<Remembered> all;
  const auto add = [&]<class E>(const E&) {
    if constexpr (plant::Remembers<E>)
      all.push_back({{std::string(E::name) + suffix, std::string(E::memory_unit)}});
  };
  const plant::Effects& effects = side.rig().effects;
  std::apply([&](const auto&... effect) { (add(effect), ...); }, effects.all);
  all.push_back({{"regulator_error" + suffix + "_Pa", "Pa"}});
  const auto add_further = [&]<class E>(const E&) {
    if constexpr (plant::RemembersMore<E>)
      for (std::size_t i = 0; i < E::further_memories; ++i)
        all.push_back({{fmt::format("{}_{}{}", E::name, i + 2, suffix), std::string(E::memory_unit)}});
  };
  std::apply([&](const auto&... effect) { (add_further(effect), ...); }, effects.all);
  const std::size_t laws = all.size();
  all.resize(laws + plant::law_slots, {{"time" + suffix + "_s", "s"}});
  for (const auto& law : effects.laws.list) {
    if (law.absent()) continue;
    for (std::size_t i = 0; i < law.text->memories.size(); ++i) {
      const auto& memory = law.text->memories[i];
      all[laws + law.place + i] = {{law.text->name + "." + memory.name + suffix, memory.unit}, memory.size};
    }
  }
  all.push_back({{"cord_stretch" + suffix + "_m", "m"}});
  all.push_back({{"cord_end_speed" + suffix + "_m_per_s", "m s-1"}});
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
    name();
    differentiate(at, held);
    drop_unused();
  }

  Linear result;

 private:
  static std::string suffix(int side) { return L::sides == 1 ? "" : "_" + std::to_string(side + 1); }
  const plant::SideOf<double>& side(int i) const { return i == 0 ? plant_.side() : *plant_.opposite(); }

  void name() {
    result.states = {{"contraction_ratio", "1"}, {"contraction_speed_per_s", "s-1"}};
    result.outputs = {L::sides == 1 ? Signal{"contraction_ratio", "1"} : Signal{"angle_rad", "rad"}};
    for (int i = 0; i < L::sides; ++i) {
      const std::string s = suffix(i);
      result.states.push_back({"valve_pressure" + s + "_Pa", "Pa"});
      result.states.push_back({"muscle_pressure" + s + "_Pa", "Pa"});
      result.states.push_back({"bristle" + s + "_m", "m"});
      const auto named = [&](const std::string& text) { return in_unit(plant_.rig().command_unit(), text); };
      result.inputs.push_back({named("current" + s + "_mA"), named("mA")});
      result.inputs.push_back({named("current_speed" + s + "_mA_per_s"), named("mA s-1")});
      result.outputs.push_back({"muscle_pressure" + s + "_Pa", "Pa"});
      result.outputs.push_back({(L::sides == 1 ? "force" : "tension") + s + "_N", "N"});
    }
    for (int i = 0; i < L::sides; ++i)
      for (const Remembered& memory : memories_of(side(i), suffix(i))) {
        result.states.push_back(memory.signal);
        sizes_.push_back(memory.size);
      }
    result.inputs.push_back(L::sides == 1 ? Signal{"load_force_N", "N"} : Signal{"torque_N_m", "N m"});
  }

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

    const auto states = static_cast<Eigen::Index>(L::steering);
    const auto count = static_cast<Eigen::Index>(result.inputs.size());
    const auto outputs = static_cast<Eigen::Index>(result.outputs.size());
    result.state = Eigen::Map<const Eigen::VectorXd>(y.data(), states);
    result.rate.resize(states);
    result.output.resize(outputs);
    result.input = Eigen::VectorXd::Zero(count);
    result.A.resize(states, states);
    result.B = Eigen::MatrixXd::Zero(states, count);
    result.C.resize(outputs, states);
    result.D = Eigen::MatrixXd::Zero(outputs, count);
    const auto put = [&](Eigen::Index row, const Number& value, Eigen::VectorXd& values,
                         Eigen::MatrixXd& by_state, Eigen::MatrixXd& by_input) {
      values[row] = value.value;
      by_state.row(row) = value.slopes.template head<L::steering>().transpose();
      by_input.row(row).template head<held_inputs>() = value.slopes.template tail<held_inputs>().transpose();
    };
    Eigen::Index next = 0;
    for_each_rate<L>(rates, now,
                     [&](const Number& rate) { put(next++, rate, result.rate, result.A, result.B); });
    next = 0;
    const auto out = [&](const Number& value) { put(next++, value, result.output, result.C, result.D); };
    out(position(seeds.state));
    out(seeds.state.side.muscle_pressure_Pa);
    out(now.cord_force_N());
    if constexpr (L::sides == 2) {
      out(seeds.state.opposite.muscle_pressure_Pa);
      out(now.opposite.cord_force_N());
    }
    inputs_as_they_are_given(held);
  }

  Number position(const plant::State<Number>& state) const {
    if constexpr (L::sides == 1) return state.joint.contraction_ratio;
    return (state.joint.contraction_ratio - plant_.link().contraction_ratio) *
           (plant_.side().braid().rest_length_m() / plant_.rig().joint.wheel_radius_m);
  }

  /// From the pressure that the valve follows to the current; and what lifts the load.
  void inputs_as_they_are_given(const plant::Held& held) {
    for (int i = 0; i < L::sides; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double slope = side(i).reference_slope_Pa_per_mA(current_mA_[at]);
      const Eigen::Index current = Eigen::Index{2} * i, its_speed = current + 1;
      result.B.col(current) *= slope;
      result.D.col(current) *= slope;
      result.input[current] = current_mA_[at];
      result.input[its_speed] = i == 0 ? held.current_speed_mA_per_s : held.opposite.current_speed_mA_per_s;
    }
    const double arm_m = L::sides == 1 ? 1.0 : plant_.rig().joint.wheel_radius_m;  // of a torque
    result.B(1, held_inputs) =
        1.0 / (plant_.moved_kg(result.state[0]) * arm_m * plant_.side().braid().rest_length_m());
  }

  /// Memories of what is not at work neither move nor do anything.
  void drop_unused() {
    std::vector<Eigen::Index> kept;
    std::vector<Signal> names;
    Eigen::VectorXd sizes = Eigen::VectorXd::Ones(L::steering);
    for (Eigen::Index i = 0; i < L::steering; ++i) {
      const bool memory = i >= L::states;
      if (memory) sizes[i] = sizes_[static_cast<std::size_t>(i - L::states)];
      const bool used = !memory || result.rate[i] != 0.0 || !result.A.row(i).isZero(0.0) ||
                        !result.A.col(i).isZero(0.0) || !result.C.col(i).isZero(0.0);
      if (!used) continue;
      kept.push_back(i);
      names.push_back(result.states[static_cast<std::size_t>(i)]);
    }
    result.states = names;
    const Eigen::VectorXd inverse = sizes.cwiseInverse();
    result.A = (sizes.asDiagonal() * result.A * inverse.asDiagonal())(kept, kept).eval();
    result.B = (sizes.asDiagonal() * result.B)(kept, Eigen::all).eval();
    result.C = (result.C * inverse.asDiagonal())(Eigen::all, kept).eval();
    result.state = result.state.cwiseProduct(sizes)(kept).eval();
    result.rate = result.rate.cwiseProduct(sizes)(kept).eval();
  }

  const plant::Plant& plant_;
  std::array<double, 2> current_mA_;
  std::vector<double> sizes_;  ///< of memories
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
