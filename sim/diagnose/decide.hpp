// The verdict, from numbers alone: nothing is fitted, searched or simulated here, and nothing put into words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {

/// A run that a model does not come near.
struct FarRun {
  std::string id;
  double left = 0.0;  ///< mean square above the floor's, over it
};

/// What each stage has measured, in running order. What is left are mean squares above the floor's and over
/// it, on the runs held out.
struct Evidence {
  // check
  bool usable = true;         ///< the data allow an answer
  bool common_fault = false;  ///< all runs have the same fault: the recorder's, or the rig's
  std::size_t runs = 0;       ///< that are usable
  // baseline
  double nominal_left = 0.0, recalibrated_left = 0.0;
  Improvement recalibration{};  ///< from the rig as described to the recalibrated one
  bool bent = false;            ///< a number stands where more than is allowed would clearly fit better
  bool patterned = false;       ///< what the recalibrated rig leaves lies in parts of the data: densest()
  std::vector<FarRun> far_from_nominal{}, far_from_recalibrated{};  ///< of all usable runs
  // name
  std::size_t names = 0;        ///< effects that were found, with one size everywhere
  std::size_t stand_ins = 0;    ///< and those that stand in for something else
  double named_left = 0.0;      ///< with all of these
  double named_share = 0.0;     ///< of the reference's gap, that they close
  bool gauge_misleads = false;  ///< there is a gauge, and with the names the motion is further away
  std::size_t invisible = 0;    ///< effects that these data would not show
  std::size_t catalogue = 0;    ///< effects, with their variants, that there are
  bool search_ended = false;    ///< by time or user, before it was through
  // law
  std::size_t law_terms = 0;
  double law_left = 0.0, law_share = 0.0;  ///< as of the names

  /// The better of the two rigs without anything added: what names and laws are measured against.
  bool recalibration_helps() const { return recalibration.gained > 0.0; }
  double reference_left() const { return recalibration_helps() ? recalibrated_left : nominal_left; }
  bool named() const { return names > 0 && !gauge_misleads; }
  bool only_stand_ins() const { return names == 0 && stand_ins > 0 && !gauge_misleads; }
  /// With the names, where they stand.
  double left() const { return named() ? named_left : reference_left(); }
};

/// Whether what is left is worth a search for a law. Needs all but the law.
bool asks_for_law(const Evidence& evidence, const Thresholds& thresholds);

enum class Chosen { nominal, recalibrated, named, law };

enum class Remark {
  gauge_misleads,   ///< effects that explain the gauge's pressures make the motion worse
  more_is_missing,  ///< the names leave more than noise
  not_named,        ///< the names come nearest, but leave too much
  stands_in,        ///< an effect is not the same everywhere
  bent_numbers,     ///< numbers explain it only at the edge of what is allowed, or leave too much
  invisible         ///< some effects would not have shown
};

struct Decision {
  Verdict verdict = Verdict::cannot_tell;
  Chosen chosen = Chosen::nominal;    ///< the rig that is handed over
  std::vector<Remark> remarks{};      ///< to be told with it
  std::vector<FarRun> unexplained{};  ///< runs that no model comes near, where that decided
};

Decision decide(const Evidence& evidence, const Thresholds& thresholds);

/// Whether gauge and motion contradict each other, so that the gauge may be wrong. `motion_left`: of the
/// contraction ratio, with the model chosen.
bool gauge_is_suspect(double motion_left, const Thresholds& thresholds);

/// Whether the diagnosis without the gauge is the one to believe. What only stands in for something is no
/// explanation: a gauge is not given up for it.
bool better_without_gauge(double motion_left, double left_without, Verdict without, bool by_stand_ins,
                          const Thresholds& thresholds);

}  // namespace mckibben::diagnose
