// Rows to be judged, of runs with a clock of their own: a recorder at 1 kHz says more often what is no news.
//
// Where readings come fast, there is a row each 12 ms: a parabola through the readings within half a row
// (least squares; Savitzky & Golay, Analytical Chemistry 36 (1964) 1627-1639) tells what they say together at
// its instant, and what they scatter by. The simulation follows the inputs in quarters of that, a command at
// its mean. Where an input jumps or bends in between, every stamp is kept.
// Where readings come slowly, rows are the stamps, and readings stay as they are; of settled points each is a
// row. What is given is smoothed as far as its noise allows (given_noise.hpp).
#pragma once

#include <cstddef>
#include <vector>

#include <sim/domain/dataset.hpp>

namespace mckibben::data {

/// Between the rows of runs of stamps: 12 ms, or what the slowest one has.
double row_s_of(const domain::Dataset& data);

/// Runs of stamps of which no row would be left: shorter than the rows of the slowest one, or skipped.
std::vector<std::size_t> runs_without_rows(const domain::Dataset& data);

/// The runs with their rows, what is skipped left out. Of one muscle, with a hanging load whose contraction
/// was read or at a given length and with its force, or of a pair whose angle was read; data with a row each
/// tick are what they are. Throws UnfitData where a run would have none.
domain::Dataset with_rows(domain::Dataset data);

}  // namespace mckibben::data
