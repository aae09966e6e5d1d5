// Where in its file a target has a value.
#pragma once

#include <algorithm>
#include <variant>

#include <controllers/target.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

/// Of the start, or of the first move, whose value is such; of the whole target where there is none.
/// `of_whole`: the rest length, or 1, see controllers::sample.
template <class Value>
Place place_of_value(const controllers::TargetOf<Value>& target, const Node& node, double of_whole,
                     const auto& is_such) {
  const auto among = [&](const auto& moves, const char* key) {
    const auto such = [&](const auto& move) { return is_such(move.to.ratio(of_whole)); };
    const auto found = std::ranges::find_if(moves, such);
    if (found == moves.end()) return node.place;
    return node.find(key)->children[static_cast<std::size_t>(found - moves.begin())].find("to")->place;
  };
  return std::visit(
      [&](const auto& path) {
        if constexpr (requires { path.moves; }) {
          const Node* start = node.find("start");
          if (is_such(path.start.ratio(of_whole))) return start != nullptr ? start->place : node.place;
          return among(path.moves, "moves");
        } else if constexpr (requires { path.points; }) {
          return among(path.points, "points");
        } else {
          return node.place;
        }
      },
      target);
}

}  // namespace mckibben::input
