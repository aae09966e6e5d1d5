// Calibrations in files (schema mckibben-calibration/1): what `calibrate` writes and the open-loop
// controllers load. One field list (controllers/calibration.hpp) serves both ways.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <controllers/calibration.hpp>
#include <plant/rig.hpp>
#include <sim/input/diagnostics.hpp>

namespace mckibben::input {

inline constexpr std::string_view calibration_schema = "mckibben-calibration/1";

/// The calibration of the thesis's rig is built in: scenarios/thesis_calibration.yaml.
inline constexpr std::string_view shipped_calibration = "thesis";
extern const std::string_view thesis_calibration;

/// Reads a calibration, that of the shipped name too; the file read is added to `inputs`. Throws
/// MissingInput, BadInput.
controllers::Calibration read_calibration(const std::filesystem::path& path, std::vector<InputFile>& inputs);

/// Why it is none of this rig's: commands in another unit, or, for a controller that weighs with it, a tube
/// that pulls in one of them alone. Empty if it fits.
std::string wrong_rig(const controllers::Calibration& calibration, const plant::Rig& rig, bool weighs);

/// The text of a calibration file.
std::string calibration_yaml(const controllers::Calibration& calibration);

}  // namespace mckibben::input
