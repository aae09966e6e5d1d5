// A law for what no effect of the catalogue explains: terms are taken from a library one by one, as long as
// each helps on runs held out, fitted inside the simulation, and dropped again if the others do without it or
// if the data do not determine it (stepwise selection; the library is that of
// plant/effects/residual_force.hpp).
#pragma once

namespace mckibben::diagnose {

struct Law {
  Contender contender{};  ///< its rig carries the terms
  Improvement gain{};     ///< on the runs held out, against the reference
  std::size_t terms = 0;  ///< that were added; 0: no law was found
};

/// Begins at whichever of `bases` leads to the better fit: one that is recalibrated may have bent far to
/// imitate what is missing. Where the search is ended, the law has the terms found by then.
Law find_law(const Case& c, const std::vector<const Contender*>& bases, const Eigen::VectorXd& reference,
             const Step& step, Search& search);

}  // namespace mckibben::diagnose
