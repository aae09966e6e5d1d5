// What the rows of a pair hold besides those of one muscle, whatever drives it.
#pragma once

#include <sim/ride/rider.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::run {

/// Muscle 2 and the joint at this instant, under what is held, and what instruments see of them; the larger
/// contraction of both.
double write_opposite(const ride::Rider& rider, const plant::Moment<double>& now, const ride::Reading& seen,
                      Sample& row);

/// Notes where cords would have to push: of both muscles, or of the first alone.
void note_slack(Recording& recording, bool both);

}  // namespace mckibben::run
