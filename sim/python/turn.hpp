// Other threads of Python run while one simulates: what is stepped is for one of them at a time.
#pragma once

#include <atomic>
#include <stdexcept>

namespace mckibben::python {

class Turn {
 public:
  using Busy = std::atomic<bool>;

  explicit Turn(Busy& busy) : busy_(busy) {
    if (busy_.exchange(true)) throw std::runtime_error("it is at work in another thread");
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
  ~Turn() { busy_ = false; }

 private:
  Busy& busy_;
};

}  // namespace mckibben::python
