// Every quantity of a rig that is recorded, shown or given, each declared once: key, unit, words, and how a
// row of a recording has it. Tables, pages, Python, FMUs and data sets read this list; the recipe for a
// further signal is in docs/add_a_part.md.
//
//   Sample    the row of a recording: a rig at one instant, in the units that the program calculates in
//   Signal    a quantity            Channel    a signal of the rig's joint, or of one of its muscles
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plant/constants.hpp>
#include <plant/rig.hpp>
#include <plant/state.hpp>

namespace mckibben::plant {

/// One muscle at an instant. Pressures gauge, forces positive where they shorten it.
struct SideSample {
  double current_mA = 0.0;    ///< as the DAC gives it, from here to the next row
  double reference_Pa = 0.0;  ///< that it asks of the valve
  double contraction_ratio = 0.0;
  double braid_force_N = 0.0, friction_force_N = 0.0, effects_pull_N = 0.0;
  double cord_force_N = 0.0;                            ///< T, the sum
  double cord_stretch_m = 0.0, cord_end_m_per_s = 0.0;  ///< of a cord that stretches, and of the muscle's end
  double inflow_kg_per_s = 0.0;                         ///< through the hose, or what keeps a given pressure
  BySensed shown{};                                     ///< by sensors; the value itself where none reads it
};

/// A rig at an instant, before what is given changes. True values, but for `counts`, `read_...` and
/// `shown`.
struct Sample : SideSample {
  double time_s = 0.0;
  State<double> state{};
  std::int64_t counts = 0;
  double read_ratio = 0.0, read_angle_rad = 0.0;        ///< by these counts
  double misread_ratio = 0.0;                           ///< what an encoder shows besides e, before it counts
  double angle_rad = 0.0, angle_speed_rad_per_s = 0.0;  ///< of the joint of a pair or a lever
  double supply_Pa = 0.0;                               ///< before the valve
  double torque_N_m = 0.0, stiffness_N_m_per_rad = 0.0;
  double joint_force_N = 0.0, joint_torque_N_m = 0.0;  ///< from outside, from here to the next row
  SideSample opposite{};                               ///< muscle 2 of a pair

