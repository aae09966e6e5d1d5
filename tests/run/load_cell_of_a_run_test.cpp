// A load cell that reads one run otherwise than the others: its unit, its column, its zero or the label.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "measured_on.hpp"
#include "says.hpp"

namespace mckibben::run {
namespace {

domain::Dataset with_a_load_cell() {
  domain::Dataset data = sound();
  data.columns["force"] = {.column = "F", .unit = "N"};
  data.columns["muscle_pressure"] = {.column = "p", .unit = "psi"};
  for (domain::Run& run : data.runs)
    run.read("force", std::vector(run.rows(), run.load_kg * plant::gravity_m_per_s2));
  return data;
}

std::string told(const domain::Dataset& data) {
  return fmt::format("{}", fmt::join(said(data), "\n"));
}

void read(domain::Run& run, double factor, double more_N) {
  for (double& force_N : run.find("force")->values) force_N = factor * force_N + more_N;
}

TEST(LoadCellOfARun, AUnitOfOneRunIsNamedAndItsLoadNotDoubted) {
  for (const std::size_t run : {0u, 3u})
    for (const auto& [unit, size_N] : {std::pair{"lbf", 4.448222}, {"kgf", plant::gravity_m_per_s2}}) {
      domain::Dataset data = with_a_load_cell();
      read(data.runs[run], 1.0 / size_N, 0.0);
      EXPECT_TRUE(holds(says(data), fmt::format("error: run {}: force reads ", data.runs[run].id),
                        " N less than hangs there, where other runs agree; ",
                        fmt::format("this looks like {}, not N; write there columns: {{force: {{column: F, "
                                    "unit: {}, factor: 1}}}}",
                                    unit, unit)));
      data = with_a_load_cell();
      data.runs[run].columns["force"] = {.column = "F", .unit = unit};
      read(data.runs[run], size_N, 0.0);
      EXPECT_TRUE(holds(says(data), fmt::format("this looks like N, not {}, as in these; ", unit)));
    }
}

TEST(LoadCellOfARun, ALoadInAnotherUnitIsNoUnitOfItsCell) {
  domain::Dataset data = with_a_load_cell();
  data.runs[2].load_kg *= 2.2046;
  EXPECT_EQ(told(data).find("looks like lbf"), std::string::npos) << told(data);
}

TEST(LoadCellOfARun, AColumnThatIsExchangedInOneRunIsNamed) {
  domain::Dataset data = with_a_load_cell();
  constexpr double psi_Pa = 6894.757;
  auto &force_N = data.runs[4].find("force")->values,
       &pressure_Pa = data.runs[4].find("muscle_pressure")->values;
  for (std::size_t k = 0; k < force_N.size(); ++k) {
    const double psi = pressure_Pa[k] / psi_Pa;
    pressure_Pa[k] = force_N[k] * psi_Pa;
    force_N[k] = psi;
  }
  EXPECT_TRUE(holds(says(data), "error: run r05: force reads ", "muscle_pressure would agree there: ",
                    "these two columns look exchanged; write there columns: {force: {column: p, unit: N, "
                    "factor: 1}, muscle_pressure: {column: F, unit: psi, factor: 1}}"));
}

TEST(LoadCellOfARun, AZeroOfOneRunIsAskedForBeforeItsLabel) {
  for (const double more_N : {-20.0, 25.0}) {
    domain::Dataset data = with_a_load_cell();
    read(data.runs[2], 1.0, more_N);
    EXPECT_TRUE(holds(says(data), "warning: run r03: force reads ",
                      "in no other run so: is its zero there what ",
                      fmt::format("{{force: {{column: F, unit: N, zero: {}", more_N < 0.0 ? "-20" : "24"),
                      "}} of this run"));
    EXPECT_EQ(told(data).find("is load"), std::string::npos) << told(data);
    data = with_a_load_cell();
    data.runs[2].columns["force"] = {.column = "F", .unit = "N", .zero = -more_N};
    read(data.runs[2], 1.0, more_N);
    EXPECT_TRUE(holds(says(data), "with their zero it agrees, too; write there columns: {force: {column: F, ",
                      "unit: N, factor: 1}}"));
  }
}

TEST(LoadCellOfARun, ALabelOfAllRunsOfOneLoadIsAskedFor) {
  domain::Dataset data = with_a_load_cell();
  const double hung_kg = data.runs[2].load_kg;
  for (const std::size_t run : {2u, 3u}) data.runs[run].load_kg += 2.0;
  EXPECT_TRUE(holds(told(data), "runs r03, r04: force reads ", fmt::format("is load: {:.0f}", hung_kg)));
}

}  // namespace
}  // namespace mckibben::run
