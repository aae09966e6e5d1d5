// What launchers say in their variables; see the header. Those of Slurm count only in a step that srun
// started: in a batch script there is one process, whatever was allocated.
#include <charconv>
#include <cstdlib>
#include <optional>

#include <sim/cluster/crew.hpp>

namespace mckibben::cluster {
namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::optional<int> number(const char* name) {
  const std::string text = variable(name);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = !text.empty() && error == std::errc{} && end == text.data() + text.size();
  return whole ? std::optional(value) : std::nullopt;
}

/// The crew that these variables tell of; alone if they do not.
Crew told(const char* rank, const char* size, std::string call) {
  const int mine = number(rank).value_or(0), all = number(size).value_or(1);
  if (mine < 0 || all < 2 || mine >= all || call.empty()) return {};
  return {mine, all, std::move(call), 1};
}

Crew of_launcher() {
  // mpirun may itself have been started by Slurm, which then speaks of its daemons.
  if (const std::string call = variable("PMIX_NAMESPACE"); !variable("OMPI_COMM_WORLD_SIZE").empty())
    return told("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", call.empty() ? "" : "mpirun " + call);
  if (variable("SLURM_STEP_ID").empty()) return {};
  Crew crew = told("SLURM_PROCID", "SLURM_STEP_NUM_TASKS",
                   "srun " + variable("SLURM_JOB_ID") + "." + variable("SLURM_STEP_ID") + "." +
                       variable("SLURM_RESTART_COUNT"));
  if (const int cores = number("SLURM_CPUS_PER_TASK").value_or(1); !crew.alone() && cores > 0)
    crew.threads = static_cast<unsigned>(cores);
  return crew;
}

}  // namespace

const Crew& crew() {
  static const Crew mine = of_launcher();
  return mine;
}

}  // namespace mckibben::cluster
