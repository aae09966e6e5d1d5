// Error bands over rigs that were drawn: for each load and controller where 90 % of the errors lie.
#pragma once

#include <sim/domain/scenario.hpp>
#include <sim/report/contents.hpp>
#include <sim/run/compare.hpp>

namespace mckibben::report {

/// A picture, and what failed; empty if no rigs were drawn.
Chapter robustness(const domain::Scenario& scenario, const run::Comparison& comparison);

}  // namespace mckibben::report
