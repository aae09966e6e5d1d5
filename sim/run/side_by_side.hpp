// Many errands, each one party's ride: those of one class side by side in a convoy on each thread, the others
// one by one.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

#include <sim/ride/convoy.hpp>

namespace mckibben::run {

class Errand : public ride::Party {
 public:
  /// Has got off, and is not asked any more.
  virtual bool is_done() const = 0;
};

/// An errand that can go beside others of its class, and how it begins.
struct Prepared {
  ride::ConvoyClass in;
  std::function<std::unique_ptr<Errand>()> begin;
};

/// The number of the next errand; none if there is none.
using Take = std::function<std::optional<std::size_t>()>;
/// Makes one ready; one that must go by itself is done there and then, and nothing comes back.
using Prepare = std::function<std::optional<Prepared>(std::size_t index)>;

/// Does all errands that `take` hands out on `threads` threads (0: all the machine has). `rigs`: about how
/// many are under way, all in all. Both are called from any thread. What comes of an errand depends neither
/// on threads nor on what goes beside it. Throws what errands throw.
void do_all(const Take& take, std::size_t rigs, unsigned threads, const Prepare& prepare);

}  // namespace mckibben::run
