// The cost of one run; see the header.
#include <cmath>

#include <sim/run/tune_pid.hpp>
#include <sim/run/tuning_cost.hpp>

namespace mckibben::run {
namespace {

// What a change of current costs in tuning [contraction ratio for each mA rms and tick, at the thesis's
// span]: enough to keep gains from chasing single encoder counts,
// too little to matter for how the target is followed.
constexpr double effort_weight = 2e-4;

double effort_mA(const Recording& recording) {
  double sum_squared_mA = 0.0;
  for (std::size_t k = 1; k < recording.samples.size(); ++k) {
    const double change_mA = recording.samples[k].current_mA - recording.samples[k - 1].current_mA;
    sum_squared_mA += change_mA * change_mA;
  }
  return std::sqrt(sum_squared_mA / static_cast<double>(recording.samples.size()));
}

}  // namespace

double tuning_cost(double rmse, const Recording& recording, double span_mA) {
  return rmse + effort_weight * (thesis_span_mA / span_mA) * effort_mA(recording);
}

}  // namespace mckibben::run
