// The result of a diagnosis in words and numbers: estimates with their intervals, what has moved, what
// absorbed what, and one sentence that says it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sim/diagnose/decide.hpp>
#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/fit.hpp>
#include <sim/diagnose/interval.hpp>
#include <sim/diagnose/name.hpp>

namespace mckibben::diagnose {

/// Files the free parameters of the final fit under effects, law and nominal parameters. `bounds`: one for
/// each free parameter; `recalibrated`: the rig fitted without effects.
void tell_parameters(Diagnosis& diagnosis, const Model& model, const std::vector<Bounds>& bounds,
                     const RigFile& recalibrated);

/// An amount of the judged reading: "1.2 mm" of the load's height, "3.4 N", "0.25 deg".
std::string amount_of(Judged judged, double value, const RigFile& rig, int digits = 2);
/// What such numbers are in: "in contraction ratio", "N", "rad".
std::string_view unit_in_words(Judged judged);

/// What data sheets add to the noise floor.
std::vector<std::string> sheets_in_words(const domain::Dataset& data, const NoiseFloor& floor);

/// What was made of stamps, and what data with a clock of their own cannot show.
std::vector<std::string> rows_in_words(const domain::Dataset& data, const NoiseFloor& floor);

/// What is wrong with the recording, each run by name, and what all have in common once; empty, or sentences
/// and a space.
std::string faults_in_words(const Diagnosis& diagnosis);

/// A reading beside the one that is judged, and its SI unit.
std::pair<std::string_view, std::string_view> told(domain::Beside which, bool pair);

/// The columns that were read beside: "muscle_pressure_bar", "muscle_pressure_1_bar and force_N".
std::string besides_in_words(const domain::Dataset& data);

/// That these are ignored, and what to look for, as a warning.
std::string ignored_in_words(const domain::Dataset& data);

/// A remark of the decision, as a warning. `left`: mean square above the floor's. `besides`: in words.
std::string remark_in_words(Remark remark, const Naming& naming, double left, const std::string& besides);

/// "r02 by 5, r07 by 12": runs that no model comes near, with the noise floors that are left.
std::string far_runs_in_words(const std::vector<FarRun>& runs);

/// The faults, then the verdict in a sentence. Needs everything else.
std::string because(const Diagnosis& diagnosis);

}  // namespace mckibben::diagnose
