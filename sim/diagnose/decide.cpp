// See the header.
#include <sim/diagnose/decide.hpp>

namespace mckibben::diagnose {
namespace {

/// Names that do not come near the data: their laws are not quite these, or more is missing.
bool names_leave_much(const Evidence& e, const Thresholds& t) {
  return e.named() && t.near.is_much(e.named_left);
}

/// What may be left of an explanation that is whole [mean square, the floor's with it]. What a slow
/// disturbance leaves has no place of its own: it does not know where the load is.
double most_left(const Evidence& e, const Thresholds& t) {
  return e.patterned ? t.start.explained_floors * t.start.explained_floors : t.near.mean_square();
}

/// Numbers that are bent to their bounds, or leave a gap, are no explanation.
bool numbers_explain(const Evidence& e, const Thresholds& t) {
  return !e.bent && e.recalibrated_left + 1.0 <= most_left(e, t);
}

/// A gap that is small beside what the described rig leaves: numbers close nearly all of it.
bool nearly_closed(const Evidence& e, const Thresholds& t) {
  return !e.named() && e.left() <= t.decide.worth_a_law_share * e.nominal_left;
}

/// A law is believed if it closes much of the gap, far more than the names do, and more than what stands in;
/// and where numbers close nearly all, if it explains what they do not.
bool lawful(const Evidence& e, const Thresholds& t) {
  return e.law_terms > 0 && e.law_share > t.decide.law_share &&
         (!e.named() || e.law_left < t.decide.law_beyond_names * e.left()) &&
         (!e.only_stand_ins() || e.law_left < e.named_left) &&
         (!nearly_closed(e, t) || e.law_left + 1.0 <= most_left(e, t));
}

/// What was added stands if it closes much of a gap that is worth it, and does not leave far too much.
bool stands(const Evidence& e, const DecideThresholds& t) {
  const bool bearable = e.named_left < t.hopeless || e.named_share >= t.nearly_all;
  return bearable && (e.named_share >= t.named_share || e.reference_left() < t.worth_a_law);
}

/// With other numbers every run stays far, and not by a fault of all: what befalls runs one by one spares
/// some.
bool all_are_far(const Evidence& e) {
  return e.patterned && !e.common_fault && e.far_from_recalibrated.size() == e.runs;
}

/// Where nothing is added. "Nothing is missing" is for data that would have shown it, and agree run by run.
void decide_nothing_added(const Evidence& e, const Thresholds& t, Decision& decision) {
  const bool gap = e.nominal_left > t.near.nothing_left;
  bool recalibrate = gap && convinces(e.recalibration, t.improvement);
  if (e.invisible > 0) decision.remarks.push_back(Remark::invisible);
  const double most_invisible = t.decide.invisible * static_cast<double>(e.catalogue);
  if (!recalibrate && static_cast<double>(e.invisible) > most_invisible) return;
  recalibrate = recalibrate || (e.recalibration_helps() && !e.far_from_nominal.empty());
  if (!recalibrate || !all_are_far(e))
    decision.unexplained = recalibrate ? e.far_from_recalibrated : e.far_from_nominal;
  if (e.common_fault || e.search_ended || !decision.unexplained.empty()) return;
  decision.verdict = recalibrate ? Verdict::recalibrate : Verdict::nothing_missing;
  decision.chosen = recalibrate ? Chosen::recalibrated : Chosen::nominal;
  if (!recalibrate || numbers_explain(e, t)) return;
  decision.verdict = Verdict::unknown_effect;
  decision.remarks.push_back(Remark::bent_numbers);
}

}  // namespace

bool asks_for_law(const Evidence& e, const Thresholds& t) {
  if (e.left() <= t.decide.worth_a_law) return false;
  if (e.named()) return e.left() > t.decide.worth_a_law_share * e.nominal_left || names_leave_much(e, t);
  return !nearly_closed(e, t) || (e.patterned && !numbers_explain(e, t));
}

Decision decide(const Evidence& e, const Thresholds& t) {
  Decision decision;
  if (!e.usable) return decision;
  if (e.gauge_misleads) decision.remarks.push_back(Remark::gauge_misleads);
  if (lawful(e, t)) {
    decision.verdict = Verdict::unknown_effect;
    decision.chosen = Chosen::law;
  } else if (e.named() && stands(e, t.decide)) {
    decision.verdict = Verdict::missing_effect;
    decision.chosen = Chosen::named;
    if (e.stand_ins > 0) decision.remarks.push_back(Remark::stands_in);
    if (names_leave_much(e, t)) decision.remarks.push_back(Remark::more_is_missing);
  } else if (e.only_stand_ins() && stands(e, t.decide)) {
    decision.verdict = e.search_ended ? Verdict::cannot_tell : Verdict::unknown_effect;
    decision.chosen = Chosen::named;
    decision.remarks.push_back(Remark::stands_in);
  } else if (e.left() > t.decide.beyond_disturbance) {  // what was not tried might have explained it
    decision.verdict = e.search_ended ? Verdict::cannot_tell : Verdict::unknown_effect;
    decision.chosen = e.recalibration_helps() ? Chosen::recalibrated : Chosen::nominal;
    if (e.named()) decision.remarks.push_back(Remark::not_named);
  } else {
    decide_nothing_added(e, t, decision);
  }
  return decision;
}

bool gauge_is_suspect(double motion_left, const Thresholds& t) {
  return motion_left >= t.decide.contradicted;
}

bool better_without_gauge(double motion_left, double left_without, Verdict without, bool by_stand_ins,
                          const Thresholds& t) {
  return without != Verdict::cannot_tell && !by_stand_ins &&
         !(left_without > t.decide.without_gauge * motion_left);
}

}  // namespace mckibben::diagnose
