// What speaks for each name: the data are met once more without it, and run by run the misfit rises, or
// falls.
#pragma once

#include <sim/diagnose/name.hpp>

namespace mckibben::diagnose {

/// Fills in what each named effect is supported by, but for its rivals, which are known when it is taken.
/// `recalibrated`: the fit without any effect.
void tell_support(const Case& c, const Contender& recalibrated, Naming& naming, const Step& step);

}  // namespace mckibben::diagnose
