// Limits and broken counters for controllers that have no loop of their own to keep them: the controller
// inside is shown counts that can be believed and a target that may be followed, and its current changes no
// faster than it may.
#pragma once

#include <functional>
#include <memory>

#include <controllers/safety.hpp>

namespace mckibben::controllers {

/// With a target that is nowhere above what `terms` allow.
Knowledge allowed(const SafetyTerms& terms, Knowledge knowledge);

using MakeController = std::function<std::unique_ptr<Controller>(const Knowledge& knowledge)>;

/// What `make` makes, kept within `terms`; itself, if there are none. Findings gain `ticks_without_counts`.
std::unique_ptr<Controller> kept_safe(const SafetyTerms& terms, const Knowledge& knowledge,
                                      const MakeController& make);

}  // namespace mckibben::controllers
