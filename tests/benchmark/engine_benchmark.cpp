// What a simulated second costs, in right-hand-side times measured in the same run,
// and which SUNDIALS it ran on.
//
// Rides (those of the thesis's campaign): A = 11.138 kg, full sine at 16.7 mA/s; B = 23.406 kg at 8.3 mA/s,
// which rests on the braid stop in every period.
// Each line prints its largest error in e against the tightest tolerance.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

#include <benchmark/benchmark.h>
#include <nvector/nvector_serial.h>
#include <sys/resource.h>

#include <sim/engine/batch.hpp>
#include <sim/engine/erk_method.hpp>
#include <sim/engine/versions.hpp>

#include "boost_cash_karp.hpp"
#include "switched_on.hpp"

namespace mckibben::engine {
namespace {

/// The library's own vector, for comparison.
struct StockVector {
  using layout = Layout<1, plant::Memories::none, Books::none>;
  static constexpr int size = layout::size;
  static double* data(N_Vector v) { return NV_DATA_S(v); }
  static N_Vector make(SUNContext context) { return N_VNew_Serial(size, context); }
};

struct Ride {
  double load_kg;
  int ticks_per_period;
};
constexpr Ride rides[] = {{11.138, 200}, {23.406, 400}};
constexpr int ride_ticks = 800;

double current_mA(const Ride& ride, int tick) {
  return 10.0 * (1.0 - std::cos(2.0 * std::numbers::pi * tick / ride.ticks_per_period));
}

std::vector<double> drive(const Ride& ride, const plant::Plant& plant, Integrator& integrator) {
  Flow flow;
  plant::Held held;
  held.reference_pressure_Pa = plant.reference_pressure_Pa(0.0);
  flow.state = plant.at_rest(held);
  std::vector<double> e;
  e.reserve(ride_ticks);
  for (int k = 0; k < ride_ticks; ++k) {
    held.reference_pressure_Pa = plant.reference_pressure_Pa(current_mA(ride, k));
    integrator.advance(flow, held, 0.012 * k, 0.012 * (k + 1));
    e.push_back(flow.state.joint.contraction_ratio);
  }
  return e;
}

/// Seconds of one right-hand side: mean over the states of a ride, each waiting for the one before.
double right_hand_side_s() {
  static const double cost_s = [] {
    const Ride& ride = rides[0];
    const plant::Plant plant(plant::Rig{}, ride.load_kg);
    const auto integrator = make_integrator(plant, solver::Settings{}, false);
    std::vector<std::array<double, plant::single_size>> states;
    std::vector<plant::Held> held;
    Flow flow;
    plant::Held now;
    now.reference_pressure_Pa = plant.reference_pressure_Pa(0.0);
    flow.state = plant.at_rest(now);
    for (int k = 0; k < ride_ticks; ++k) {
      now.reference_pressure_Pa = plant.reference_pressure_Pa(current_mA(ride, k));
      integrator->advance(flow, now, 0.012 * k, 0.012 * (k + 1));
      Problem<Layout<1, plant::Memories::none, Books::none>>::store(flow, states.emplace_back().data());
      held.push_back(now);
    }
    Problem<Layout<1, plant::Memories::none, Books::none>> problem(plant);
    double best_s = 1.0;
    for (int trial = 0; trial < 50; ++trial) {
      double chain = 0.0;
      const auto start = std::chrono::steady_clock::now();
      for (std::size_t k = 0; k < states.size(); ++k) {
        auto y = states[k];
        y[0] += chain;
        problem.held = held[k];
        std::array<double, plant::single_size> dydt{};
        problem.rates(y.data(), dydt.data());
        chain = 1e-18 * dydt[0] + 1e-30 * (dydt[1] + dydt[2] + dydt[3] + dydt[4]);
        benchmark::DoNotOptimize(chain);
      }
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      best_s = std::min(best_s, took.count() / static_cast<double>(states.size()));
    }
    return best_s;
  }();
  return cost_s;
}

template <class Make>
void ride_benchmark(benchmark::State& state, const Make& make, const plant::Rig& rig = {}) {
  const Ride& ride = rides[state.range(0)];
  const plant::Plant plant(rig, ride.load_kg);
  const auto exact =
      drive(ride, plant, *make_integrator(plant, {Method::erk, solver::tightest_tolerance}, false));
  std::vector<double> e;
  double best_s = 1e9;
  for (auto _ : state) {
    const auto integrator = make(plant);
    const auto start = std::chrono::steady_clock::now();
    e = drive(ride, plant, *integrator);
    const double cost_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best_s = std::min(best_s, cost_s);
    state.SetIterationTime(cost_s);
  }
  double error = 0.0;
  for (std::size_t k = 0; k < e.size(); ++k) error = std::max(error, std::abs(e[k] - exact[k]));
  const double simulated_s = ride_ticks * 0.012;
  state.counters["error_in_e"] = error;
  state.counters["rhs_times_per_s"] = best_s / right_hand_side_s() / simulated_s;
  state.counters["times_real_time"] = simulated_s / best_s;
}

// Tolerance at which both rides stay within 1e-6 in e.
constexpr double loose = 4e-6;

template <class V>
void Erk_(benchmark::State& state) {
  ride_benchmark(state, [](const plant::Plant& plant) { return std::make_unique<Erk<V>>(plant, loose); });
}
void Boost_(benchmark::State& state) {
  ride_benchmark(state,
                 [](const plant::Plant& plant) { return std::make_unique<BoostCashKarp>(plant, loose); });
}
void Engine_(benchmark::State& state, Method method, bool ledger) {
  ride_benchmark(state, [&](const plant::Plant& plant) {
    return make_integrator(plant, {method, solver::Settings{}.tolerance}, ledger);
  });
}

/// The default method with effects: none of them with a memory, one with, all at once.
plant::Rig viscous() {
  plant::Rig rig;
  plant::switch_on(rig.effects.get<plant::ViscousDamping>(), plant::ViscousDamping::variants.front());
  return rig;
}
plant::Rig creeping() {
  plant::Rig rig;
  plant::switch_on(rig.effects.get<plant::BladderCreep>(), plant::BladderCreep::variants.front());
  return rig;
}
void Effects_(benchmark::State& state, const plant::Rig& rig) {
  ride_benchmark(
      state, [](const plant::Plant& plant) { return make_integrator(plant, solver::Settings{}, false); },
      rig);
}

/// Eight rigs in common steps, their loads `spread_kg` apart: what one of them costs.
void Lanes_(benchmark::State& state, double spread_kg) {
  const Ride& ride = rides[state.range(0)];
  std::vector<plant::Plant> plants;
  std::vector<const plant::Plant*> group;
  for (std::size_t i = 0; i < Batch::width; ++i)
    plants.emplace_back(plant::Rig{}, ride.load_kg + spread_kg * static_cast<double>(i));
  for (const plant::Plant& plant : plants) group.push_back(&plant);
  const double simulated_s = ride_ticks * 0.012 * static_cast<double>(Batch::width);
  double best_s = 1e9;
  for (auto _ : state) {
    const auto batch = make_batch({}, loose, Batch::width);
    const std::size_t slot = *batch->submit(group);
    std::vector<Flow> flows(plants.size());
    std::vector<plant::Held> held(plants.size());
    std::vector<Bound> bound;
    for (std::size_t i = 0; i < plants.size(); ++i) {
      held[i].reference_pressure_Pa = plants[i].reference_pressure_Pa(0.0);
      flows[i].state = plants[i].at_rest(held[i]);
      bound.push_back({&flows[i], &held[i]});
    }
    int k = 0;
    const auto advance = [&] {
      for (std::size_t i = 0; i < plants.size(); ++i)
        held[i].reference_pressure_Pa = plants[i].reference_pressure_Pa(current_mA(ride, k));
      batch->advance(slot, bound, 0.012 * k, 0.012 * (k + 1));
    };
    const auto start = std::chrono::steady_clock::now();
    advance();
    batch->run([&](std::size_t, bool) {
      if (++k < ride_ticks) advance();
    });
    const double cost_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best_s = std::min(best_s, cost_s);
    state.SetIterationTime(cost_s);
  }
  state.counters["rhs_times_per_s"] = best_s / right_hand_side_s() / simulated_s;
  state.counters["times_real_time"] = simulated_s / best_s;
}

BENCHMARK(Erk_<PlantVector<1, plant::Memories::none, Books::none>>)
    ->Name("erk/error_1e-6/own_vector")
    ->DenseRange(0, 1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(Erk_<StockVector>)
    ->Name("erk/error_1e-6/stock_vector")
    ->DenseRange(0, 1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(Boost_)
    ->Name("erk/error_1e-6/boost_cash_karp")
    ->DenseRange(0, 1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Lanes_, alike, 1e-6)->DenseRange(0, 1)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Lanes_, other_loads, 1.0)->DenseRange(0, 1)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Engine_, erk_default, Method::erk, false)
    ->DenseRange(0, 1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Engine_, erk_default_ledger, Method::erk, true)
    ->DenseRange(0, 1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Engine_, cvode_default, Method::cvode, false)
    ->DenseRange(0, 1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Effects_, viscous_damping, viscous())
    ->DenseRange(0, 1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Effects_, bladder_creep, creeping())
    ->DenseRange(0, 1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Effects_, all, plant::rig_with_all_effects())
    ->DenseRange(0, 1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

void print_library() {
  std::printf("SUNDIALS %s; a right-hand side takes %.1f ns\n", sundials_version().c_str(),
              1e9 * right_hand_side_s());
}

}  // namespace
}  // namespace mckibben::engine

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  mckibben::engine::print_library();
  benchmark::RunSpecifiedBenchmarks();
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  std::printf("peak memory %.0f MB\n", static_cast<double>(used.ru_maxrss) / 1024.0);
  return 0;
}
