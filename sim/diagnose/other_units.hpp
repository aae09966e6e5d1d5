// Readings that cannot be what their columns say: of another sign, or in another unit, than a rig like this
// one could give. Contractions under a hanging load are looked at in sim/run/column_sanity.hpp.
#pragma once

#include <vector>

#include <sim/diagnose/predict.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::diagnose {

/// Forces and angles. `model`: what the rig would do in each run; `masked` rows do not count.
/// Throws domain::UnfitData with the line that mends it.
void refuse_other_units(const domain::Dataset& data, const std::vector<Readings>& model,
                        const std::vector<std::vector<bool>>& masked);

}  // namespace mckibben::diagnose
