// A microcontroller on a serial line: text in lines, so that a terminal program can speak it too
// (docs/control.md; scenarios/bench_serial has a sketch for Arduino).
//   to it    mckibben 1 12   version of these lines, and the tick [ms]: what is silent for longer than ten
//   vents
//            ?               the counts, please
//            =12.345         the current [mA] from now on
//   from it  ready 1         to the first
//            1234            to the second
// Each ? has one answer, and nothing else is said: a line that nobody asked for would be taken for an answer,
// and each one after it would be too old. To a valve that takes volts or a pressure: mckibben 2 12 V, ready
// 2, and the commands in that unit.
#pragma once

#include <string>

#include <plant/rig.hpp>
#include <sim/bench/device.hpp>

namespace mckibben::bench {

/// What to change in the shipped sketch and its stage for this rig's commands; empty where nothing.
std::string unusual_stage(const plant::Rig& rig);

class Serial final : public Device {
 public:
  /// Opens the port and greets. Throws DeviceFailure, also if the user stops meanwhile.
  Serial(const std::string& port, const plant::Rig& rig);
  ~Serial() override;

  std::int64_t counts(double now_s) override;
  void put(double current_mA, double now_s) override;

 private:
  void say(const std::string& line);
  std::string heard(double within_s);
  bool read_some();
  [[noreturn]] void fail(const std::string& what) const;

  std::string port_;
  double tick_s_;
  int line_ = -1;
  bool asked_ = false, torn_ = false;  ///< for counts before; a line was not written to its end
  std::string received_, ready_;
};

}  // namespace mckibben::bench
