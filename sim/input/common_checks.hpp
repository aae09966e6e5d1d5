// Checks that kinds of files share: the name of a result, the loads, and currents recorded in tables.
#pragma once

#include <string>
#include <vector>

#include <controllers/waveform.hpp>
#include <plant/rig.hpp>
#include <sim/domain/campaign.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

/// The key `name` of a file, if it is there, must be file-safe.
void check_name(const YamlFile& file, const std::string& name, Problems& problems);

/// The key `duration` of a file must be 1 to 1e6 ticks of the rig: more would not fit into memory.
void check_duration(const YamlFile& file, double duration_s, const plant::Rig& rig, Problems& problems);

/// Why a load cannot hang on the rig's muscle; empty if it can.
std::string no_load(const plant::Rig& rig);
/// The same said where a file names its rig.
void check_lifts_a_load(const YamlFile& file, const plant::Rig& rig, Problems& problems);

/// Throws BadInput, said of `file`, if a load cannot hang on the rig's muscle, as `verb` needs it.
void require_load(const plant::Rig& rig, const std::string& file, std::string_view verb);

/// What is missing where `Rig::can_hang` refuses a load.
std::string no_mass(const plant::Rig& rig);

/// No load may stand twice in the list at `nodes`.
void check_different(const std::vector<double>& loads_kg, const Node& nodes, const Source& source,
                     Problems& problems);

/// What is of a gauge shows on a rig that has one.
void check_has_gauge(const Source& source, const Node& node, std::string_view what, const plant::Rig& rig,
                     Problems& problems);
void check_gauge_error(const YamlFile& file, const plant::Rig& rig, Problems& problems);

/// The key `loads` of a file must hold at least one load, none twice, none that the rig's load offset takes
/// away, and none that is too heavy.
void check_loads(const YamlFile& file, const std::vector<double>& loads_kg, const plant::Rig& rig,
                 Problems& problems);

/// Reads the table that `recorded` names (at `node`, the value of its key `file`), one row each tick of
/// `rig`, within the range of its DAC.
void load_recording(controllers::RecordedCurrent& recorded, const Source& source, const Node& node,
                    const plant::Rig& rig, Problems& problems);

/// What a waveform (at `node`) leaves to the rig's valve, or to a table.
void complete_current(domain::CampaignWaveform& waveform, const Source& source, const Node& node,
                      const plant::Rig& rig, Problems& problems);

}  // namespace mckibben::input
