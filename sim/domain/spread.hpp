// How well the numbers of a rig are known, where its file says so.
#pragma once

#include <map>
#include <string>

namespace mckibben::domain {

/// Standard deviations [in the field's SI unit], by path of keys: `muscle.rest_radius`. Infinite: not known
/// at all. Of what is not listed nothing is said.
using Spreads = std::map<std::string, double>;

}  // namespace mckibben::domain
