// The command line: verbs, options, exit statuses.
#pragma once

namespace mckibben::cli {

/// Runs the program and returns its exit status. Results go to stdout, everything else to stderr.
int run(int argc, char** argv);

}  // namespace mckibben::cli
