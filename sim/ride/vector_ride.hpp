// Independent rigs with a load each, stepped together from outside: arrays in, arrays out. They share the
// lanes of batches where they can; the others go one by one. The result of one does not depend on the others,
// to the bit.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <sim/ride/batch.hpp>

namespace mckibben::ride {

class VectorRide {
 public:
  /// `settings`: of each rig. Throws std::invalid_argument where there are not as many.
  VectorRide(std::span<const Loaded> rigs, std::span<const solver::Settings> settings);

  /// As a ride starts; so many currents as rigs.
  void start(std::span<const double> current_mA, double at_s);
  /// An instant and the way to the next [s]. A rig that cannot go on stays where it came to, and `failure`
  /// says why; the others go on. Throws std::invalid_argument.
  void step(std::span<const double> current_mA, double until_s);
  /// All that changes on the way, of one rig.
  struct Saved {
    Rider::State rider;
    Carried carried;
    std::string failure;

    static void members(auto& self, auto& visit) { visit(self.rider, self.carried, self.failure); }
  };
  Saved save(std::size_t rig) const;
  /// In place of a start: the same rigs, in whatever company they were, go on to the same bits.
  void resume(std::span<const Saved> saved, double at_s);
  /// A rig that stays where it is from now on, and costs nothing.
  void retire(std::size_t rig);

  std::size_t rigs() const { return members_.size(); }
  const Rider& rider(std::size_t rig) const;
  const std::string& failure(std::size_t rig) const;
  double time_s() const { return time_s_; }

 private:
  struct Member;

  void require_as_many(std::size_t given) const;
  /// Gives each rig its place.
  void carry(const std::function<Carried(std::size_t rig)>& from);

  std::map<BatchKey, std::vector<std::size_t>> alike_;  // which rigs
  std::vector<std::shared_ptr<Member>> members_;
  std::vector<Batch> batches_;
  std::vector<std::pair<std::shared_ptr<Member>, Alone>> alone_;
  double time_s_ = 0.0;
};

}  // namespace mckibben::ride
