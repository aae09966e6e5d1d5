// Effects of the catalogue as things to be switched on and off, each with a size and perhaps a shape.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plant/rig.hpp>
#include <sim/diagnose/candidate.hpp>

namespace mckibben::live {

/// A number that can be set: what it is of, and where it may lie, in its unit (SI).
struct Dial {
  std::string unit;
  double lowest = 0.0, highest = 0.0;  ///< as rig files may have it
  double least = 0.0, most = 0.0;      ///< that is worth looking at
  double value = 0.0;
};

/// Why a number cannot be set; empty if it can. `what`: in words.
std::string out_of_range(std::string_view what, double value, double low, double high, std::string_view unit);

/// One law of one effect.
struct Switch {
  std::string name;  ///< "muscle_leak", with the law's name "gauge_error gain", or "muscle_leak of muscle 2"
  std::string effect;
  std::string_view sentence, law;
  bool on = false;
  Dial size;   ///< the number that makes the effect; where it is `absent` there is none
  Dial shape;  ///< its unit is empty where the law has none
  double absent = 0.0;
  diagnose::Candidate candidate{};

  bool has_shape() const { return !candidate.shape.empty(); }
  /// From one to two typical sizes away from none, to each side on which there are any: what may be hidden.
  std::vector<std::pair<double, double>> plain_sizes() const;
};

class Switches {
 public:
  /// Those that the rig has are on, at its sizes; others stand at typical ones. Of a pair one switch is for
  /// both muscles, unless the rig tells them apart there.
  explicit Switches(const plant::Rig& rig);

  const std::vector<Switch>& all() const { return all_; }
  const Switch* find(std::string_view name) const;

  /// Switches one; another law of the same effect goes off. Says why it cannot, and then nothing has changed;
  /// empty if it can. `size`, `shape`: in SI.
  std::string set(std::string_view name, bool on, double size, double shape);

  /// For lessons: only this one is on, and nothing can be switched until it is shown. Says why it cannot.
  std::string hide(std::string_view name, double size, double shape);
  void show() { hidden_.clear(); }
  /// The name of the one that is hidden; empty if there is none.
  const std::string& hidden() const { return hidden_; }

  /// The rig with what is on.
  plant::Rig rig() const;
  /// The same as its owner knows it: of what is on, only what the file has, as the file has it.
  plant::Rig known() const;

 private:
  void take_from_file(plant::Rig& rig, const Switch& one) const;

  plant::Rig bare_, file_;  // without what can be switched; as it was read
  std::vector<Switch> all_;
  std::string hidden_;
};

}  // namespace mckibben::live
