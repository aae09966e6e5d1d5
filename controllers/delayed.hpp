// Values that reach a controller late.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mckibben::controllers {

/// What was `ticks` ago; before the first one it was as that one.
template <class Value>
class Delayed {
 public:
  explicit Delayed(int ticks) : past_(static_cast<std::size_t>(ticks) + 1) {}

  Value operator()(const Value& now) {
    if (first_) std::fill(past_.begin(), past_.end(), now);
    first_ = false;
    past_[oldest_] = now;
    oldest_ = (oldest_ + 1) % past_.size();
    return past_[oldest_];
  }

 private:
  std::vector<Value> past_;
  std::size_t oldest_ = 0;
  bool first_ = true;
};

}  // namespace mckibben::controllers
