// What controllers drive on a bench, whatever it is made of: counts in, a command out.
#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>

namespace mckibben::bench {

/// The device does not answer, or what it answers cannot be.
class DeviceFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Times are seconds since tick 0, negative while the rig settles, of the clock by which the loop goes.
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  /// Encoder counts since it was opened. Throws DeviceFailure.
  virtual std::int64_t counts(double now_s) = 0;
  /// Whether it reads a gauge on the muscle.
  virtual bool has_gauge() const { return false; }
  /// What that gauge shows; NaN without one. Throws DeviceFailure.
  virtual double gauge_Pa(double) { return std::numeric_limits<double>::quiet_NaN(); }
  /// The command of its output from now on, in what the rig's valve takes. Throws DeviceFailure.
  virtual void put(double current_mA, double now_s) = 0;
};

/// Where the loop takes its time from.
class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  virtual double now_s() = 0;
  /// Returns at that time or, woken late, after it.
  virtual void wait_until(double time_s) = 0;
};

/// The machine's own, from when it is made.
class RealClock final : public Clock {
 public:
  RealClock();
  double now_s() override;
  void wait_until(double time_s) override;

 private:
  double begin_s_;
};

/// One on which no time passes but what is waited for: for what is to be shown, not done.
class PatientClock final : public Clock {
 public:
  double now_s() override { return now_s_; }
  void wait_until(double time_s) override { now_s_ = time_s; }

 private:
  double now_s_ = 0.0;
};

}  // namespace mckibben::bench
