// What `./mckibben bench diagnosis` has measured of this program's diagnoses on simulated data whose answer
// is known: how often something was named where nothing was hidden, and how often a name was right that was
// given with such evidence (docs/diagnosis.md, "How often it is right").
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include <sim/diagnose/diagnosis.hpp>

namespace mckibben::diagnose {

/// So many of so many.
struct Share {
  int yes = 0, of = 0;

  double value() const { return static_cast<double>(yes) / of; }
  /// 95 % interval (Wilson, J. Amer. Statist. Assoc. 22 (1927) 209-212).
  std::array<double, 2> interval() const;
};

/// Names that were ahead by `margin` or more, and by less than those of the next.
struct Bin {
  double margin = 0.0;
  Share right{};
};

struct Record {
  std::string_view measured, null_seeds;
  Share false_alarms{};        ///< of data sets in which nothing was hidden
  std::array<Bin, 2> names{};  ///< that no other did as well as
  Share first_of_several{};    ///< names beside which others did as well
};

extern const Record record;

/// By how much a name is ahead: its fall of the misfit, or what its best rival leaves more, whichever is
/// less.
double margin(const Support& support);

/// Of names given with such evidence, how many were right; none where the suite says nothing of it: of two
/// muscles, of forces, of a user's own laws, and where more than noise is left.
std::optional<Share> confidence(const Diagnosis& diagnosis, const NamedEffect& effect);

}  // namespace mckibben::diagnose
