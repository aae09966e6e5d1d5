// A rig that is driven by hand: stepped tick by tick under currents that sliders or a sweep give, while its
// load and its effects are changed. It knows no clock; what makes it run in real time is host.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <plant/instruments.hpp>
#include <plant/signals.hpp>
#include <sim/live/switches.hpp>
#include <sim/ride/ride.hpp>

namespace mckibben::live {

using plant::Sample;

/// How the command goes by itself, between two ends, for ever.
struct Sweep {
  enum class Shape { sine, triangle, stairs };
  Shape shape = Shape::sine;
  double low_mA = 4.0, high_mA = 20.0, period_s = 10.0;

  static constexpr int stairs_up = 8;  ///< and as many down
  double at(double time_s) const;
  /// When it passes this command on its way up; of stairs, when they begin.
  double when(double current_mA) const;
};

class Session {
 public:
  using Commands = std::array<double, 2>;  ///< in what the valve takes, the second of a pair

  /// At rest at the command of no pressure. The rig must lift a load, and bear this one (domain::too_heavy),
  /// or have two muscles; then the load means nothing.
  Session(const plant::Rig& rig, double load_kg);

  // What acts from the next tick on. These say why they refuse, and then nothing has changed; else they are
  // empty.
  std::string set_command(double command, std::int64_t muscle = 1);  ///< by hand: a sweep ends
  /// Goes on from the present command, if it is within. Of a pair muscle 2 goes against muscle 1.
  std::string set_sweep(const Sweep& sweep);
  std::string set_load(double load_kg);
  /// What can be hung on, as far as the taut threads bear it.
  struct Loads {
    double least_kg, most_kg;
  };
  Loads loads() const;
  std::string set_effect(std::string_view name, bool on, double size, double shape);
  std::string hide_effect(std::string_view name, double size, double shape);  ///< Switches::hide

  void show_effect() { switches_.show(); }

  /// At rest under the present command, or under a sweep's first one, for the rig's settling time; the time
  /// is 0.
  void start_over();

  /// One tick: the sample of its beginning. Where the integration gives up, `failure` says so, and nothing
  /// moves until it starts over.
  const Sample& step();

  const Sample& now() const { return sample_; }
  const std::string& failure() const { return failure_; }
  /// At rest since it started: nothing has been moved or switched.
  bool untouched() const { return untouched_; }
  double tick_s() const { return rig_.tick_s; }
  bool pair() const { return rig_.pair() != nullptr; }
  const Commands& wanted() const { return commands_; }
  double load_kg() const { return load_kg_; }
  const std::optional<Sweep>& sweep() const { return sweep_; }
  const Switches& switches() const { return switches_; }
  /// The rig as it is now, and as its owner knows it.
  const plant::Rig& rig() const { return rig_; }

 private:
  void go_on();
  template <class Work>
  void guarded(const Work& work);
  std::string out_of_dac(const char* of_current, double command) const;
  Commands wanted_at(double time_s) const;
  void hold(const Commands& wanted);
  double time_s() const { return static_cast<double>(tick_) * rig_.tick_s; }
  void measure();

  Switches switches_;
  plant::Rig rig_;
  double load_kg_;
  Commands commands_;
  std::optional<Sweep> sweep_;
  double sweep_begin_s_ = 0.0;
  std::int64_t tick_ = 0;
  bool untouched_ = true;
  std::string failure_;
  plant::PositionReader reader_;
  ride::Drive drive_;
  ride::Ride ride_;
  Sample sample_;
};

}  // namespace mckibben::live