  /// Of what is remembered that of cords.
  Memory<double> cords() const {
    Memory<double> all{};
    all.side[cord_stretch] = cord_stretch_m;
    all.side[cord_end_speed] = cord_end_m_per_s;
    all.opposite[cord_stretch] = opposite.cord_stretch_m;
    all.opposite[cord_end_speed] = opposite.cord_end_m_per_s;
    return all;
  }
  double shown_ratio() const { return state.joint.contraction_ratio + misread_ratio; }
  const SideSample& side(std::size_t muscle) const { return muscle == 2 ? opposite : *this; }
  const SideState<double>& side_state(std::size_t muscle) const {
    return muscle == 2 ? state.opposite : state.side;
  }
};

/// What drives a rig, where it is not a current to the valve of one muscle that lifts a load.
struct Driven {
  bool pair = false, length = false;        ///< two muscles; the length of one is given
  std::array<GivenPressure, 2> pressure{};  ///< of each muscle: that of its valve or its own is given
  bool supply = false;                      ///< the pressure of the supply is given
  bool joint_force = false;  ///< a force, of a joint with an angle a torque, acts on it from outside
  bool force = false;        ///< the force of the cord is measured
};

/// A unit of columns: as UDUNITS-2 spells it, at the end of a column's name, and how much one is in the
/// units that the program calculates in. Pages may show another one.
struct Unit {
  std::string_view name, ending;
  double size = 1.0;
  std::string_view on_page{};
  double page_size = 1.0;
};

enum class Kind { time, input, state, reading };
enum class Part { joint, muscle };
/// What a rig must have for a signal to exist. Angles are read of two muscles or a lever, heights of others:
/// outer torques are of those, forces of these. A cord is one that stretches, a tank's pressure sinks.
enum class Needs {
  nothing,
  height,
  one_muscle,
  angle,
  pair,
  command,
  valve,
  sensor,
  cord,
  tank,
  given_supply,
  outer_force,
  outer_torque
};
/// Whether it is a column of the files of runs; a force only of pairs, and where it is measured or a length
/// is given; what effects add, of muscles that have any. Pages, Python and FMUs have all signals.
enum class InFiles { yes, no, measured_force, with_effects };

struct Signal {
  std::string_view key;
  Unit unit;
  std::string_view words;
  Kind kind = Kind::state;
  Part part = Part::joint;
  Needs needs = Needs::nothing;
  double (*value)(const Sample& row, std::size_t muscle);  ///< muscle 1 or 2
  InFiles in_files = InFiles::yes;
  bool with_next = false;  ///< of two muscles: in one group with the signal that follows
  // Of a data set's `columns:`.
  bool may_be_given = false;         ///< it may drive a simulation; of an input: it does
  std::string_view in_dataset{};     ///< its key
  std::string_view dataset_words{};  ///< what the key means, where `words` do not say it
  bool must_be_named = false;        ///< a column that has our name by chance is not meant
  std::string_view of_two = key;     ///< its key where there are two muscles
  std::string_view reads{};  ///< of a reading: the key of what is read; a data set's column has its name
  bool whole = false;        ///< an integer
  std::optional<CommandUnit> of_commands_in{};  ///< of rigs whose valves take this
};

namespace units {
inline constexpr Unit s{"s", "s"}, bar{"bar", "bar", Pa_per_bar}, m{"m", "m"}, N{"N", "N"},
    ratio{"1", "", 1.0, "contraction ratio"}, count{"1", ""}, per_s{"s-1", "per_s"},
    rad{"rad", "rad", 1.0, "deg", degree_rad}, rad_per_s{"rad s-1", "rad_per_s"},
    kg_per_s{"kg s-1", "kg_per_s"}, N_m{"N m", "Nm", 1.0, "N m"},
    N_m_per_rad{"N m rad-1", "Nm_per_rad", 1.0, "N m/rad"};
}  // namespace units

/// To the valve, natively in what it takes.
constexpr Signal command_signal(CommandUnit unit, std::string_view key, std::string_view words) {
  return {.key = key,
          .unit = {name_of(unit), name_of(unit)},
          .words = words,
          .kind = Kind::input,
          .part = Part::muscle,
          .needs = Needs::command,
          .value = [](const Sample& row, std::size_t i) { return row.side(i).current_mA; },
          .may_be_given = true,
          .in_dataset = "command",
          .dataset_words = "command to the valve of the muscle, in mA, V or bar",
          .of_commands_in = unit};
}

/// In the order of the columns of a file.
inline constexpr auto signals = std::to_array<Signal>({
    {.key = "time",
     .unit = units::s,
     .words = "time",
     .kind = Kind::time,
     .value = [](const Sample& row, std::size_t) { return row.time_s; },
     .in_dataset = "time",
     .dataset_words = "time since the first row"},
    command_signal(CommandUnit::mA, "current", "current to the valve"),
    command_signal(CommandUnit::V, "command", "voltage to the valve"),
    command_signal(CommandUnit::bar, "command", "commanded pressure"),
    {.key = "contraction_ratio",
     .unit = units::ratio,
     .words = "contraction ratio",
     .needs = Needs::one_muscle,
     .value = [](const Sample& row, std::size_t) { return row.state.joint.contraction_ratio; },
     .may_be_given = true,
     .in_dataset = "contraction",
     .dataset_words = "height of the load: ratio, angle of the wheel, travel of the rope, or encoder counts"},
    {.key = "contraction_speed",
     .unit = units::per_s,
     .words = "speed of the contraction ratio",
     .needs = Needs::one_muscle,
     .value = [](const Sample& row, std::size_t) { return row.state.joint.contraction_speed_per_s; }},
    {.key = "angle",
     .unit = units::rad,
     .words = "joint angle, positive as muscle 1 contracts",
     .needs = Needs::angle,
     .value = [](const Sample& row, std::size_t) { return row.angle_rad; },
     .in_dataset = "angle"},
    {.key = "angle_speed",
     .unit = units::rad_per_s,
     .words = "speed of the joint angle",
     .needs = Needs::angle,
     .value = [](const Sample& row, std::size_t) { return row.angle_speed_rad_per_s; }},
    {.key = "reference_pressure",
     .unit = units::bar,
     .words = "commanded gauge pressure",
     .part = Part::muscle,
     .needs = Needs::command,
     .value = [](const Sample& row, std::size_t i) { return row.side(i).reference_Pa; },
     .in_files = InFiles::no},
    {.key = "valve_pressure",
     .unit = units::bar,
     .words = "gauge pressure in the valve",
     .part = Part::muscle,
     .needs = Needs::valve,
     .value = [](const Sample& row, std::size_t i) { return row.side_state(i).valve_pressure_Pa; },
     .with_next = true,
     .may_be_given = true,
     .in_dataset = "valve_pressure",
     .dataset_words = "gauge pressure between the valve and the hose of the muscle",
     .must_be_named = true},
    {.key = "muscle_pressure",
     .unit = units::bar,
     .words = "gauge pressure in the muscle",
     .part = Part::muscle,
     .value = [](const Sample& row, std::size_t i) { return row.side_state(i).muscle_pressure_Pa; },
     .may_be_given = true,
     .in_dataset = "muscle_pressure"},
    {.key = "supply_pressure",
     .unit = units::bar,
     .words = "gauge pressure of the supply, which sinks as air is drawn",
     .needs = Needs::tank,
     .value = [](const Sample& row, std::size_t) { return row.supply_Pa; }},
    {.key = "force",
     .unit = units::N,
     .words = "force of the cord",
     .part = Part::muscle,
     .value = [](const Sample& row, std::size_t i) { return row.side(i).cord_force_N; },
     .in_files = InFiles::measured_force,
     .in_dataset = "force",
     .of_two = "tension"},
    {.key = "joint_force",
     .unit = units::N,
     .words = "force on the cord from outside, positive where it lengthens the muscle, as a load does",
     .kind = Kind::input,
     .needs = Needs::outer_force,
     .value = [](const Sample& row, std::size_t) { return row.joint_force_N; },
     .may_be_given = true,
     .in_dataset = "joint_force",
     .must_be_named = true},
    {.key = "joint_torque",
     .unit = units::N_m,
     .words = "torque on the joint from outside, positive where it turns as muscle 1 does that contracts",
     .kind = Kind::input,
     .needs = Needs::outer_torque,
     .value = [](const Sample& row, std::size_t) { return row.joint_torque_N_m; },
     .may_be_given = true,
     .in_dataset = "joint_torque",
     .must_be_named = true},
    {.key = "supply_pressure",
     .unit = units::bar,
     .words = "gauge pressure of the supply as it was measured",
     .kind = Kind::input,
     .needs = Needs::given_supply,
     .value = [](const Sample& row, std::size_t) { return row.supply_Pa; },
     .may_be_given = true,
     .in_dataset = "supply_pressure",
     .must_be_named = true},
    {.key = "encoder_contraction_ratio",
     .unit = units::ratio,
     .words = "contraction ratio as it is counted",
     .kind = Kind::reading,
     .needs = Needs::height,
     .value = [](const Sample& row, std::size_t) { return row.read_ratio; },
     .reads = "contraction_ratio"},
    {.key = "encoder_angle",
     .unit = units::rad,
     .words = "joint angle as it is counted",
     .kind = Kind::reading,
     .needs = Needs::angle,
     .value = [](const Sample& row, std::size_t) { return row.read_angle_rad; },
     .reads = "angle"},
    {.key = "counts",
     .unit = units::count,
     .words = "counts of the encoder, or steps of the sensor in its place",
     .kind = Kind::reading,
     .value = [](const Sample& row, std::size_t) { return static_cast<double>(row.counts); },
     .in_files = InFiles::no,
     .whole = true},
    {.key = "contraction_ratio",
     .unit = units::ratio,
     .words = "contraction ratio",
     .part = Part::muscle,
     .needs = Needs::pair,
     .value = [](const Sample& row, std::size_t i) { return row.side(i).contraction_ratio; }},
    {.key = "cord_stretch",
     .unit = units::m,
     .words = "stretch of the cord of the muscle, which contracts by as much more than the joint lets it",
     .part = Part::muscle,
     .needs = Needs::cord,
     .value = [](const Sample& row, std::size_t i) { return row.side(i).cord_stretch_m; }},
    {.key = "muscle_contraction_ratio",
     .unit = units::ratio,
     .words = "contraction ratio of the muscle itself, on a cord that stretches",
     .needs = Needs::cord,
     .value = [](const Sample& row, std::size_t) { return row.contraction_ratio; }},
    {.key = "bristle",
     .unit = units::m,
     .words = "deflection of the bristles of thread friction",
     .part = Part::muscle,
     .value = [](const Sample& row, std::size_t i) { return row.side_state(i).bristle_m; }},
    {.key = "braid_force",
     .unit = units::N,
     .words = "force of the braid, positive where it shortens the muscle",
     .part = Part::muscle,
     .value = [](const Sample& row, std::size_t i) { return row.side(i).braid_force_N; }},
    {.key = "friction_force",
     .unit = units::N,
     .words = "force of thread friction, positive where it shortens the muscle",
     .part = Part::muscle,
     .value = [](const Sample& row, std::size_t i) { return row.side(i).friction_force_N; }},
    {.key = "effects_pull",
     .unit = units::N,
     .words = "force of effects, positive where it shortens the muscle",
     .part = Part::muscle,
     .value = [](const Sample& row, std::size_t i) { return row.side(i).effects_pull_N; },
     .in_files = InFiles::with_effects},
    {.key = "inflow",
     .unit = units::kg_per_s,
     .words = "air flow into the muscle",
     .part = Part::muscle,
     .value = [](const Sample& row, std::size_t i) { return row.side(i).inflow_kg_per_s; },
     .in_files = InFiles::no},
    {.key = "torque",
     .unit = units::N_m,
     .words = "torque of the muscles on the joint",
     .needs = Needs::angle,
     .value = [](const Sample& row, std::size_t) { return row.torque_N_m; },
     .in_files = InFiles::no},
    {.key = "stiffness",
     .unit = units::N_m_per_rad,
     .words = "stiffness of the joint at these pressures",
     .needs = Needs::pair,
     .value = [](const Sample& row, std::size_t) { return row.stiffness_N_m_per_rad; }},
    {.key = "gauge_pressure",
     .unit = units::bar,
     .words = "gauge pressure in the muscle as measured",
     .kind = Kind::reading,
     .part = Part::muscle,
     .needs = Needs::sensor,
     .value = [](const Sample& row, std::size_t i) { return row.side(i).shown[Sensed::muscle_pressure]; },
     .reads = "muscle_pressure"},
    {.key = "gauge_valve_pressure",
     .unit = units::bar,
     .words = "gauge pressure in the valve as measured",
     .kind = Kind::reading,
     .part = Part::muscle,
     .needs = Needs::sensor,
     .value = [](const Sample& row, std::size_t i) { return row.side(i).shown[Sensed::valve_pressure]; },
     .reads = "valve_pressure"},
    {.key = "cell_force",
     .unit = units::N,
     .words = "force of the cord as measured",
     .kind = Kind::reading,
     .part = Part::muscle,
     .needs = Needs::sensor,
     .value = [](const Sample& row, std::size_t i) { return row.side(i).shown[Sensed::force]; },
     .of_two = "cell_tension",
     .reads = "force"},
});

struct Channel {
  const Signal* signal;
  std::size_t muscle = 0;  ///< 1 or 2 of a pair's; 0 of a joint's, and where there is one muscle

