// The result of a diagnosis in one sentence: what is wrong with the recording, and the verdict.
#pragma once

#include <string>

#include <sim/diagnose/diagnosis.hpp>

namespace mckibben::diagnose {

/// What is wrong with the recording, each run by name, and what all have in common once; empty, or sentences
/// and a space.
std::string faults_in_words(const Diagnosis& diagnosis);

/// The faults, then the verdict in a sentence. Needs everything else.
std::string because(const Diagnosis& diagnosis);

}  // namespace mckibben::diagnose
