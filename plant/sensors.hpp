// A rig's sensors by their data sheets: a list, one for each signal that is read. What kinds there are, what
// each may read and which numbers it has stands in `sensor_kinds`.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <plant/names.hpp>

namespace mckibben::plant {

/// What a sensor can read, spelled as its signal (signals.hpp); the position in any of its forms.
enum class Sensed { contraction, muscle_pressure, valve_pressure, force };
constexpr auto names(Sensed) {
  using enum Sensed;
  return std::array{std::pair{contraction, std::string_view{"contraction"}},
                    std::pair{muscle_pressure, std::string_view{"muscle_pressure"}},
                    std::pair{valve_pressure, std::string_view{"valve_pressure"}},
                    std::pair{force, std::string_view{"force"}}};
}

/// A number for each of them.
struct BySensed {
  std::array<double, names(Sensed{}).size()> values{};

  double& operator[](Sensed signal) { return values[static_cast<std::size_t>(signal)]; }
  double operator[](Sensed signal) const { return values[static_cast<std::size_t>(signal)]; }
};

enum class SensorKind { encoder, laser, linear_encoder, potentiometer, load_cell, gauge };
constexpr auto names(SensorKind) {
  using enum SensorKind;
  return std::array{std::pair{encoder, std::string_view{"encoder"}},
                    std::pair{laser, std::string_view{"laser"}},
                    std::pair{linear_encoder, std::string_view{"linear_encoder"}},
                    std::pair{potentiometer, std::string_view{"potentiometer"}},
                    std::pair{load_cell, std::string_view{"load_cell"}},
                    std::pair{gauge, std::string_view{"gauge"}}};
}

/// How an encoder's pulses are counted: floor of the position, or the thesis's two crosswise counters
/// (T 3.1).
enum class EncoderWiring { ideal, crosswise };
constexpr auto names(EncoderWiring) {
  using enum EncoderWiring;
  return std::array{std::pair{ideal, std::string_view{"ideal"}},
                    std::pair{crosswise, std::string_view{"crosswise"}}};
}

/// What is the same of all sensors of a kind.
struct SensorSheet {
  SensorKind kind;
  std::array<std::optional<Sensed>, 2> reads;
  std::string_view unit{};        ///< of its numbers; none: it has a disk, and counts pulses
  double largest = 0.0;           ///< of its steps and errors
  double range = 0.0;             ///< furthest end of its range
  bool needs_resolution = false;  ///< readings are whole steps
};

inline constexpr std::array sensor_kinds{
    SensorSheet{SensorKind::encoder, {Sensed::contraction}},
    SensorSheet{SensorKind::laser, {Sensed::contraction}, "m", 0.1, 10.0, true},
    SensorSheet{SensorKind::linear_encoder, {Sensed::contraction}, "m", 0.1, 10.0, true},
    SensorSheet{SensorKind::potentiometer, {Sensed::contraction}, "rad", 0.1, 10.0, true},
    SensorSheet{SensorKind::load_cell, {Sensed::force}, "N", 1e3, 1e6},
    SensorSheet{SensorKind::gauge, {Sensed::muscle_pressure, Sensed::valve_pressure}, "Pa", 1e5, 1e8},
};

constexpr const SensorSheet& sheet_of(SensorKind kind) {
  return *std::find_if(sensor_kinds.begin(), sensor_kinds.end(),
                       [&](const SensorSheet& sheet) { return sheet.kind == kind; });
}
constexpr bool may_read(SensorKind kind, Sensed signal) {
  const auto& reads = sheet_of(kind).reads;
  return std::find(reads.begin(), reads.end(), signal) != reads.end();
}

/// One sensor. Numbers are in its kind's unit. Readings are whole steps of `resolution`, the nearest one, and
/// stay between the ends of its range.
struct Sensor {
  Sensed signal = Sensed::contraction;
  SensorKind kind = SensorKind::encoder;
  double resolution = 0.0;  ///< of what digitises it, too; 0: no steps
  double noise = 0.0;       ///< rms
  double accuracy = 0.0;    ///< rms
  std::optional<double> lowest{}, highest{};
  std::optional<double> rate_Hz{}, delay_s{};
  // Of an encoder (T 3.1).
  int pulses_per_turn = 720;
  double wheel_ratio = 2.0;
  EncoderWiring wiring = EncoderWiring::ideal;

