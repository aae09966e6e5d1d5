// Several effects at once, where naming one after the other left a gap: the first of them may have been the
// best single one and yet be none of those that are missing.
#pragma once

#include <span>

#include <sim/diagnose/name.hpp>

namespace mckibben::diagnose {

/// Fits the sets of effects that promise most next to each screening's base, and takes the best if it closes
/// most of what `result` leaves on the runs held out, with every size inside its range. Whether it did.
bool try_several(const Case& c, Naming& result, std::span<const Screening> screenings, const Step& step);

/// Two effects that help only together: next to one of `trials` that fits best but does not convince, another
/// one with which it closes most of what is left of `before`. Whether there are such two; then they are
/// taken.
bool try_pair(const Case& c, Naming& result, const std::vector<Trial>& trials, const Eigen::VectorXd& before,
              const Step& step);

}  // namespace mckibben::diagnose
