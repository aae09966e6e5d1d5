// All that may explain a reading: parameters of the rig, effects, faults of the bench, general terms. One
// list, with priors; and a point: which of it is at work, with which numbers, in units of the priors.
//
//   parameter       z = (value - described) / deviation ~ Student t of 4 degrees; of a pair a shared value,
//                   and muscle 2's less muscle 1's
//   size            z = (value - absent) / typical ~ Student t of 4 degrees, half where it is one-sided
//   shape           log-normal round its middle, or normal where it may be negative: its range is +-2
//                   deviations
//   general terms   force, ~ normal of a scale that is tried: a whole family of them, or a few of its
//   members,
//                   where waves have log-normal wavelengths
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <sim/diagnose/candidate.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::identify {

/// What may differ from run to run, one value each, ~ normal with a scale that is log-normal round the
/// typical one, a factor of e.
struct Differing {
  std::string_view name;
  double typical;  ///< m (over the rest length), 1, kg, s, m/s (over the rest length), m
};
inline constexpr std::array<Differing, 6> differing{{{"zeros_differ", 1e-3},
                                                     {"gains_differ", 0.03},
                                                     {"loads_differ", 0.5},
                                                     {"delays_differ", 0.02},
                                                     {"drifts_differ", 1e-4},
                                                     {"lengths_differ", 1e-2}}};
inline constexpr int zeros = 0, gains = 1, loads = 2, delays = 3, drifts = 4, held_lengths = 5;
/// What a run is labelled with: the load that hangs, or the length at which a muscle is held.
inline int label_of(const domain::Dataset& data) {
  return data.lengths_are_given() ? held_lengths : loads;
}
/// Values of each run of what is simulated where it is most probable, as it is not straight: labels and
/// delays.
using OfRuns = std::array<std::vector<double>, differing.size()>;
constexpr bool is_simulated(int which) {
  return which == loads || which == delays || which == held_lengths;
}

/// What a bench may have wrong: its part in a simulation. All 0: nothing.
struct Bench {
  double load_offset_kg = 0.0, load_factor = 0.0;  ///< of what is written as load
  double clock = 0.0, ahead_s = 0.0;               ///< the recorder reads at t (1 + clock) + ahead
  double zero = 0.0;                               ///< of the judged reading
  OfRuns of_runs{};                                ///< besides
  std::vector<Eigen::VectorXd> starts{};           ///< of each run that began on its way, in deviations
  double of_run(int which, std::size_t run) const {
    const std::vector<double>& values = of_runs[static_cast<std::size_t>(which)];
    return values.empty() ? 0.0 : values[run];
  }
  double load_kg(double written, std::size_t run) const {
    return written * (1.0 + load_factor) + load_offset_kg + of_run(loads, run);
  }
};

/// A rig and a bench: what is simulated.
struct Setting {
  plant::Rig rig;
  Bench bench{};

  /// As it is in a run, by its place.
  diagnose::Loaded of_run(const domain::Run& run, std::size_t place) const {
    diagnose::Loaded one{rig, bench.load_kg(run.load_kg, place)};
    one.rig.joint.length_offset_m += bench.of_run(held_lengths, place);
    return one;
  }
};

/// A number of the bench that is the same in all runs.
struct BenchNumber {
  std::string_view name, variant, unit;
  double Bench::*of;
  double typical, lowest, highest;
};

/// A number of a law besides its size.
struct Shape {
  std::string path;
  double middle = 1.0, deviation = 1.0;  ///< of its logarithm, or
  bool logarithmic = true;               ///< of itself
  double furthest = 4.0;                 ///< deviations
  double value(double z) const {
    return logarithmic ? middle * std::exp(deviation * z) : middle + deviation * z;
  }
  double z(double value) const {
    return (logarithmic ? std::log(value / middle) : value - middle) / deviation;
  }
};

/// An effect of the rig, with one of its laws, or a fault of the bench.
struct Entry {
  std::string name;                             ///< laws of one effect share it
  std::optional<diagnose::Candidate> effect{};  ///< or
  const BenchNumber* bench = nullptr;
  double absent = 0.0, typical = 1.0;
  bool either_sign = false;
  double lowest = 0.0, highest = 0.0;  ///< sizes, in typical ones
  std::vector<Shape> shapes{};
  std::vector<std::vector<double>> begin{{}};  ///< shapes that a search begins from, in their deviations
  /// The effect in a rig that has its law, with this size and these shapes.
  void put(plant::Rig& rig, double size, const std::vector<double>& with) const;
};

/// Families of general terms of force.
enum class Terms { none, smooth, waves, rubs };
/// Members that come together: a sine and a cosine.
constexpr std::size_t together(Terms terms) {
  return terms == Terms::waves ? 2 : 1;
}

struct Added {
  std::size_t entry = 0;
  double size = 0.0;  ///< in units of its prior, like the
  std::vector<double> shapes{};
};

struct Point {
  Eigen::VectorXd z{};           ///< of the rig's parameters; empty: as described
  std::vector<Added> effects{};  ///< by entry
  Terms terms = Terms::none;
  std::vector<std::size_t> members{};  ///< of the family; empty: all
  Eigen::VectorXd coefficients{};      ///< of these [N]
  Eigen::VectorXd stretches{};         ///< of the wavelengths of members, of their logarithms, in deviations
  std::vector<int> differ{};           ///< of `differing`, ascending
  // Where numbers of runs are simulated that are integrated out: their prior is round nothing.
  OfRuns of_runs{};
  std::vector<Eigen::VectorXd> starts{};

  /// A whole family of terms is straight lines from where the rest stands; all else is simulated.
  bool has_lines() const { return terms != Terms::none && members.empty(); }
  bool has(std::size_t entry) const;
  bool lets_differ(int which) const;
  /// The same with one more, and without the one at a place among its own.
  Point with(Added added) const;
  Point without(std::size_t place) const;
  /// The same with one of `differing` no longer from run to run.
  Point alike_in(int which) const;
};

enum class Kind { parameter, size, shape, term, stretch };
struct Coordinate {
  Kind kind;
  std::size_t of;         ///< parameter, or place among the point's effects, or term, or wave
  std::size_t which = 0;  ///< of its shapes
};

/// Of the ranges of a point's coordinates.
struct Ends {
  Eigen::VectorXd lowest, highest;
};

class Dictionary {
 public:
  /// `written_coarsely`: in steps of so much, which may have been rounded or cut; 0: they are the sensor's.
  Dictionary(const domain::Dataset& data, double written_coarsely);

  std::vector<Coordinate> coordinates(const Point& point) const;
  Eigen::VectorXd vector(const Point& point) const;
  Ends ends(const Point& point) const;
  /// To the vector, or where it leaves a range to the end of that.
  Point moved(const Point& point, const Eigen::VectorXd& vector) const;
  Point described() const { return {}; }
  Point nominal() const { return {.z = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()))}; }
  Added clipped(Added added) const;

  Setting setting(const Point& point) const;
  /// The names of what is at work, in order.
  std::vector<std::string> names(const Point& point) const;
  /// Those of them that the bench has wrong in single runs.
  std::vector<std::string> faults_of_runs(const Point& point) const;
  std::size_t count_of_terms(Terms terms) const;
  std::size_t laws_of(const std::string& name) const;

  /// A parameter of the rig, or by how much muscle 2's is more than muscle 1's.
  struct Free : diagnose::Parameter {
    bool difference = false;
  };
  std::vector<Free> parameters;
  std::vector<Entry> entries;
  std::size_t all_names = 0;  ///< of which sets are made
  double reach_m = 0.0;       ///< how far the load was seen to rise
  bool forces_show = true;    ///< in what was read: general terms are forces

 private:
  void put_terms(const Point& point, plant::Rig& rig) const;

  plant::Rig described_;
};

}  // namespace mckibben::identify
