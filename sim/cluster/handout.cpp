// A number is claimed before it is looked whether its result is there: so whoever holds all claims (close)
// knows that nobody begins anything more.
#include <algorithm>
#include <utility>

#include <sim/cluster/handout.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::cluster {

Handout::Handout(Workplace& place, std::size_t count, std::function<bool(std::size_t)> is_there)
    : place_(place),
      count_(count),
      begin_(count * static_cast<std::size_t>(place.crew().rank) /
             static_cast<std::size_t>(place.crew().size)),
      first_claim_(place.next_stage()),
      is_there_(std::move(is_there)) {}

std::optional<std::size_t> Handout::next() {
  if (passed_ < count_) return (begin_ + passed_++) % count_;
  if (again_.empty()) return std::nullopt;
  const std::size_t number = again_.back();
  again_.pop_back();
  return number;
}

std::optional<std::size_t> Handout::take() {
  const std::lock_guard lock(mutex_);
  while (!run::interrupted()) {
    const auto number = next();
    if (!number) return std::nullopt;
    if (is_there_(*number)) {
      ++there_;
    } else if (!place_.claim(first_claim_ + *number)) {
      held_.push_back(*number);
    } else if (!is_there_(*number)) {
      return number;
    } else {
      place_.release(first_claim_ + *number);
      ++there_;
    }
  }
  return std::nullopt;
}

void Handout::done(std::size_t number) {
  const std::lock_guard lock(mutex_);
  place_.release(first_claim_ + number);
  ++there_;
}

bool Handout::again() {
  const std::lock_guard lock(mutex_);
  if (held_.empty()) return false;
  if (!wait_ || there_ != there_before_) wait_.emplace(place_, "work that other ranks have begun");
  there_before_ = there_;
  wait_->rest();
  again_ = std::exchange(held_, {});
  return true;
}

std::size_t Handout::fair_share() const {
  const auto size = static_cast<std::size_t>(place_.crew().size);
  return size == 1 ? count_ : std::max<std::size_t>(1, count_ / (2 * size));
}

std::size_t Handout::there() const {
  const std::lock_guard lock(mutex_);
  return there_;
}

}  // namespace mckibben::cluster
