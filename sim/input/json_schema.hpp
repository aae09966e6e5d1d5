// JSON Schema (draft 2020-12) of our YAML files, for editors that complete and check while one types. Written
// from the field lists that the reader itself uses.
#pragma once

#include <string_view>
#include <vector>

#include <sim/input/field_list.hpp>

namespace mckibben::input {

/// The schema of a file whose first line is `schema: NAME` and whose other keys are `fields`.
Json json_schema(std::string_view schema, std::string_view title, const std::vector<FieldInfo>& fields);

}  // namespace mckibben::input
