// Sound data spoilt on purpose, for scoring what the diagnosis says of them: late, scaled, drifting, slipped,
// stuck, from another rig, wrongly labelled.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hidden_effects.hpp"

namespace mckibben::diagnose {

struct Corruption {
  std::string name;
  std::string run;                   ///< the culprit's; empty if it is all of them
  std::vector<std::string> culprit;  ///< any of these words says what is wrong
  std::function<void(domain::Dataset&)> spoil;
  std::vector<std::string> effects{};  ///< any of which it is as well
};

const std::vector<Corruption>& corruptions();

/// Six runs of eight seconds under six kinds of load and current: nothing hidden but a slow ripple; a leak; a
/// friction that falls with speed.
std::vector<Hidden> sound_data(std::uint64_t seed);

}  // namespace mckibben::diagnose
