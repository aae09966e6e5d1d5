// A rig as a controller believes it to be, on its way: currents in, expected contraction out. Whoever can
// simulate implements it, so that controllers plan with a model and still see no plant, let alone the true
// one.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>

namespace mckibben::controllers {

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
  /// Carries it through one tick under a current, as the DAC gives it or not. Throws ModelFailure.
  virtual void step(double current_mA) = 0;
  /// Where the load is, and what the encoder shows of that before it counts [contraction ratio].
  virtual double contraction_ratio() const = 0;
  virtual double shown_ratio() const = 0;

  /// Keeps where it is; goes back to where it was kept, as often as wanted.
  virtual void keep() = 0;
  virtual void go_back() = 0;
};

/// Makes the model with a load [kg] on it, settled at a current [mA]. Throws ModelFailure.
using ModelMaker = std::function<std::unique_ptr<RigModel>(double load_kg, double rest_mA)>;

}  // namespace mckibben::controllers
