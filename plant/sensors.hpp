// Sensors by their data sheets, in place of the optical encoder or beside it: what reads the position of the
// joint, and a load cell on the muscle's cord.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace mckibben::plant {

/// What reads the position: the thesis's encoder on the joint; a laser or a linear encoder, which see the
/// load's height; or a potentiometer on the joint's axis, which sees its angle.
enum class SensorKind { encoder, laser, linear_encoder, potentiometer };
constexpr auto names(SensorKind) {
  using enum SensorKind;
  return std::array{std::pair{encoder, std::string_view{"encoder"}},
                    std::pair{laser, std::string_view{"laser"}},
                    std::pair{linear_encoder, std::string_view{"linear_encoder"}},
                    std::pair{potentiometer, std::string_view{"potentiometer"}}};
}

/// Another sensor of position than the encoder. Numbers are heights in m; of a potentiometer angles in rad.
/// Readings are whole steps of `resolution`, the nearest one, and stay between the ends of its range.
struct Sensor {
  SensorKind kind = SensorKind::encoder;
  double resolution = 0.0;  ///< of what digitises it, too
  double noise = 0.0;       ///< rms
  double accuracy = 0.0;    ///< rms
  std::optional<double> lowest, highest;

  bool absent() const { return kind == SensorKind::encoder; }
  bool turns() const { return kind == SensorKind::potentiometer; }
  /// What one of its numbers is as a rise of the load [m].
  double rise_m(double wheel_radius_m) const { return turns() ? wheel_radius_m : 1.0; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.required("kind", self.kind, "another sensor than the encoder, by its data sheet");
    const std::string_view unit = self.turns() ? "rad" : "m";
    visit("resolution", self.resolution, unit, 0.0, 0.1,
          "smallest step of its readings, of the converter's as well; of a potentiometer this and the "
          "following are angles");
    visit("noise", self.noise, unit, 0.0, 0.1, "rms of its readings from one to the next");
    visit("accuracy", self.accuracy, unit, 0.0, 0.1,
          "rms by which readings are off that do not scatter: linearity, drift; counted in a diagnosis's "
          "noise floor, not simulated");
    visit("lowest", self.lowest, unit, -10.0, 10.0,
          "the lowest that it reads, from rest; no end if left out");
    visit("highest", self.highest, unit, -10.0, 10.0,
          "the highest that it reads, from rest; no end if left out");
  }
  template <class Report>
  void rules(Report& report) const {
    if (absent()) return;
    if (resolution == 0.0)
      report("resolution", "a sensor's resolution must be said; an analogue one has that of its converter");
    if (lowest && highest && *highest <= *lowest) report("highest", "must be above lowest");
    if (lowest && *lowest > 0.0) report("lowest", "must not be above the rest, which is 0");
    if (highest && *highest <= 0.0) report("highest", "must be above the rest, which is 0");
  }
};

/// A load cell between muscle and cord, if one is fitted. It is recorded; controllers do not see it.
struct LoadCell {
  bool fitted = false;
  double resolution_N = 0.0, noise_N = 0.0, accuracy_N = 0.0;
  std::optional<double> highest_N;

  bool absent() const { return !fitted; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("fitted", self.fitted, "whether the cord's force is recorded as a load cell would show it");
    visit("resolution", self.resolution_N, "N", 0.0, 1e3, "smallest step of its readings; 0 for none");
    visit("noise", self.noise_N, "N", 0.0, 1e3, "rms of its readings from one to the next");
    visit("accuracy", self.accuracy_N, "N", 0.0, 1e3,
          "rms by which readings are off that do not scatter: linearity, hysteresis, drift; counted in a "
          "diagnosis's noise floor, not simulated");
    visit("highest", self.highest_N, "N", 1e-3, 1e6, "the highest force that it reads; no end if left out");
  }
};

}  // namespace mckibben::plant
