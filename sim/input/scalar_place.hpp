// Where in its file a part of a scalar's text stands.
#pragma once

#include <cstddef>

#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

/// Where byte `offset` of a scalar's text stands in its file, whatever lines the scalar is written in.
Place place_in(const Source& source, const Node& scalar, std::size_t offset);

}  // namespace mckibben::input
