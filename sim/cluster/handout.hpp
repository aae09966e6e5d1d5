// Pieces of work, handed out by number: each process of a crew begins at a share of its own, goes once round,
// and takes what nobody holds and nobody has done.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include <sim/cluster/workplace.hpp>

namespace mckibben::cluster {

class Handout {
 public:
  /// Of pieces 0 ... count - 1. `is_there`: whether the result of one is where all see it.
  Handout(Workplace& place, std::size_t count, std::function<bool(std::size_t)> is_there);

  /// The next piece to do here; none if there is none now, or the user asked to stop. From any thread.
  std::optional<std::size_t> take();
  /// Its result is there. From any thread.
  void done(std::size_t number);

  /// Once `take` gave none: whether some are still held by others. Then it has waited a moment, and `take`
  /// looks at these again: one whose holder has ended is free. Throws Interrupted.
  bool again();

  /// How many a process may take at once and leave enough for the others.
  std::size_t fair_share() const;

  /// How many are known to be there.
  std::size_t there() const;

 private:
  std::optional<std::size_t> next();

  Workplace& place_;
  std::size_t count_, begin_, passed_ = 0, there_ = 0;
  std::uint64_t first_claim_;
  std::function<bool(std::size_t)> is_there_;
  std::vector<std::size_t> again_, held_;  ///< to be looked at again; seen in the hands of others since
  std::optional<Workplace::Wait> wait_;
  std::size_t there_before_ = 0;
  mutable std::mutex mutex_;
};

}  // namespace mckibben::cluster
