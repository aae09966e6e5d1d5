// The measurement that would tell two models apart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/identify/model.hpp>

namespace mckibben::identify {

/// Whichever of the two is right, the other is fitted again to old and new readings, by straight lines. What
/// is left makes it less probable: the measurement is asked for that most probably makes that 3 nats. None if
/// none of the menu has a chance of 10 %. Both after their evidence. Throws run::Interrupted.
std::optional<diagnose::NextExperiment> next_measurement(const Model& one, const Model& other,
                                                         std::vector<std::string> names, unsigned threads);

/// The same of a gauge on the muscle, in the run of the data in which two models differ most; none if the
/// data have one, or if pressures are given.
std::optional<diagnose::NextSensor> next_sensor(const Model& one, const Model& other,
                                                std::vector<std::string> names, unsigned threads);

}  // namespace mckibben::identify
