// The next experiment: which current and which load, of a pair which two currents, would tell two
// explanations of the data apart (T-optimality: Atkinson & Fedorov, Biometrika 62 (1975) 57-70; here over a
// menu instead of a design space, the rival fitted again to each).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::diagnose {

/// Probability that a measurement ends a doubt: a run with a current and a load, or with a pair's currents,
/// nothing read.
using Power = std::function<double(const domain::Run& run)>;

/// The measurement of a menu of currents, under loads of the data set, of which that is highest, looked for
/// among those in which two rigs differ most and that no run of the data has made; none if even that is below
/// 10 %. Throws run::Interrupted.
std::optional<NextExperiment> plan(const domain::Dataset& data, unsigned threads, const plant::Rig& one,
                                   const plant::Rig& other, std::vector<std::string> names,
                                   const Power& power);

}  // namespace mckibben::diagnose
