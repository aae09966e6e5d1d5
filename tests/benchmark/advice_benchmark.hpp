// Where a diagnosis leaves a name open, its advice is followed: the measurement that it asks for is made on
// the rig that was measured, joins the data, and all is diagnosed again.
#pragma once

#include <string>

#include "hidden_effects.hpp"
#include "tally.hpp"
#include "whole.hpp"

namespace mckibben::diagnose {

struct Advice {
  bool open = false;          ///< a name could be another
  bool asked = false;         ///< and a measurement is proposed
  bool right_before = false;  ///< the names, without it
  bool right = false;         ///< with it
  bool settled = false;       ///< right, and none could be one of the two that were to be told apart
  double power = 0.0;         ///< probability that was promised
};

/// `words` tells what came of it; empty where nothing is open.
Advice follow(const Hidden& hidden, const Diagnosis& found, const Asked& asked, std::string& words);

class AdviceScore {
 public:
  void count(const Advice& advice);
  void print() const;

 private:
  Tally asked_, right_before_, right_, settled_;
  double promised_ = 0.0;
};

}  // namespace mckibben::diagnose
