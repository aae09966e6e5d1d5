// The standard streams: what cannot be printed is no failure of the job.
#pragma once

#include <string>

namespace mckibben::cli {

/// To be called before anything is opened. Descriptors 0 to 2 that are closed are taken, so that no file gets
/// their numbers; from here on writing to `stderr` never fails; a reader that went away (SIGPIPE) and a limit
/// on the size of files (SIGXFSZ) are failed writes and end nothing.
void prepare_streams();

/// From here on this process says nothing, on neither of them, but what `tell_anyway` is given, on stderr.
void keep_quiet();
void tell_anyway(const std::string& text);

/// Prints on stdout, to the byte. A failure is kept for check_printed.
void print(const std::string& text);

/// Throws output::CannotWrite if not all was printed. Quiet where the reader of a pipe went away: it had
/// what it wanted.
void check_printed();

}  // namespace mckibben::cli
