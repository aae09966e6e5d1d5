// Readings of one run that no load could have made: outliers, lost counts, readings that stand still. The
// model is what the rig as described would do, `count` that of the encoder, or what a gauge cannot resolve.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace mckibben::data {

using Series = std::vector<double>;

/// Rows from `begin` to before `end`.
struct Stretch {
  std::size_t begin, end;
};

/// Where a reading stands still.
struct Still : Stretch {
  enum class Why { frozen, saturated, stuck } why;
};

/// By how much the model's movement changes from one tick to the next at most, nearby: what a load can do
/// there, also if a hidden effect makes it come early or late.
Series sharpest_nearby(const Series& model, double tick_s);

/// Readings that leave the line through their neighbours with a jump and come back to it with another, within
/// a few ticks. `at_ends`: also within two rows of where a run begins and ends; at the end itself it must
/// stand still, as one jump is all that is seen.
std::vector<Stretch> spikes(Series values, const Series& sharpest, double count, bool at_ends);

/// A row at which the reading jumps and stays: the load moves before and after as if nothing had happened.
/// Rows that only repeat a reading, as of a sensor that is slower than the logger, are no rest.
std::optional<std::size_t> lost_counts(const Series& values, const Series& sharpest,
                                       const std::vector<bool>& masked, double count, double tick_s);

/// Where the reading stays the same to the last bit although the model moves far. Friction may hold a load
/// that the model moves, and so may the braid stop: the reading must also stop as no friction could stop it,
/// or catch up with a jump, or miss a great deal. A load that comes to rest by itself is held by a valve that
/// is stuck; readings cut off on their way up and down, at the highest of the run, by the end of their range.
std::vector<Still> stills(const Series& values, const Series& model, double count, double tick_s);

}  // namespace mckibben::data
