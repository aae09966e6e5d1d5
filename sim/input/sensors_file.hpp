// The sensors of a rig in files: the list `sensors`, and the keys that each had of its own before.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <plant/sensors.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {

/// A key of a rig file from before there was a list; still read.
struct OldSensorKey {
  std::string_view key;
  plant::Sensed signal;
  plant::SensorKind kind;
};
/// An `encoder` is not used where a `sensor` reads in its place.
inline constexpr std::array old_sensor_keys{
    OldSensorKey{"encoder", plant::Sensed::contraction, plant::SensorKind::encoder},
    OldSensorKey{"sensor", plant::Sensed::contraction, plant::SensorKind::encoder},
    OldSensorKey{"gauge", plant::Sensed::muscle_pressure, plant::SensorKind::gauge},
    OldSensorKey{"load_cell", plant::Sensed::force, plant::SensorKind::load_cell}};

/// In the list in place of a kind: the base's sensor is taken away.
inline constexpr std::string_view no_sensor = "none";

/// Reads the old keys of a rig's map on top of what is there.
void read_old_sensors(const Source& source, const Node& map, plant::Sensors& into, Problems& problems,
                      const ReadContext& context);

/// The list to write in place of a map's old keys; empty if it has none.
std::string in_place_of_old_sensors(const Node& map);

}  // namespace mckibben::input
