// How a diagnosis speaks to people: numbers in units that they use, with the digits that their intervals
// allow, and names of what was found. Shared by the table, the report and the comments of the rig file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::output {

/// Name of the folder that a data set is in.
std::string name_of(const domain::Dataset& data);

/// A number given in SI, in a usual unit: "0.5 bar" for 5e4 Pa.
std::string readable(double value, std::string_view si_unit);

/// A fitted number and its 95 % interval, both with the digits that the interval allows: "7.68 mm",
/// "7.66 to 7.70 mm". An interval that is not known is "unknown".
struct Readable {
  std::string value, interval;
};
Readable readable(const diagnose::FittedNumber& number);

/// The size of a fault of the bench, as its name tells: "-1.00 kg", "-5.0 %".
Readable readable(const diagnose::BenchFault& fault, const plant::Rig& rig);

/// A difference of contraction ratios as height of the load: "1.96 mm", never finer than a micrometre.
std::string height(double ratio, const plant::Rig& rig);

/// How the reading that models are judged by is called, and in which unit it is told.
struct JudgedWords {
  const char *signal, *unit;  ///< in SI
  double size;                ///< of the unit of pages
  const char* errors;         ///< what a table holds
  const char *what, *more, *less;
  const char* note;  ///< what a page says of its numbers
};
const JudgedWords& words_of(diagnose::Judged judged);

/// A difference of the reading that was judged: such a height, "13.3 N", or "0.250 deg".
std::string amount(double value, diagnose::Judged judged, const plant::Rig& rig);

/// A mass as a label tells it: six digits, "11.138 kg".
std::string mass(double kg);

/// With so many decimals, without the sign of a rounded nothing; `sign`: "+" before what is above 0.
std::string rounded(double value, int decimals, bool sign = false);

/// The names that explain the data as well as an effect: "or command_delay", "or A, B or 2 more"; empty if
/// there are none.
std::string or_others(const diagnose::NamedEffect& effect);
/// The same of effects, in a line that explains a mark in a table: "* or command_delay: ..."; empty if none.
std::string or_others_line(const diagnose::NamedEffect& effect);

/// The verdict as a heading, with the effects' names and those that are as good.
std::string title_of(const diagnose::Diagnosis& diagnosis);

using diagnose::full_name;
using diagnose::listed;

/// What an explanation that competed explains the data by: "muscle_leak with valve_lag", "other values of the
/// rig's parameters (friction.scale by 2.1 times its ±)".
std::string explained_by(const diagnose::Explanation& explanation);

/// The same of one that explains the data as well: by what differs from what was found, "the same without
/// load_error".
std::string explained_as_well_by(const diagnose::Diagnosis& diagnosis,
                                 const diagnose::Explanation& explanation);

/// How the recalibrated rig can be worse than the nominal one; empty where it is not.
std::string why_recalibrated_is_worse(const diagnose::Diagnosis& diagnosis);

/// Whether more is left than noise and what the verdict is about.
bool is_unexplained(const diagnose::Diagnosis& diagnosis);

/// The measurement that is proposed, with its load where one hangs.
std::string in_words(const diagnose::NextExperiment& next);

/// What could choose between the names that were found and others that are as good; empty where none is.
std::string left_undecided(const diagnose::Diagnosis& diagnosis);

/// What to do where no measurement is proposed; empty if there is nothing to say. Nobody is told that no more
/// is needed while noise floors remain unexplained.
std::string what_next(const diagnose::Diagnosis& diagnosis);

/// "6 runs", "1 run in 4 parts".
std::string runs_in_words(const domain::Dataset& data);

/// Ids of the runs held out.
std::vector<std::string> held_out(const diagnose::Diagnosis& diagnosis);
/// Every run that was used is held out in turn.
bool each_is_held_out(const diagnose::Diagnosis& diagnosis);
/// "r07 and r08 held out", "each predicted from the others".
std::string held_out_in_words(const diagnose::Diagnosis& diagnosis);

/// Whether the corrected model is another than the nominal one: by its rig, or by faults of the bench.
bool changed(const diagnose::Diagnosis& diagnosis);
bool rig_changed(const diagnose::Diagnosis& diagnosis);

/// What the catalogue, or a law of a rig's own, says of an effect; empty for a name that is in neither.
struct EffectWords {
  std::string_view law, sentence, source;
};
EffectWords words_of(std::string_view effect, const plant::Effects& of_rig);

}  // namespace mckibben::output
