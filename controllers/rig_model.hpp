// A rig as a controller believes it to be, on its way: currents in, expected contraction out. Whoever can
// simulate implements it, so that controllers plan with a model and still see no plant, let alone the true
// one. Of a pair, contraction ratios are those of muscle 1 from joint angle 0 (Knowledge).
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <controllers/controller.hpp>

namespace mckibben::controllers {

/// How long controllers with a model take to where the target begins, before tick 0.
inline constexpr double approach_s = 1.0;

/// The model cannot be carried on: what was tried is outside the domain of its laws.
class ModelFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// At rest under its first current when it is made. Touches no heap once it was kept and taken back.
class RigModel {
 public:
  RigModel() = default;
  RigModel(const RigModel&) = delete;
  RigModel& operator=(const RigModel&) = delete;
  virtual ~RigModel();

  virtual std::unique_ptr<RigModel> copy() const = 0;

  /// What the DAC makes of a current.
  virtual double given_mA(double wanted_mA) const = 0;
  /// Carries it through some ticks under one current, as the DAC gives it or not. Throws ModelFailure.
  virtual void step(const Command& command, int ticks) = 0;
  /// Where the load is, and what the encoder shows of that before it counts [contraction ratio].
  virtual double contraction_ratio() const = 0;
  virtual double shown_ratio() const = 0;
  /// Of the joint of a pair [N m/rad], at the pressures that it has; 0 of one muscle.
  virtual double stiffness_N_m_per_rad() const { return 0.0; }

  /// Keeps where it is; goes back to where it was kept, as often as wanted.
  virtual void keep() = 0;
  virtual void go_back() = 0;
};

/// Makes the model with a load [kg] on it, of a pair in the hand, settled under a command. Throws
/// ModelFailure.
using ModelMaker = std::function<std::unique_ptr<RigModel>(double load_kg, const Command& rest)>;

/// About three times the lag of the thesis's valve and hose.
inline constexpr double usual_look_ahead_s = 0.096;

/// What every controller that plans with a model says of it.
struct PlansWithModel {
  std::string rig;
  ModelMaker model;  ///< filled in by whoever can simulate `rig`, before make()
  std::optional<double> look_ahead_s;

  int look_ahead_ticks(double tick_s) const {
    return std::max(1, static_cast<int>(std::lround(look_ahead_s.value_or(usual_look_ahead_s) / tick_s)));
  }

  static void fields(auto& self, auto& visit) {
    visit("rig", self.rig,
          "rig of its model, a shipped name or the path of a rig file; the scenario's if left out");
    visit("look_ahead", self.look_ahead_s, "s", 1e-4, 100.0,
          "time after which a command is to have brought the load, or the joint, to the target; 96 ms and "
          "the model's command_delay if absent");
  }
};

}  // namespace mckibben::controllers
