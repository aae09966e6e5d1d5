// The bench that is a ride: it moves by as much as the loop's clock does. Periods of a pulse-width modulation
// begin with tick 0, and noise is drawn once a tick, as in a run.
#pragma once

#include <cstdint>
#include <limits>

#include <plant/instruments.hpp>
#include <sim/bench/device.hpp>
#include <sim/ride/ride.hpp>
#include <sim/run/drawn_noise.hpp>

namespace mckibben::bench {

class Simulated final : public Device {
 public:
  /// At rest under that current; the first command begins at rest under its own, as a run does.
  Simulated(const plant::Rig& rig, double load_kg, const solver::Settings& integrator, double current_mA,
            const plant::Noise& noise = {}, std::uint64_t seed = 1);

  std::int64_t counts(double now_s) override;
  bool has_gauge() const override { return gauge() != nullptr; }
  double gauge_Pa(double now_s) override;
  void put(double current_mA, double now_s) override;

 private:
  const plant::Rig& rig() const { return ride_.plant().rig(); }
  const plant::Sensor* gauge() const { return rig().sensors.of(plant::Sensed::muscle_pressure); }
  void move_on(double now_s);

  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  ride::Ride ride_;
  plant::PositionReader counter_;
  run::DrawnNoise noise_;
  std::int64_t counts_ = 0;
  double gauge_Pa_ = none, counted_s_ = none, gauged_s_ = none;  ///< what was read last, and when
  ride::Drive drive_;
  bool was_put_ = false;
};

}  // namespace mckibben::bench
