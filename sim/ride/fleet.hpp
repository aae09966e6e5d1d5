// Rigs with a load each that have nothing to do with each other, stepped together from outside, each under a
// current of its own: in the lanes of convoys where they can be, else one by one. What becomes of a rig does
// not depend on the others, to the bit.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <sim/ride/convoy.hpp>
#include <sim/ride/ride.hpp>

namespace mckibben::ride {

class Fleet {
 public:
  /// `settings`: of each rig. Throws std::invalid_argument where there are not as many.
  Fleet(std::span<const Hanging> rigs, std::span<const solver::Settings> settings);

  /// As a ride starts; so many currents as rigs.
  void start(std::span<const double> current_mA, double at_s);
  /// An instant and the way to the next [s]. A rig that cannot go on stays where it came to, and `failure`
  /// says why; the others go on. Throws std::invalid_argument.
  void step(std::span<const double> current_mA, double until_s);

  std::size_t rigs() const { return riders_.size(); }
  const Rider& rider(std::size_t rig) const { return riders_[rig]; }
  const std::string& failure(std::size_t rig) const { return failures_[rig]; }
  double time_s() const { return time_s_; }

 private:
  struct Wagon {
    std::unique_ptr<engine::Convoy> convoy;
    std::vector<std::size_t> rigs;  ///< by place
    std::vector<StiffWatch> watches;
  };

  void require_as_many(std::span<const double> current_mA) const;
  void go(Wagon& wagon);
  void set_off(Wagon& wagon, std::size_t place);
  void come(Wagon& wagon, std::size_t place, bool arrived);
  void leave(const Wagon& wagon, std::size_t place, bool stiff);
  void go_alone(std::size_t rig);

  std::vector<Rider> riders_;  // stay where they are: convoys refer to them
  std::vector<solver::Settings> settings_;
  std::vector<std::unique_ptr<Ride>> alone_;  // of those that are not in a wagon, or not any more
  std::vector<std::string> failures_;
  std::vector<Wagon> wagons_;
  double time_s_ = 0.0;
};

}  // namespace mckibben::ride
