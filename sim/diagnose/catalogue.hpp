// The catalogue of effects, as candidates, and what of it data can show.
#pragma once

#include <string>
#include <vector>

#include <sim/diagnose/candidate.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::diagnose {

/// The whole catalogue, in the order of its table.
std::vector<Candidate> catalogue();
/// The same, and the rig's laws of the user's own.
std::vector<Candidate> catalogue(const Rig& rig);
/// What these data can show of both: without what acts on nothing that they show, of a pair without the guide
/// of a load, without a gauge no errors of one. Of a pair, what may be of one muscle alone stands there for
/// both, for muscle 1 and for muscle 2.
std::vector<Candidate> catalogue(const domain::Dataset& data);

/// Effects of the catalogue, and parameters, that data leave nothing to see of: upstream of a pressure that
/// is given, on a position that was not read.
std::vector<std::string> effects_out_of_sight(const domain::Dataset& data);
bool out_of_sight(const domain::Dataset& data, const Parameter& parameter);

}  // namespace mckibben::diagnose
