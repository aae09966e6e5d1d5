// What the open loops share: they load a calibration, weigh the load before tick 0 unless they are told it,
// and then ask the inverse for currents.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <controllers/inverse.hpp>
#include <controllers/weighing.hpp>

namespace mckibben::controllers {

struct CalibrationTerms {
  std::string calibration;
  Calibration model;  ///< filled from the file by whoever can read it, before make()
  std::optional<double> assumed_load_kg = std::nullopt;
  bool extrapolate_load = false;

  static void fields(auto& self, auto& visit) {
    visit.required("calibration", self.calibration,
                   "what `calibrate` wrote for this rig; of the thesis's rig itself: `thesis`");
    visit("assumed_load", self.assumed_load_kg, "kg", 0.01, 500.0, "load of its model; estimated if absent");
    visit("extrapolate_load", self.extrapolate_load,
          "whether a load, and a weighing speed, outside the calibrated range are allowed");
  }
  void rules(auto& report) const {
    if (calibration.empty()) report("calibration", "must name a file");
  }
};

/// Those that weigh the load in contractions.
struct CalibratedSettings : CalibrationTerms {
  WeighingSettings weighing;
  bool extrapolate_target = false;

  /// What is left open of the weighing; its speed is one that the calibration was made with.
  void follow(const CurrentRange& range);

  static void fields(auto& self, auto& visit) {
    CalibrationTerms::fields(self, visit);
    visit("weighing", self.weighing, "how the load is weighed before the run, unless it is assumed");
    visit("extrapolate_target", self.extrapolate_target,
          "whether contraction ratios and command speeds may leave the calibrated range on the way; if not, "
          "they are brought to its end");
  }
};

// How wrong a load may be weighed: T 4.3 reports 6.5 %, T 5 "below 15 percent".
inline constexpr double weighing_tolerance = 0.10;

/// Preparation and the inverse; what is done from tick 0 on is the derived controller's.
class CalibratedController : public Controller {
 public:
  CalibratedController(const CalibratedSettings& settings, const Knowledge& knowledge);

  Command rest() final;
  std::int64_t preparation_ticks() const final;
  Command step(const Reading& reading) final;
  std::vector<Finding> findings() const override;

 protected:
  /// The load is known: plans may be made, memory taken.
  virtual void prepare() {}
  /// Current to begin with, once the load is known.
  virtual double first_mA() = 0;
  /// Current at tick 0 and after.
  virtual double drive_mA(const Reading& reading) = 0;

  /// Current that the inverse asks for; what it had to leave out is counted. With `lag_s` the pressure by
  /// which a muscle that lags so far stays behind is taken off again.
  double ask_mA(Branch branch, double contraction_ratio, double contraction_speed_per_s, double lag_s = 0.0);
  /// The same for a load that comes to rest at a contraction ratio from below; nothing is counted.
  double begin_mA(double contraction_ratio, double lag_s = 0.0);
  /// Current that follows the target from tick to tick, held while the target rests; after `begin_mA`.
  double follow_mA(double contraction_ratio);

  const Knowledge& knowledge() const { return knowledge_; }
  const Inverse& inverse() const { return *inverse_; }
  double load_kg() const { return load_kg_; }
  /// Contraction ratio that was last asked for.
  double asked_ratio() const { return asked_ratio_; }
  double current_mA() const { return current_mA_; }

 private:
  void know(double load_kg);
  double current_of(Branch branch, const Answer& answer, double lag_s) const;

  CalibratedSettings settings_;
  Knowledge knowledge_;
  std::optional<Weighing> weighing_;
  std::optional<Inverse> inverse_;
  std::optional<WeighedLoad> weighed_;  ///< none as long as it weighs, or if that failed
  double load_kg_ = 0.0, first_mA_ = 0.0, current_mA_ = 0.0, asked_ratio_ = 0.0;
  bool load_extrapolated_ = false, load_at_range_end_ = false;
  std::int64_t ratio_outside_ = 0, speed_outside_ = 0, extrapolated_ = 0, unreachable_ = 0;
};

}  // namespace mckibben::controllers
