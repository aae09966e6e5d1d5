// All explanations that were fitted, on equal terms: each is seen by the runs held out, and by its misfit to
// the others, in which the strain of what was said of the rig's numbers counts as evidence (squares of their
// deviations). What is chosen is the simplest that does as well as the best; what did as well is told.
#pragma once

#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/trial.hpp>

namespace mckibben::diagnose {

class Competition {
 public:
  /// A rig as it stands, or a fit; of several that say the same the best is kept. A fit that drove an effect
  /// to nothing does not explain by it.
  void enter(const Case& c, const Contender& contender);

  /// The best of each kind, and every one that does as well as `chosen`, or as the best if nothing is chosen;
  /// least misfit first.
  std::vector<Explanation> told(const Case& c, const Contender* chosen) const;

 private:
  struct Entry {
    Explanation::Kind kind;
    std::vector<std::string> effects;
    double squares, strain;  ///< of residuals in floors; of priors
    Contender contender;     ///< its residuals held out, nothing else
    double misfit(double inflation) const { return squares / inflation + strain; }
  };
  static Entry entry(const Contender& contender);

  std::vector<Entry> entries_;
};

}  // namespace mckibben::diagnose
