// JSON documents that this program wrote and reads again.
#pragma once

#include <sim/input/json.hpp>
#include <sim/input/source.hpp>

namespace mckibben::input {

/// The document. Throws BadInput with the place where it is no JSON,
/// a number is too large, or a limit is passed.
Json read_json(const Source& source);

}  // namespace mckibben::input
