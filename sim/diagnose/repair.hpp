// Faults of the recording in words, and what is done about them: mended where that is safe, else the run is
// left out.
#pragma once

#include <sim/diagnose/check.hpp>
#include <sim/diagnose/faults.hpp>

namespace mckibben::diagnose {

/// The fault as it is told; without what is done about it.
FaultyRun told(const domain::Dataset& data, const Fault& fault);

/// Readings that come late are shifted by whole ticks, with what was read beside if that is late too; a moved
/// zero is taken out, and so is a drift that all runs have; other runs are left out. All is told in
/// `checked.faulty`.
void mend(domain::Dataset& data, Checked& checked, const std::vector<Fault>& faults);

}  // namespace mckibben::diagnose
