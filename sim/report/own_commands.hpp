// A valve that takes volts or a pressure: a page shows its commands and not the currents that would do the
// same, with which all is calculated. Of a pair, whose valves may differ, the currents.
#pragma once

#include <sim/report/contents.hpp>

namespace mckibben::report {

/// Whether the page shows commands of the valve's own.
bool shows_own_commands(const Contents& contents);

/// The same page with these in place of currents, where it shows them.
Contents with_own_commands(Contents contents);

}  // namespace mckibben::report
