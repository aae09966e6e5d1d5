// The rig that Python steps: a ride with its drive, its ticks and its encoder.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <plant/instruments.hpp>
#include <sim/engine/linear.hpp>
#include <sim/python/module.hpp>
#include <sim/python/recordings.hpp>
#include <sim/python/turn.hpp>
#include <sim/ride/ride.hpp>

namespace mckibben::python {

/// What instruments show at an instant.
struct Shown {
  double time_s, contraction_ratio, angle_rad, gauge_pressure_Pa, opposite_gauge_pressure_Pa;
  std::int64_t counts;
};

/// What a step changes in the drive.
struct Given {
  std::optional<double> command{}, opposite_command{}, muscle_pressure_Pa{}, opposite_muscle_pressure_Pa{},
      contraction_ratio{};
};

class Ride {
 public:
  using Commands = py::array_t<double, py::array::c_style | py::array::forcecast>;

  /// Settled at 0 s, no pressure asked for. Throws py::value_error without a load, or with one on two
  /// muscles.
  Ride(const py::object& rig, std::optional<double> load_kg, double jitter = 0.0);
  Ride(const Ride& other);

  void start(const Given& given, double at_s, bool settle);
  /// A tick, or so long.
  Shown step(const Given& given, std::optional<double> dt_s);
  /// Ctrl-C ends it where it is then.
  Simulated follow(const Commands& command, const std::optional<Commands>& opposite);

  struct Saved {
    std::shared_ptr<const plant::Rig> rig;
    ride::Ride::Saved ride;
    plant::PositionReader counter;
    ride::Drive drive;
    double begin_s;
    long ticks;
    std::int64_t counts;
    double jitter;
  };
  Saved save() const;
  /// Throws py::value_error if it is of another rig.
  void restore(const Saved& saved);

  engine::Linear linearise() const;
  Shown shown() const;
  plant::Moment<double> moment() const { return ride_.moment(); }
  const double* state() const { return &ride_.flow().state.joint.contraction_ratio; }
  bool pair() const { return rig_->pair() != nullptr; }
  Rig rig() const { return {*rig_}; }
  std::optional<double> load_kg() const { return load_kg_; }
  plant::CommandUnit command_unit() const { return rig_->command_unit(); }

  double jitter;  ///< of the position that is counted after a step, as a contraction ratio

 private:
  ride::Drive with(const Given& given, const ride::Drive& before) const;
  void advance();
  void look();
  /// Unless the sensor shows the reading that it showed then.
  void look_since(double before_s);
  double time_after(long ticks) const {
    return begin_s_ + static_cast<double>(ticks_ + ticks) * rig_->tick_s;
  }

  std::shared_ptr<const plant::Rig> rig_;
  std::optional<double> load_kg_;
  ride::Ride ride_;
  plant::PositionReader counter_;
  ride::Drive drive_;
  double begin_s_ = 0.0;  ///< times are products of ticks, never sums
  long ticks_ = 0;
  std::int64_t counts_ = 0;
  mutable Turn::Busy busy_{false};
};

}  // namespace mckibben::python
