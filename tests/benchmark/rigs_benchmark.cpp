// Random rigs under random currents with each method:
// how many runs fail and why, and how well the ledger closes.
//
//   ./mckibben bench rigs [SEED] [COUNT] [full|moderate]   over the documented ranges, or within a factor 2
//                                                          of the thesis's rig
//   ./mckibben bench rigs show SEED full|moderate          the one rig of that seed, as a rig file in JSON
//
// The n-th rig has the seed SEED + n, by which `show` and the tests know it.
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <controllers/waveform.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/rigs.hpp>
#include <sim/run/simulate.hpp>

#include "random_rides.hpp"

namespace mckibben::run {
namespace {

void print_shares(const char* of, std::vector<double> values) {
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  const auto at = [&](double part) {
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
  };
  fmt::print("  {:6} unexplained: median {:.1e}, 95 % {:.1e}, worst {:.1e}\n", of, at(0.5), at(0.95),
             at(1.0));
}

void survey(unsigned first_seed, unsigned count, bool whole_range) {
  for (const auto& [method, name] : solver::names(solver::Method{})) {
    int failed = 0, doubtful = 0;
    std::vector<double> gas, energy;
    const std::clock_t start = std::clock();
    for (unsigned seed = first_seed; seed < first_seed + count; ++seed) {
      const Recording run = random_ride(seed, whole_range, method);
      if (!run.failure.empty()) {
        ++failed;
        fmt::print("  {}, seed {}: {}\n", name, seed, run.failure);
        continue;
      }
      doubtful += doubts(run).empty() ? 0 : 1;
      gas.push_back(run.imbalance.gas);
      energy.push_back(run.imbalance.energy);
    }
    fmt::print("{}: {} of {} failed, {} with warnings, {:.1f} s\n", name, failed, count, doubtful,
               static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    print_shares("gas", gas);
    print_shares("energy", energy);
  }
}

void show(unsigned seed, bool whole_range) {
  const RandomRide ride(seed, whole_range);
  const plant::Rig file = ride.plan.rig;
  fmt::print("{}\n", input::rig_json(file).dump(2));
  fmt::print(stderr, "load {} kg, {} ticks\n", ride.plan.load_kg, ride.plan.ticks);
}

}  // namespace
}  // namespace mckibben::run

int main(int argc, char** argv) {
  const auto word = [&](int i) { return std::string_view(i < argc ? argv[i] : ""); };
  const auto number = [&](int i, unsigned otherwise) {
    return i < argc ? static_cast<unsigned>(std::strtoul(argv[i], nullptr, 10)) : otherwise;
  };
  const bool whole_range = word(3) != "moderate";
  if (word(1) == "show")
    mckibben::run::show(number(2, 1), whole_range);
  else
    mckibben::run::survey(number(1, 1), number(2, 100), whole_range);
}
