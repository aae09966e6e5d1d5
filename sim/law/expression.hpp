// A law as it is written, taken apart by its grammar (PEGTL): what is to be done, operands first. Names and
// units are not looked at here.
//
//   comparison = sum [("<" | "<=" | ">" | ">=") sum]
//   sum        = product {("+" | "-") product}
//   product    = factor {("*" | "/") factor}
//   factor     = "-" factor | power
//   power      = operand ["^" exponent]          exponent = ["-"] power
//   operand    = number ["[" unit "]"] | name | name "(" comparison {"," comparison} ")" | "(" comparison ")"
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mckibben::law {

/// What is wrong with a text, and at which byte.
struct Problem {
  std::size_t offset = 0;
  std::string message;
  std::string unknown{};  ///< a name that nobody knows, to be compared with those that are known
};

/// One step of a calculation in postfix order.
struct Piece {
  enum class Kind {
    number,
    name,
    call,
    group,  // brackets round what came before
    negate,
    add,
    subtract,
    multiply,
    divide,
    power,
    less,
    less_equal,
    greater,
    greater_equal
  };
  Kind kind{};
  std::size_t offset = 0;     ///< in the text: of a number, a name; of an operator itself
  std::string text{};         ///< the number; the name
  std::string unit{};         ///< of a number; empty if none is written
  std::size_t arguments = 0;  ///< of a call
  std::size_t end = 0;        ///< of a call, a group: one after its last byte
};

inline constexpr std::size_t longest_law = 1000, deepest_law = 24;

/// Empty, with a problem, if the text is no expression.
std::vector<Piece> parse(std::string_view text, std::vector<Problem>& problems);

}  // namespace mckibben::law
