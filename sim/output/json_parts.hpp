// What JSON documents have in common. Only for those who write one: others are given its text.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/input_file.hpp>
#include <sim/engine/integrator.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/run/recording.hpp>

/// These members of a struct as JSON under their own names, in this order, and lists of such structs as
/// lists. To stand in the struct's namespace. nlohmann's own macro writes keys by the alphabet.
#define MCKIBBEN_MEMBERS_AS_JSON(Type, ...)                                                  \
  inline void to_json(mckibben::input::Json& nlohmann_json_j, const Type& nlohmann_json_t) { \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__))                 \
  }

namespace mckibben::run {
MCKIBBEN_MEMBERS_AS_JSON(Slack, muscle, from_s, rows, lowest_N, lowest_at_s)
}  // namespace mckibben::run

namespace mckibben::output {

/// How every document begins: its schema, versions, hashes of the input files.
input::Json heading_json(const char* schema, const std::vector<domain::InputFile>& files);

input::Json solver_json(const engine::Counters& counters);
/// What solver_json wrote.
engine::Counters counters_of(const input::Json& solver);

/// Where air and work went in a run.
input::Json ledger_json(const plant::Rig& rig, const run::Recording& recording);

input::Json span_json(const run::Span& span);

/// The text of a file that holds the document.
std::string text_of(const input::Json& document);

/// How far it came, and whether that is where braids end.
input::Json contraction_json(const plant::Rig& rig, const run::Recording& recording);

}  // namespace mckibben::output
