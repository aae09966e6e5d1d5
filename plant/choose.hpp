// Choices that depend on numbers. A law is written for any kind of number S: double, a dual number, or lanes
// that hold one value for each of several rigs (sim/engine/lanes.hpp). What is compared there may be true for
// one rig and false for its neighbour; so laws ask for a choice where one number alone would do with an `if`.
#pragma once

namespace mckibben::plant {

/// What a parameter is where the state is made of S: lanes have parameters of their own for each rig.
template <class S>
struct ParameterOf {
  using type = double;
};
template <class S>
using AsParameter = typename ParameterOf<S>::type;

inline bool any(bool condition) {
  return condition;
}

/// One of two values, both at hand.
template <class S>
S select(bool condition, const S& yes, const S& no) {
  return condition ? yes : no;
}

/// One of two laws, `yes()` or `no()`, of which as a rule only one is evaluated.
template <class Yes, class No>
auto choose(bool condition, const Yes& yes, const No& no) {
  return condition ? yes() : no();
}

}  // namespace mckibben::plant
