// Thresholds of stage 6, decide: from what is left to the verdict.
#pragma once

namespace mckibben::diagnose {

/// The verdict. What is left is on the runs held out.
struct DecideThresholds {
  double worth_a_law = 0.15;         ///< left, that is worth a search for a law, and for each further term
  double worth_a_law_share = 0.05;   ///< of what the described rig leaves, that is worth it too
  double law_share = 0.3;            ///< of the gap, that a law must close, more than
  double law_beyond_names = 0.4;     ///< of what the names leave, that a law may leave, less than
  double named_share = 0.4;          ///< of a gap worth a law, that effects must close to be named
  double nearly_all = 0.9;           ///< of the gap: they are named whatever is left
  double hopeless = 600.0;           ///< left, as no fit of the right effect leaves that stopped early
  double beyond_disturbance = 60.0;  ///< left, as no slow disturbance leaves
  double invisible = 0.5;            ///< of the catalogue: if more of it would not show, nothing can be told
  double contradicted = 1.0;         ///< of the motion left, that makes the gauge a suspect
  double without_gauge = 0.25;       ///< of that, that may be left where the gauge is ignored
  double false_alarm_rate = 0.03;    ///< aimed at; docs/diagnosis.md has what was measured
};

}  // namespace mckibben::diagnose
