// Weighing of an unknown load with a model: one slow rise to where the target begins, and the load with which
// the model's own rise, under the same currents, lies on the counts in the mean. Ours; the thesis lifts the
// load five times and takes friction from a fitted coefficient (T 4.3).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <controllers/controller.hpp>
#include <controllers/current_range.hpp>
#include <controllers/rig_model.hpp>

namespace mckibben::controllers {

class RiseWeighing {
 public:
  /// `delay_ticks`: age of the counts.
  RiseWeighing(double speed_mA_per_s, int delay_ticks, const Knowledge& knowledge);

  /// That it takes at most.
  std::int64_t ticks() const { return rise_ticks_ + hold_ticks_; }
  double rest_mA() const { return range_.lowest_mA; }

  /// Current for the tick at which these counts were read. In order, until it is `done`.
  double step_mA(std::int64_t counts);
  bool done() const { return held_ticks_ >= hold_ticks_; }
  double current_mA() const { return current_mA_; }

  /// The model that rose as the load did, with the load that it takes. Throws ControllerFailure,
  /// ModelFailure.
  std::unique_ptr<RigModel> weighed(const ModelMaker& maker);

  double load_kg() const { return load_kg_; }
  double misfit() const { return misfit_; }  ///< rms of counts less model over the rise [contraction ratio]

 private:
  struct Fit {
    std::unique_ptr<RigModel> model;
    double mean, rms;
  };
  Fit fit(const ModelMaker& maker, double load_kg) const;
  double guess_kg() const;
  double ratio(std::int64_t counts) const;

  Knowledge knowledge_;
  CurrentRange range_;
  double speed_mA_per_s_;
  std::size_t delay_;
  std::int64_t rise_ticks_, hold_ticks_, held_ticks_ = 0;
  double current_mA_;
  std::vector<std::int64_t> counts_;
  std::vector<double> currents_mA_;
  double load_kg_ = 0.0, misfit_ = 0.0;
};

}  // namespace mckibben::controllers