  const SensorSheet& sheet() const { return sheet_of(kind); }
  bool counts_pulses() const { return sheet().unit.empty(); }
  /// When the reading was taken that it has at an instant; before its delay.
  double taken_s(double now_s) const {
    constexpr double same_instant = 1e-6;  // of the time between two readings
    return rate_Hz ? std::floor(now_s * *rate_Hz + same_instant) / *rate_Hz : now_s;
  }
  bool is_late() const { return rate_Hz || delay_s; }
  double late_s(double now_s) const { return std::max(now_s - taken_s(now_s), 0.0) + delay_s.value_or(0.0); }

  /// What one of a position sensor's numbers is as a rise of the load [m].
  double rise_m(double wheel_radius_m) const {
    return kind == SensorKind::potentiometer ? wheel_radius_m : 1.0;
  }

  /// Without signal and kind, which decide which fields there are.
  static void fields(auto& self, auto& visit) {
    const SensorSheet& sheet = self.sheet();
    const std::string_view unit = sheet.unit;
    if (self.counts_pulses()) {
      visit("pulses_per_turn", self.pulses_per_turn, 1, 10000000,
            "counts per turn of the disk, after quadrature");
      visit("wheel_ratio", self.wheel_ratio, "1", 0.01, 1000.0,
            "turns of the disk for one turn of the joint");
      visit("wiring", self.wiring,
            "ideal: floor of the position; crosswise: the thesis's two gated counters");
    } else {
      visit("resolution", self.resolution, unit, sheet.needs_resolution ? 1e-9 : 0.0, sheet.largest,
            sheet.needs_resolution
                ? "smallest step of its readings, by which the position is counted; an analogue one has that "
                  "of its converter"
                : "smallest step of its readings, of the converter's as well; 0 for none");
      visit("noise", self.noise, unit, 0.0, sheet.largest, "rms of its readings from one to the next");
      visit("accuracy", self.accuracy, unit, 0.0, sheet.largest,
            "rms by which readings are off that do not scatter: linearity, hysteresis, drift; counted in a "
            "diagnosis's noise floor, not simulated");
      visit("lowest", self.lowest, unit, -sheet.range, sheet.range,
            "the lowest that it reads, from rest; no end if left out");
      visit("highest", self.highest, unit, -sheet.range, sheet.range,
            "the highest that it reads, from rest; no end if left out");
    }
    visit("rate", self.rate_Hz, "Hz", 0.01, 1e6,
          "how often it takes a reading, which it shows until the next; if left out, whenever it is read");
    visit("delay", self.delay_s, "s", 0.0, 10.0, "how old a reading is when it is shown; none if left out");
  }
  void rules(auto& report) const {
    if (counts_pulses()) return;
    if (sheet().needs_resolution && resolution == 0.0)
      report("resolution", "a sensor's resolution must be said; an analogue one has that of its converter");
    if (lowest && highest && *highest <= *lowest) report("highest", "must be above lowest");
    if (lowest && *lowest > 0.0) report("lowest", "must not be above the rest, which is 0");
    if (highest && *highest <= 0.0) report("highest", "must be above the rest, which is 0");
  }
};

/// The sensors of a rig, at most one for each signal. The first reads the position, which every rig has.
struct Sensors : std::vector<Sensor> {
  Sensors() : std::vector<Sensor>(1) {}

  const Sensor& position() const { return front(); }
  Sensor& position() { return front(); }
  /// What reads a signal; null if nothing does.
  const Sensor* of(Sensed signal) const {
    const auto found = std::find_if(begin(), end(), [&](const Sensor& one) { return one.signal == signal; });
    return found == end() ? nullptr : &*found;
  }
  Sensor* of(Sensed signal) { return const_cast<Sensor*>(std::as_const(*this).of(signal)); }
  /// In place of what read its signal before.
  void put(const Sensor& sensor) {
    if (Sensor* before = of(sensor.signal))
      *before = sensor;
    else
      push_back(sensor);
  }
  void remove(Sensed signal) {
    std::erase_if(*this, [&](const Sensor& one) { return one.signal == signal; });
  }
};

inline Sensor gauge(double resolution_Pa = 0.0) {
  return {.signal = Sensed::muscle_pressure, .kind = SensorKind::gauge, .resolution = resolution_Pa};
}

}  // namespace mckibben::plant