  std::string key() const;              ///< muscle_pressure_1
  std::string key_in_dataset() const;   ///< in `columns:`: command_1
  std::string name() const;             ///< of its column: muscle_pressure_1_bar
  std::string name_in_dataset() const;  ///< of its column in a data set: that of what it reads
  std::string words() const, words_in_dataset() const;
  /// By its key in a data set, without the muscle's number; muscle 1 is that of one muscle, too.
  bool is(std::string_view key, std::size_t number = 1) const {
    return signal->in_dataset == key && (muscle == 2) == (number == 2);
  }
  bool is_pressure() const {  ///< of a muscle, and not commanded
    return signal->unit.name == "bar" && signal->part == Part::muscle && signal->kind != Kind::input;
  }
  friend bool operator==(const Channel&, const Channel&) = default;
  /// In its unit, and in that of a page.
  double value(const Sample& row) const { return signal->value(row, muscle) / signal->unit.size; }
  double on_page(const Sample& row) const { return value(row) / signal->unit.page_size; }
  std::string_view page_unit() const {
    return signal->unit.on_page.empty() ? signal->unit.name : signal->unit.on_page;
  }
};

/// What a rig that is driven so has, in the order of its columns.
std::vector<Channel> channels_of(const Rig& rig, const Driven& driven);
/// Of these, the columns of the file of a run.
std::vector<Channel> recorded_channels(const Rig& rig, const Driven& driven);
/// Of these, what a laboratory records: time, inputs, readings.
std::vector<Channel> measured_channels(const Rig& rig, const Driven& driven);

/// A signal by its key: of one muscle, where a pair's joint has one of that key too. Throws
/// std::invalid_argument if there is none.
const Signal& signal_of(std::string_view key);

/// What valves are commanded with; its key is current or command.
const Signal& command_of(CommandUnit unit);
inline std::string command_key(const Rig& rig) {
  return std::string(command_of(rig.command_unit()).key);
}

/// A channel by its key. Throws std::invalid_argument if there is none.
const Channel& channel_of(const std::vector<Channel>& channels, std::string_view key);

}  // namespace mckibben::plant
