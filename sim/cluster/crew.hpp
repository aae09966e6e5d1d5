// The processes that a launcher starts of one command line: mpirun (Open MPI) or srun (Slurm). They learn of
// each other from variables that the launcher sets, and meet in a folder (workplace.hpp); no message passes
// between them. docs/cluster.md says why.
#pragma once

#include <string>

namespace mckibben::cluster {

struct Crew {
  int rank = 0, size = 1;
  std::string call{};    ///< of the launcher: the same in all of them, another at its next call
  unsigned threads = 0;  ///< of each process, if nobody says how many; 0: all the machine has

  bool alone() const { return size == 1; }
  /// Rank 0 alone writes the results folder and the terminal.
  bool leads() const { return rank == 0; }
};

/// Who this process works with. One thread each, as launchers start a process for each core, or as many as
/// Slurm gives each (`-c`).
const Crew& crew();

/// The threads to work on, of what the user asked for (0: not said).
inline unsigned threads_of(unsigned asked) {
  return asked == 0 ? crew().threads : asked;
}

}  // namespace mckibben::cluster
