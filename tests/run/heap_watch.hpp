// Counts heap allocations of this thread, of C and C++ alike, so that a test can say that a loop makes none.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include <controllers/controller.hpp>

namespace mckibben::run {

void start_heap_watch();

/// Allocations since the start.
long stop_heap_watch();

/// Hands on to another controller and watches the heap between the first tick and the last.
class Watched final : public controllers::Controller {
 public:
  Watched(std::unique_ptr<controllers::Controller> inner, std::int64_t last)
      : inner_(std::move(inner)), last_(last) {}
  controllers::Command rest() override { return inner_->rest(); }
  std::int64_t preparation_ticks() const override { return inner_->preparation_ticks(); }
  controllers::Command step(const controllers::Reading& reading) override {
    if (reading.tick == 0) start_heap_watch();
    const auto command = inner_->step(reading);
    if (reading.tick == last_) allocations = stop_heap_watch();
    return command;
  }
  long allocations = -1;

 private:
  std::unique_ptr<controllers::Controller> inner_;
  std::int64_t last_;
};

}  // namespace mckibben::run
