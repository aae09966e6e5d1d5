// The row of a recording, as every room takes it: of a rider at the instant that it is at, under what it
// holds.
#pragma once

#include <array>
#include <cstdint>

#include <plant/signals.hpp>
#include <sim/ride/rider.hpp>

namespace mckibben::ride {

/// What noise adds to what the sensors of each muscle show.
using SensorNoise = std::array<plant::BySensed, 2>;

/// `counts`: as the position has been read at this instant.
plant::Sample sample_of(const Rider& rider, std::int64_t counts, const SensorNoise& noise = {});

}  // namespace mckibben::ride
