// Counts heap allocations of this thread, of C and C++ alike, so that a test can say that a loop makes none.
#pragma once

namespace mckibben::run {

void start_heap_watch();

/// Allocations since the start.
long stop_heap_watch();

}  // namespace mckibben::run
