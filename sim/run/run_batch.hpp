// Many simulations on several threads: those that can share lanes in a batch on each thread, the others one
// by one.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

#include <sim/ride/batch.hpp>

namespace mckibben::run {

/// An item that shares lanes with others of its key or goes alone, and how it begins.
struct BatchTask {
  ride::BatchKey key;
  std::function<std::shared_ptr<ride::BatchItem>()> begin;
};

/// The index of the next task; none if there is none.
using Take = std::function<std::optional<std::size_t>()>;
/// Makes a task; none if nothing is left to do.
using Prepare = std::function<std::optional<BatchTask>(std::size_t index)>;

/// Does all tasks that `take` hands out on `threads` threads (0: all the machine has). `rigs`: about how many
/// they have, all in all. Both are called from any thread. Results depend neither on threads nor on what
/// shares a batch. Throws what items throw.
void run_batch(const Take& take, std::size_t rigs, unsigned threads, const Prepare& prepare);

/// The same of tasks 0 to count - 1. Throws Interrupted.
void run_batch(std::size_t count, std::size_t rigs, unsigned threads, const Prepare& prepare);

}  // namespace mckibben::run
