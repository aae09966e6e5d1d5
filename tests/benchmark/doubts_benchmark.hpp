// Two explanations that do as well as each other: an effect that was hidden, and numbers of the rig or
// another effect in its place. The measurement that is planned is made on the rig that was measured, and both
// are fitted again.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mckibben::diagnose {

/// Of so many data sets, three or four short sines with an effect that has relatives; prints each doubt and
/// what came of it, then how many were resolved, beside how many were promised.
void score_doubts(std::uint64_t seed, std::size_t sets, unsigned threads);

}  // namespace mckibben::diagnose
