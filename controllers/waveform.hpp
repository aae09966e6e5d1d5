// Currents given as a function of time, for open-loop experiments: sine, triangle (the
// thesis's control signal, T 4.3), steps, stairs and a chirp;
// and a recorded current, played back as the DAC gave it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <controllers/current_range.hpp>

namespace mckibben::controllers {

// Each waveform has at(time_s): current in mA, right-continuous; make(): a controller that plays it and
// looks neither at counts nor at the target.

/// low + (high - low)/2 (1 - cos(2 pi (t - delay)/period)): begins at low, without a jump in speed.
struct SineCurrent {
  static constexpr std::string_view kind = "sine_current";
  std::string name{kind};
  double low_mA = 4.0, high_mA = 20.0;
  double period_s = 1.0;
  std::optional<double> cycles = std::nullopt;
  double delay_s = 0.0;

  double at(double time_s) const;
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    visit.required("low", self.low_mA, "mA", 0.0, 100.0, "lowest command, where the sine begins");
    visit.required("high", self.high_mA, "mA", 0.0, 100.0, "highest command");
    visit.required("period", self.period_s, "s", 1e-3, 1e6, "time of one cycle");
    visit("cycles", self.cycles, "1", 0.01, 1e6, "number of cycles, then the last value; endless if absent");
    visit("delay", self.delay_s, "s", 0.0, 1e6, "time at low before the sine begins");
  }
  void rules(auto& report) const {
    if (high_mA <= low_mA) report("high", "must be above low");
  }
};

/// From low to high and back at constant speed (T 4.3).
struct TriangleCurrent {
  static constexpr std::string_view kind = "triangle_current";
  std::string name{kind};
  double low_mA = 4.0, high_mA = 20.0;
  std::optional<double> period_s = std::nullopt;
  std::optional<double> speed_mA_per_s = std::nullopt;
  std::optional<double> cycles = std::nullopt;
  double delay_s = 0.0;

  double at(double time_s) const;
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    visit.required("low", self.low_mA, "mA", 0.0, 100.0, "lowest command, where the triangle begins");
    visit.required("high", self.high_mA, "mA", 0.0, 100.0, "highest command");
    visit("period", self.period_s, "s", 1e-3, 1e6, "time from low to high and back; or give speed");
    visit("speed", self.speed_mA_per_s, "mA/s", 1e-6, 1e5, "speed of the command; or give period");
    visit("cycles", self.cycles, "1", 0.01, 1e6, "number of cycles, then the last value; endless if absent");
    visit("delay", self.delay_s, "s", 0.0, 1e6, "time at low before the triangle begins");
  }
  void rules(auto& report) const {
    if (high_mA <= low_mA) report("high", "must be above low");
    if (period_s.has_value() == speed_mA_per_s.has_value())
      report(period_s ? "speed" : "period", "give either period or speed, one of the two");
  }
};

/// From this time on, this current.
struct CurrentMove {
  double at_s = 0.0;
  double to_mA = 4.0;

  static void fields(auto& self, auto& visit) {
    visit.required("at", self.at_s, "s", 0.0, 1e6, "time of the step");
    visit.required("to", self.to_mA, "mA", 0.0, 100.0, "command from then on");
  }
};

/// Currents held one after the other.
struct StepCurrent {
  static constexpr std::string_view kind = "step_current";
  std::string name{kind};
  std::optional<double> start_mA = std::nullopt;
  std::vector<CurrentMove> moves;

  void follow(const CurrentRange& range);
  /// Only once the start is known.
  double at(double time_s) const;
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    visit("start", self.start_mA, "mA", 0.0, 100.0,
          "command before the first step; the valve's zero_command if absent");
    visit.required("moves", self.moves, "steps in order of time; an empty list holds the start");
  }
  void rules(auto& report) const {
    for (std::size_t i = 1; i < moves.size(); ++i)
      if (moves[i].at_s <= moves[i - 1].at_s) return report("moves", "times must ascend");
  }
};

/// Up from low to high in equal steps and down again, each level held; low afterwards.
struct StairCurrent {
  static constexpr std::string_view kind = "stair_current";
  std::string name{kind};
  double low_mA = 4.0, high_mA = 20.0;
  int steps = 8;
  double dwell_s = 1.0;

  double at(double time_s) const;
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    visit.required("low", self.low_mA, "mA", 0.0, 100.0, "lowest command, the first level");
    visit.required("high", self.high_mA, "mA", 0.0, 100.0, "highest command");
    visit.required("steps", self.steps, 1, 10000, "number of steps from low to high");
    visit.required("dwell", self.dwell_s, "s", 1e-3, 1e6, "time at each level");
  }
  void rules(auto& report) const {
    if (high_mA <= low_mA) report("high", "must be above low");
  }
};

/// mean + amplitude sin(phase) between low and high; the frequency goes linearly from first to last.
struct ChirpCurrent {
  static constexpr std::string_view kind = "chirp_current";
  std::string name{kind};
  double low_mA = 4.0, high_mA = 20.0;
  double first_frequency_Hz = 0.1, last_frequency_Hz = 1.0;
  double lasting_s = 60.0;

  double at(double time_s) const;
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    visit.required("low", self.low_mA, "mA", 0.0, 100.0, "lowest command; the chirp begins midway");
    visit.required("high", self.high_mA, "mA", 0.0, 100.0, "highest command");
    visit.required("first_frequency", self.first_frequency_Hz, "Hz", 0.0, 1e3, "frequency at the beginning");
    visit.required("last_frequency", self.last_frequency_Hz, "Hz", 0.0, 1e3, "frequency at the end");
    visit.required("lasting", self.lasting_s, "s", 1e-3, 1e6, "length of the chirp, then the last value");
  }
  void rules(auto& report) const {
    if (high_mA <= low_mA) report("high", "must be above low");
  }
};

/// A current read from a table: one sample each tick, then the last one.
/// It is what a DAC gave, so it is not rounded again.
struct RecordedCurrent {
  static constexpr std::string_view kind = "recorded_current";
  std::string name{kind};
  std::string file;
  std::string column = "current_mA";
  std::vector<double> samples_mA;  ///< filled from the file by whoever can read it, before make()

  /// Throws std::invalid_argument if there are no samples.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    visit.required("file", self.file, "CSV table, one row each tick");
    visit("column", self.column,
          "heading of the column that holds the command; the rig's own, current_mA or command_V, if absent");
  }
  void rules(auto& report) const {
    if (file.empty()) report("file", "must name a file");
  }
};

}  // namespace mckibben::controllers
