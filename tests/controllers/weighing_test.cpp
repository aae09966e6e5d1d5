// Weighing of a load whose counts are made by the formulas themselves.
#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include <controllers/weighing.hpp>

#include "planted.hpp"

namespace mckibben::controllers {
namespace {

// Contraction ratio at which braid force less friction carries the
// load (T 4.29 to 4.31 without acceleration).
double rest_ratio(const Knowledge& knowledge, const FrictionModel& friction, double nu, double load_kg,
                  double current_mA) {
  const double pressure_Pa = knowledge.valve.pressure_Pa(current_mA);
  double low = 1e-4, high = 0.28;
  for (int i = 0; i < 60; ++i) {
    const double e = 0.5 * (low + high);
    const double net_N = knowledge.model.force_N(e, pressure_Pa) -
                         friction.coefficient(e, nu) * knowledge.model.contact_surface_m2(e) * pressure_Pa;
    (net_N > load_kg * gravity_m_per_s2 ? low : high) = e;
  }
  return low;
}

// Runs a weighing; `lift(current)` is the contraction ratio.
template <class Lift>
void weigh(Weighing& weighing, const Knowledge& knowledge, const Lift& lift) {
  for (std::int64_t k = 0; k < weighing.ticks(); ++k)
    weighing.see(k, static_cast<std::int64_t>(
                        std::floor(lift(weighing.current_mA(k)) / knowledge.contraction_per_count)));
}

TEST(Weighing, IsFiveTrianglesOfConstantSpeed) {
  const Knowledge knowledge = data_sheets({});
  const Calibration calibration = planted_calibration();
  const Weighing weighing({}, calibration, knowledge);
  int turns_down = 0;
  for (std::int64_t k = 1; k + 1 < weighing.ticks(); ++k) {
    const double before = weighing.current_mA(k) - weighing.current_mA(k - 1);
    const double after = weighing.current_mA(k + 1) - weighing.current_mA(k);
    EXPECT_LE(std::abs(after), 6.0 * 0.012 + 1e-9);
    if (before > 0.0 && after <= 0.0) ++turns_down;
    EXPECT_GE(weighing.current_mA(k), 4.0);
    EXPECT_LE(weighing.current_mA(k), 8.0);
  }
  EXPECT_EQ(turns_down, 5);
}

TEST(Weighing, RecoversAPlantedLoad) {
  const Knowledge knowledge = data_sheets({});
  const Calibration calibration = planted_calibration();
  for (const double load_kg : {11.138, 16.138, 23.406}) {
    const WeighingSettings settings{.speed_mA_per_s = 6.0, .high_mA = 9.0};
    Weighing weighing(settings, calibration, knowledge);
    weigh(weighing, knowledge, [&](double current_mA) {
      return rest_ratio(knowledge, calibration.contraction_friction, *settings.speed_mA_per_s, load_kg,
                        current_mA);
    });
    EXPECT_NEAR(weighing.result().load_kg, load_kg, 2e-3 * load_kg);
    EXPECT_LT(weighing.result().spread_kg, 1e-9) << "five times the same";
  }
}

TEST(Weighing, SpreadIsTheStandardDeviationOverTheContractions) {
  const Knowledge knowledge = data_sheets({});
  const Calibration calibration = planted_calibration();
  const WeighingSettings settings{.contractions = 3, .speed_mA_per_s = 6.0};
  Weighing weighing(settings, calibration, knowledge);
  const double loads_kg[] = {15.0, 16.0, 17.0};
  for (std::int64_t k = 0; k < weighing.ticks(); ++k) {
    const double load_kg = loads_kg[k / (weighing.ticks() / 3)];
    const double e = rest_ratio(knowledge, calibration.contraction_friction, *settings.speed_mA_per_s,
                                load_kg, weighing.current_mA(k));
    weighing.see(k, static_cast<std::int64_t>(e / knowledge.contraction_per_count));
  }
  EXPECT_NEAR(weighing.result().load_kg, 16.0, 0.05);
  EXPECT_NEAR(weighing.result().spread_kg, 1.0, 0.05);
}

TEST(Weighing, OfALoadThatDoesNotMoveFailsAndSaysWhatHelps) {
  const Knowledge knowledge = data_sheets({});
  const Calibration calibration = planted_calibration();
  Weighing weighing({}, calibration, knowledge);
  weigh(weighing, knowledge, [](double) { return 0.0; });
  try {
    weighing.result();
    FAIL() << "a load that never moved was weighed";
  } catch (const ControllerFailure& failure) {
    const std::string text = failure.what();
    EXPECT_NE(text.find("contraction 1 of 5 the load moved by 0 counts"), std::string::npos) << text;
    EXPECT_NE(text.find("weighing.high"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace mckibben::controllers
