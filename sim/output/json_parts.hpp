// What JSON documents have in common. Only for those who write one: others are given its text.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/input_file.hpp>
#include <sim/engine/integrator.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::output {

/// How every document begins: its schema, versions, hashes of the input files.
input::Json heading_json(const char* schema, const std::vector<domain::InputFile>& files);

input::Json solver_json(const engine::Counters& counters);
/// What solver_json wrote.
engine::Counters counters_of(const input::Json& solver);

/// Where air and work went in a run.
input::Json ledger_json(const plant::Rig& rig, const run::Recording& recording);

input::Json span_json(const run::Span& span);

/// Where cords would have to push.
input::Json slack_json(const run::Recording& recording);

/// The text of a file that holds the document.
std::string text_of(const input::Json& document);

/// How far it came, and whether that is where braids end.
input::Json contraction_json(const plant::Rig& rig, const run::Recording& recording);

}  // namespace mckibben::output
