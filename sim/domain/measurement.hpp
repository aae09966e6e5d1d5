// What was measured of a rig with a clock of its own: at each stamp what drove it and what was read, in
// columns of one length. A reading that is missing is NaN.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <sim/domain/columns.hpp>

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
  double bridge_s = 0.25;  ///< that a given input may lack
};

/// The first state of a run that began on its way, as its first readings have it.
struct FirstState {
  double contraction_ratio = 0.0, speed_per_s = 0.0, acceleration_per_s2 = 0.0;
  std::optional<double> muscle_pressure_Pa{};  ///< where it was read
};

/// What was given or read of a signal, a value each stamp, in the units that the program calculates in.
struct MeasuredColumn {
  plant::Channel channel;
  bool given = false;  ///< it drives the rig, and what is upstream of it does not exist
  std::vector<double> values{};

  /// Held from its stamp to the next; all else that is given runs straight.
  bool is_command() const { return channel.signal->in_dataset == command_key; }
};

/// Whether one of the values is there.
bool is_read(const std::vector<double>& values);

struct Measurement {
  std::vector<double> time_s;  ///< ascending
  double point_s = 0.0;        ///< rows are settled points, each read at the end of so long; 0: they are not
  std::vector<MeasuredColumn> columns;  ///< each signal at most once
  bool angle_in_degrees = false;        ///< as the file has it, and as its gap is told
  bool counted = false;                 ///< contraction or angle are counts of the encoder
  bool own_clocks = false;              ///< of columns: at many stamps only some have a value
  Recorded recorded{};
  std::vector<std::size_t> rows{};  ///< stamps that are judged, ascending; none: all
  std::optional<double>
      filled_Pa{};  ///< what a sealed muscle held at first, where it was read; none: likewise
  std::optional<FirstState> first{};  ///< of a run that began on its way; none: its readings have it

  // By the key in a data set's `columns`, without the muscle's number: of muscle 1 or of one muscle, or of 2.
  bool gives(std::string_view key, std::size_t muscle = 1) const;
  /// Empty if it was not given, not read, neither.
  const std::vector<double>& given(std::string_view key, std::size_t muscle = 1) const;
  const std::vector<double>& read(std::string_view key, std::size_t muscle = 1) const;
  const std::vector<double>& values(std::string_view key, std::size_t muscle = 1) const;
  /// To be filled; a further column moves those that there are. `muscle`: 1 or 2 of a pair's.
  std::vector<double>& give(std::string_view key, std::size_t muscle = 0);
  std::vector<double>& take(std::string_view key, std::size_t muscle = 0);

  /// False where a command has a stamp of its own, and nothing is read.
  bool has_row(std::size_t stamp) const;
  bool gives_length() const { return gives("contraction"); }
  /// What of a muscle's pressure there is upstream of it: its own, that of its valve, or none.
  plant::GivenPressure given_pressure(std::size_t muscle = 1) const;
  bool reads_only_pressures() const;
  bool gives_outer_force() const { return gives("joint_force") || gives("joint_torque"); }
};

}  // namespace mckibben::domain
