// Pieces of work whose results are bytes, done by whoever of a crew comes to them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include <sim/cluster/workplace.hpp>

namespace mckibben::cluster {

/// Who needs the results of a stage.
enum class Needed { by_rank_0, by_all };

/// Lets the crew do job(0) ... job(count - 1), on `threads` threads of each process. Results are kept in the
/// workplace as `stage`-N and are not made again by a later call of the same job. Whoever needs them is given
/// all, in order, as soon as they are there; others return when nothing is left to begin. Throws Interrupted,
/// CannotWrite, what `job` throws.
void share(Workplace& place, const std::string& stage, std::size_t count, unsigned threads, Needed needed,
           const std::function<std::string(std::size_t)>& job,
           const std::function<void(std::size_t, const std::string&)>& take);

}  // namespace mckibben::cluster
