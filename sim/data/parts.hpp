// Runs of fewer rows: the beginning of one, or one long run cut so that it can be held out part by part; or
// the branches of a loop; or each at a length of its own.
#pragma once

#include <sim/domain/dataset.hpp>

namespace mckibben::data {

/// The first rows of a run.
domain::Run beginning_of(domain::Run run, std::size_t rows);

/// One long run as a few parts of it, so that each can be predicted from the others: each is simulated from
/// the beginning, and its own rows are judged. Others, and runs of few rows, as they are.
domain::Dataset in_parts(domain::Dataset data);
bool has_parts(const domain::Dataset& data);

/// Whether each run is one branch of a loop of settled points, and both ways are there: what all runs of one
/// way share is hysteresis then.
bool are_branches(const domain::Dataset& data);

/// Whether all rows are settled points: read at rest, at times that nobody measured.
bool are_settled_points(const domain::Dataset& data);

/// Whether a bench holds each run at a length that no other has: what is of one run alone may be its
/// length's.
bool have_own_lengths(const domain::Dataset& data);

}  // namespace mckibben::data
