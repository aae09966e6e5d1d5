// What the heading of a column speaks of: its words and its unit, in English, German and a little French.
#pragma once

#include <string>
#include <string_view>

#include <sim/domain/columns.hpp>
#include <sim/recognise/unknown_table.hpp>

namespace mckibben::recognise {

struct Heading {
  const domain::Quantity* quantity = nullptr;  ///< none: nothing that is known
  std::string unit;                            ///< that it says, or the line below it does; empty: none
  bool unit_fits = false;                      ///< what is said can be a unit of the quantity
  std::string reason;                          ///< which words tell
  bool is_length = false;                      ///< the muscle's, which falls as it contracts
};

Heading heading_of(const UnknownColumn& column);

}  // namespace mckibben::recognise
