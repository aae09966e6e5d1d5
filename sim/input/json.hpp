// The kind of JSON object that documents are made of: keys in the order in which they were put. Who makes or
// reads one includes fields_json.hpp or nlohmann/json.hpp.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace mckibben::input {

using Json = nlohmann::ordered_json;

}  // namespace mckibben::input
