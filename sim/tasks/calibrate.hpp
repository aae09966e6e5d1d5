// What goes before a calibration, whoever asks for it.
#pragma once

#include <functional>
#include <string>

#include <sim/domain/dataset.hpp>

namespace mckibben::tasks {

/// A data set with a row each tick: what it is, or rows made of its stamps; `say` hears that. Throws
/// input::BadInput, data::UnfitData where it cannot be.
domain::Dataset ticked(domain::Dataset data, const std::function<void(const std::string&)>& say);

}  // namespace mckibben::tasks
