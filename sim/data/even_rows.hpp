// Rows at even instants, for those who take differences from row to row.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <sim/domain/dataset.hpp>

namespace mckibben::data {

/// How far rows of stamps are apart.
struct Spacing {
  double row_s = 0.0;  ///< between contractions, in the middle; the rig's tick where it is that
  double narrowest_s = std::numeric_limits<double>::infinity(), widest_s = 0.0;
  std::vector<std::size_t> gaps;       ///< runs with more between two contractions than is bridged
  double gap_s = 0.0, gap_at_s = 0.0;  ///< the first of these

  bool is_even() const;
};

/// Of data with rows (with_rows).
Spacing spacing_of(const domain::Dataset& data);

/// Rows `row_s` apart: readings straight from one to the next, commands as their mean over a row.
void make_even(domain::Dataset& data, double row_s);

}  // namespace mckibben::data
