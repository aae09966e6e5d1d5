// Grades and their words; see the header.
#include <fmt/format.h>

#include <sim/thesis/quality.hpp>

namespace mckibben::thesis {

Quality::Grade Quality::grade() const {
  if (!(spread >= 0.0 && spread <= largest_usable_spread)) return Grade::not_usable;
  return spread < printed_spread() ? Grade::good : Grade::rough;
}

std::string Quality::name() const {
  return fmt::format("{} in {}", model == Model::friction ? "friction" : "pressure", name_of(direction));
}

std::string Quality::meaning() const {
  const std::string printed = fmt::format("the thesis reports below {:g} % (T 5)", 100.0 * printed_spread());
  if (grade() == Grade::good) return "good, " + printed;
  if (grade() == Grade::not_usable) return "samples scatter by more than the mean; " + printed;
  return fmt::format(
      "rough, {}; {}", printed,
      model == Model::friction
          ? "counting and the lag of valve and hose are in it, so check what is weighed with it "
            "against a known load"
          : "more loads, speeds or periods may narrow it");
}

std::array<Quality, 4> quality_of(const CalibrationResult& result, const Options& options) {
  const auto friction = [&](Direction direction) {
    return Quality{Quality::Model::friction, direction, result.friction_of(direction).spread()};
  };
  const auto pressure = [&](Direction direction) {
    const PressureFit& fit = result.pressure_of(direction);
    const bool joint = options.fitting == PressureFitting::joint;
    return Quality{Quality::Model::pressure, direction,
                   (joint ? fit.deviation.joint : fit.deviation.in_load) / fit.mean_Pa};
  };
  return {friction(Direction::contraction), friction(Direction::relaxation), pressure(Direction::contraction),
          pressure(Direction::relaxation)};
}

}  // namespace mckibben::thesis
