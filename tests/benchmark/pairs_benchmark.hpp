// Scores the diagnosis of two muscles on one wheel.
#pragma once

#include <cstdint>

namespace mckibben::diagnose {

/// Prints a line for each data set of these seeds, and how often the effect was named, and whose it is.
void score_pairs(std::uint64_t first, std::uint64_t seeds, unsigned threads);

}  // namespace mckibben::diagnose
