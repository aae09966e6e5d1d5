// The verbs: each adds itself to the command line, with options of its own,
// in the file that does what it is for.
#pragma once

#include <sim/cli/app.hpp>

namespace mckibben::cli {

// Groups of the help.
inline constexpr const char* to_simulate = "Simulate";
inline constexpr const char* to_compare = "Compare with measurements";
inline constexpr const char* models_of_thesis = "The thesis's models";
inline constexpr const char* to_find_out = "Find out";

void add_init(CLI::App& app, Asked& asked);
void add_run(CLI::App& app, Asked& asked);
void add_dataset(CLI::App& app, Asked& asked);
void add_fmu(CLI::App& app, Asked& asked);
void add_control(CLI::App& app, Asked& asked);
void add_live(CLI::App& app, Asked& asked);
void add_import(CLI::App& app, Asked& asked);
void add_replay(CLI::App& app, Asked& asked);
void add_diagnose(CLI::App& app, Asked& asked);
void add_calibrate(CLI::App& app, Asked& asked);
void add_map(CLI::App& app, Asked& asked);
void add_diff(CLI::App& app, Asked& asked);
void add_effects(CLI::App& app, Asked& asked);
void add_check(CLI::App& app, Asked& asked);
void add_schema(CLI::App& app, Asked& asked);

}  // namespace mckibben::cli
