// What is looked back to where something is late: which commands were given, and what sensors saw.
// Only what may still be asked for is kept.
#pragma once

#include <vector>

namespace mckibben::ride {

/// Instants nearer than this are one: a delay of whole ticks is not whole to the last bit.
inline constexpr double same_instant_s = 1e-9;

/// A command, and how fast it came: its change over the length of its step.
struct Given {
  double at_s, current_mA, speed_mA_per_s;
};

/// Commands that are felt late, each held from its instant on; the first one holds from ever.
class PastCommands {
 public:
  void begin(double current_mA);
  void give(const Given& command);
  /// What is felt at an instant, so much late. Forgets what was felt before.
  const Given& felt(double now_s, double late_s);
  /// When something else will be felt; infinite if all that was given is felt.
  double next_s(double now_s, double late_s) const;

  static void members(auto& self, auto& visit) { visit(self.given_); }

 private:
  std::vector<Given> given_;
};

/// Values at instants, between them by the cubic that has their values and slopes (Hermite), or straight
/// where slopes are not known (NaN); before the first one it was that.
class PastValues {
 public:
  /// Throws away what no value from `oldest_s` on asks for.
  void note(double at_s, double value, double slope_per_s, double oldest_s);
  double at(double at_s) const;

  static void members(auto& self, auto& visit) { visit(self.seen_); }

 private:
  struct Seen {
    double at_s, value, slope_per_s;
  };
  std::vector<Seen> seen_;
};

}  // namespace mckibben::ride
