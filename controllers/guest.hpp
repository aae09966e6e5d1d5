// What controllers share that are somebody else's program: what they are told, and the limits within which
// they are obeyed, which are the same as those of our own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <controllers/controller.hpp>
#include <controllers/current_range.hpp>
#include <controllers/safety.hpp>

namespace mckibben::controllers {

struct GuestTerms : SafetyTerms, OutputLimits {
  GuestTerms() = default;  // no aggregate: in one, g++ 12 takes the text for uninitialised
  std::string folder;      ///< in which it runs; filled in by whoever read the settings, before make()
  bool tell_load = false;
  int preparation_ticks = 0;

  static void fields(auto& self, auto& visit) {
    visit("tell_load", self.tell_load, "whether it gets the load of its run");
    visit("preparation_ticks", self.preparation_ticks, 0, 1000000,
          "ticks before tick 0 that are not recorded: to weigh the load, for instance");
    OutputLimits::fields(self, visit);
    SafetyTerms::fields(self, visit);
  }
};

/// Asks, and keeps the limits; how it asks is the derived controller's. While counts are not to be believed
/// it hears those that were believed last, and that they are lost.
class Guest : public Controller {
 public:
  Guest(const GuestTerms& terms, const Knowledge& known);

  /// Never throws: a guest that cannot begin gives up at its first step, as others do.
  Command rest() final;
  std::int64_t preparation_ticks() const final { return terms_.preparation_ticks; }
  Command step(const Reading& reading) final;
  std::vector<Finding> findings() const final;

 protected:
  /// What it hears at a tick.
  struct Told {
    Reading reading;
    bool counts_lost = false;
    double target = 0.0;  ///< contraction ratio
  };
  /// Begins, and gives the current [mA] while the rig settles. Throws ControllerFailure.
  virtual double begin_mA() = 0;
  /// Its current [mA] until the next tick. Throws ControllerFailure.
  virtual double answer_mA(const Told& told) = 0;

  const GuestTerms& terms() const { return terms_; }
  /// What it is told on paper; the target is cut at `highest_target`.
  const Knowledge& known() const { return known_; }
  const CurrentRange& range() const { return range_; }

 private:
  double obeyed_mA(double asked_mA, const CurrentRange& reach);

  GuestTerms terms_;
  Knowledge known_;
  CurrentRange range_;
  BelievedCounts believed_;
  std::string could_not_begin_;
  double before_mA_;
  std::int64_t limited_ticks_ = 0;
};

/// "tick 12 (0.144 s): "
std::string at_tick(const Reading& reading);

}  // namespace mckibben::controllers
