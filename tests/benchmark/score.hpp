// What counts of the diagnoses of a suite: names, sizes, numbers, verdicts.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>

#include "advice_benchmark.hpp"
#include "hidden_effects.hpp"
#include "tally.hpp"

namespace mckibben::diagnose {

/// What a diagnosis says, and how that compares with what was hidden.
struct Answer {
  std::set<std::string> named, declared;
  std::string said;
  bool right = false, within = false;  ///< the names
  bool well = false;  ///< they and the verdict; "something else" beside a law of no catalogue

  Answer(const Hidden& hidden, const Diagnosis& found);
};

/// How often a true value lies in the interval that is told.
struct Coverage {
  int inside = 0, of = 0;
  void count(double truth, const FittedNumber& told);
};

/// A name that was given, and by what evidence.
struct Given {
  bool right = false, alone = true;
  bool among = false;   ///< right, or one of those is that do as well
  double margin = 0.0;  ///< by which it is ahead

  Given() = default;
  Given(const NamedEffect& effect, const std::vector<std::string>& truth);
};

/// What counts of a diagnosis. Its bytes go from one process to another.
struct Outcome {
  Verdict hidden{}, found{};
  std::size_t effects = 0;  ///< that were hidden
  bool right = false, within = false, well = false, wrong_name = false, closed = false;
  bool other_law = false;  ///< is in the rig
  bool simpler = false;    ///< an explanation that is simpler does as well
  Coverage sizes, numbers;
  std::array<Given, 4> given{};
  std::size_t names = 0;
  Advice advice{};
  double took_s = 0.0;

  Outcome() = default;
  Outcome(const Hidden& truth, const Diagnosis& diagnosis, const Answer& answer);
};

class Score {
 public:
  void count(const Outcome& outcome);
  void print() const;

 private:
  void print_reliability() const;

  Tally few_, triples_, in_set_, false_alarms_, unknown_, other_laws_, well_, wrong_names_, sizes_, numbers_,
      closed_, recalibrated_, simpler_;
  std::vector<Given> given_;
  AdviceScore advice_;
  double slowest_s_ = 0.0;
};

}  // namespace mckibben::diagnose
