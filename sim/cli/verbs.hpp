// The list of verbs. Each adds itself to the command line, with options of its own, in the file that does
// what it is for. docs/add_a_part.md, "A verb", says what else a further one touches.
#pragma once

#include <sim/cli/app.hpp>

namespace mckibben::cli {

// Groups of the help.
inline constexpr const char* to_simulate = "Simulate";
inline constexpr const char* to_compare = "Compare with measurements";
inline constexpr const char* models_of_thesis = "The thesis's models";
inline constexpr const char* to_find_out = "Find out";

using AddVerb = void(CLI::App& app, Asked& asked);
AddVerb add_init, add_run, add_dataset, add_live, add_linearise, add_fmu, add_control, add_import, add_replay,
    add_diagnose, add_calibrate, add_map, add_diff, add_effects, add_check, add_schema;

/// In the order of the help.
inline constexpr AddVerb* all_verbs[] = {
    add_init,   add_run,      add_dataset,   add_live, add_linearise, add_fmu,     add_control, add_import,
    add_replay, add_diagnose, add_calibrate, add_map,  add_diff,      add_effects, add_check,   add_schema};

}  // namespace mckibben::cli
