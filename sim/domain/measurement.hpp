// What was measured of a rig with a clock of its own: at each stamp what drove it and what was read, in
// columns of one length. A reading that is missing is NaN; a column that is not there is empty.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace mckibben::domain {

/// What went before the first stamp: at rest with the first input for long, or on its way.
enum class Start { settled, moving };
constexpr auto names(Start) {
  using enum Start;
  return std::array{std::pair{settled, std::string_view{"settled"}},
                    std::pair{moving, std::string_view{"moving"}}};
}

/// What an input does between two stamps; usually commands stay as they are, pressures and lengths run
/// straight on.
enum class Hold { usual, previous, linear };
constexpr auto names(Hold) {
  using enum Hold;
  return std::array{std::pair{usual, std::string_view{"usual"}},
                    std::pair{previous, std::string_view{"previous"}},
                    std::pair{linear, std::string_view{"linear"}}};
}

/// How a run was recorded.
struct Recorded {
  Start start = Start::settled;
  double skip_s = 0.0;  ///< so much of it is simulated but not judged
  Hold hold = Hold::usual;
};

/// The first state of a run that began on its way, as its first readings have it.
struct FirstState {
  double contraction_ratio = 0.0, speed_per_s = 0.0, acceleration_per_s2 = 0.0;
  std::optional<double> muscle_pressure_Pa{};  ///< where it was read
};

struct Measurement {
  /// Of one muscle: a command to its valve, or its pressure, which then is given and the valve does not
  /// exist.
  struct Side {
    std::vector<double> current_mA;          ///< held from its stamp to the next
    std::vector<double> muscle_pressure_Pa;  ///< read; or given, and straight from stamp to stamp
    bool pressure_is_given = false;
  };
  std::vector<double> time_s;  ///< ascending
  double point_s = 0.0;        ///< rows are settled points, each read at the end of so long; 0: they are not
  std::array<Side, 2> sides;   ///< the second of a pair only
  std::vector<double> contraction_ratio;
  bool length_is_given = false;  ///< the contraction is, straight from stamp to stamp
  std::vector<double> force_N;   ///< of the muscle's cord
  std::vector<double> angle_rad;
  bool angle_in_degrees = false;  ///< as the file has it, and as its gap is told
  bool counted = false;           ///< contraction or angle are counts of the encoder
  Recorded recorded{};
  std::vector<std::size_t> rows{};    ///< stamps that are judged, ascending; none: all
  std::optional<FirstState> first{};  ///< of a run that began on its way; none: its readings have it
};

}  // namespace mckibben::domain
