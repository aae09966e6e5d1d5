// Motions whose answer is known: closed forms, and a trajectory of an independent program that integrated the
// same equations in fixed steps of 20 us. `doctor` asks whether this machine still finds them.
#pragma once

#include <string>
#include <vector>

#include <sim/solver/settings.hpp>

namespace mckibben::cli {

/// One case with one method.
struct KnownCase {
  std::string name;
  solver::Method method{};
  double error = 0.0, allowed = 0.0;
  std::string unit;
  std::string failure;  ///< why the integrator gave up; empty if it did not

  bool ok() const { return failure.empty() && error <= allowed; }
};

/// Current [mA] held for 50 ticks from rest at the first; then contraction ratio and muscle pressure.
struct StoredRow {
  double current_mA, contraction_ratio, muscle_pressure_bar;
};
inline constexpr double stored_load_kg = 16.138;
inline constexpr int stored_ticks = 50;
/// Every fiftieth row of tests/data/reference/m16.138_steps-7-0.6-16.csv.
inline constexpr StoredRow stored_rows[] = {
    {819 * 20.0 / 4096, -0.000359765536507, 0.5},        {2320 * 20.0 / 4096, -0.000359765536507, 0.5},
    {1223 * 20.0 / 4096, 0.218186009776, 2.56530051616}, {1393 * 20.0 / 4096, 0.123081900862, 1.0593383511},
    {2226 * 20.0 / 4096, 0.123334638582, 1.28799423033}, {2709 * 20.0 / 4096, 0.198945754177, 2.43204680746},
    {2745 * 20.0 / 4096, 0.218927468575, 3.09524343336}, {3874 * 20.0 / 4096, 0.218978091566, 3.14468378824},
    {3823 * 20.0 / 4096, 0.248126588336, 4.69513139514}, {2609 * 20.0 / 4096, 0.248092899036, 4.62509156039},
};

/// Each case with both methods at a relative tolerance of the integration.
std::vector<KnownCase> known_cases(double tolerance);

}  // namespace mckibben::cli
