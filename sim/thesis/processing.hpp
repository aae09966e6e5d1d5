// The thesis's data processing (T 3.3, 4.1): from current and counts to pressure, generated force (T 2.8),
// friction force (T 4.1), contact surface (T 4.3) and friction coefficient (T 4.2), contraction and
// relaxation apart. Knows only what the thesis's rig recorded; docs/calibration.md argues the choices.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <controllers/calibration.hpp>
#include <plant/rig.hpp>
#include <sim/data/finding.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::thesis {

/// Where the pressure of a row comes from: the valve's line and the current (T 3.3), or the gauge.
enum class PressureSource { current, gauge };
/// Acceleration in T 4.1: by differences of counts (T 3.3), or left out as small against gravity (T 4.3).
enum class Acceleration { counted, neglected };

struct ProcessingOptions {
  PressureSource pressure = PressureSource::current;
  Acceleration acceleration = Acceleration::counted;
  int lowest_counts = 5;  ///< below, ln e is the rounding of the counter more than the muscle
  int window_ticks = 3;   ///< the muscle moves if, from this many ticks before to as many after,
  int window_counts = 2;  ///< it has gone at least so far the current's way
};

enum class Direction { contraction, relaxation };
inline constexpr std::array directions{Direction::contraction, Direction::relaxation};
constexpr std::string_view name_of(Direction direction) {
  return direction == Direction::contraction ? "contraction" : "relaxation";
}

/// The samples of one direction.
struct Samples {
  std::vector<double> contraction_ratio, pressure_Pa;
  std::vector<double> coefficient;  ///< of friction; positive where friction is against the motion

  std::size_t size() const { return contraction_ratio.size(); }
  void append(const Samples& other);
};

/// Rows that were not used, by the first reason that held.
struct Dropped {
  std::size_t off_the_line = 0;   ///< current where the valve's line is flat, dead below its zero
  std::size_t near_zero = 0;      ///< too few counts for ln e
  std::size_t not_following = 0;  ///< muscle still, or moving against the current's direction
  std::size_t beyond_limit = 0;   ///< contraction ratio a little above e_max, where the braid pulls no more
  std::size_t first_rows = 0;     ///< no differences yet, or the current has not begun to move

  Dropped& operator+=(const Dropped& other);
  std::size_t all() const { return off_the_line + near_zero + beyond_limit + not_following + first_rows; }
};

struct ProcessedRun {
  std::string id;
  double load_kg = 0.0;
  double current_speed_mA_per_s = 0.0;           ///< mean magnitude over whole half periods
  std::array<Samples, 2> samples;                ///< by Direction
  std::array<std::vector<std::size_t>, 2> rows;  ///< of the table, one for each sample
  Dropped dropped;
  std::vector<data::Finding> wrong;  ///< it cannot be of this rig, or the gauge is missing: no samples
  std::string unusable;              ///< why the run cannot be used; empty if it can
  bool still = false;                ///< it cannot because nothing moves enough

  const Samples& of(Direction direction) const { return samples[static_cast<std::size_t>(direction)]; }
};

/// A stretch between two turning points of the current: rows [begin, end], rising or not.
struct HalfPeriod {
  double begin = 0.0, end = 0.0;  ///< rows; the middle of a turning point that lasts
  double change_mA = 0.0;         ///< signed

  double speed_mA_per_s(double tick_s) const;
};
std::vector<HalfPeriod> half_periods(const std::vector<double>& current_mA);

/// The rig's bladder_elasticity, which counts in the force balance; none if it has none.
std::optional<controllers::TubePull> tube_pull_of(const plant::Rig& rig);

ProcessedRun process(const domain::Run& run, const domain::Dataset& dataset,
                     const ProcessingOptions& options);

/// A problem with the whole data set, to be thrown as data::UnfitData.
[[noreturn]] void refuse(const domain::Dataset& dataset, std::string message);

}  // namespace mckibben::thesis
