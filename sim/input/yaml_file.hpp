// A YAML file as a tree that remembers where everything stands. yaml-cpp parses; its events are turned into
// plain values here, because its own nodes accept repeated keys silently and know neither quotes nor parents.
// Accepted is the plain part of YAML: maps, lists and scalars; no anchors, aliases, merge keys or tags.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <sim/input/diagnostics.hpp>
#include <sim/input/source.hpp>

namespace mckibben::input {

inline constexpr std::size_t largest_yaml_bytes = 16U << 20U;

struct Node {
  enum class Kind { null, scalar, list, map };
  Kind kind = Kind::null;
  Place place;          ///< of the value; where that is left out, of the key or the list
  std::string text;     ///< of a scalar
  bool quoted = false;  ///< a scalar in quotes (or a block scalar)
  std::string key;      ///< the key under which this node stands, if in a map
  Place key_place;
  std::vector<Node> children;  ///< of a list or a map, in the order of the file

  /// The value under `wanted`, or under the key's earlier name; or null.
  const Node* find(std::string_view wanted) const;
  /// The kind in words: "a list".
  std::string_view kind_name() const;
};

struct YamlFile {
  Source source;
  Node root;                   ///< a map
  std::vector<Problem> found;  ///< repeated keys: the reader shows them with what else it finds
};

/// Reads and parses. Throws MissingInput, or BadInput if the form is so wrong that there is nothing to read:
/// syntax, and what this program does not accept of YAML.
YamlFile load_yaml(const std::filesystem::path& path);
YamlFile parse_yaml(Source source);

/// Where byte `offset` of a scalar's text stands in its file, whatever lines the scalar is written in.
Place place_in(const Source& source, const Node& scalar, std::size_t offset);

}  // namespace mckibben::input
