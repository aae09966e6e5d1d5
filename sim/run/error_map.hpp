// Error maps of the thesis's controller (figures 4.50, 4.51): in one triangle of current to each of many
// target contraction ratios at each of several speeds, how far from both the load is when it should be there;
// and which targets the rig can reach at all (T 5).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <controllers/calibration.hpp>
#include <controllers/inverse.hpp>
#include <controllers/reach.hpp>
#include <plant/rig.hpp>
#include <sim/run/compare.hpp>

namespace mckibben::run {

struct MapPlan {
  plant::Rig rig;
  controllers::Calibration calibration;
  std::vector<double> loads_kg;
  std::vector<controllers::Branch> branches;
  std::vector<double> ratios;        ///< targets, ascending
  std::vector<double> speeds_per_s;  ///< targets, ascending, positive on both branches
  bool extrapolate_load = false, extrapolate_target = false;  ///< as the controller's settings
};

/// Where the load was when the controller said it would be there.
struct Arrival {
  double ratio = 0.0;
  double speed_per_s = 0.0;  ///< positive in the branch's direction
};

/// One target. Speeds are positive in the branch's direction, errors are arrival less target.
struct MapCell {
  double ratio = 0.0, speed_per_s = 0.0;
  bool reachable = false;            ///< the rig can pass that ratio at that speed
  controllers::Answer asked{};       ///< what the inverse made of it
  bool off_the_line = false;         ///< the valve has no current for the pressure asked
  std::optional<Arrival> arrival{};  ///< absent if there was no run
  std::string failure{};             ///< why not

  /// Whether the inverse answered the question as it was asked.
  bool as_asked() const {
    return !asked.ratio_outside && !asked.speed_outside && !asked.unreachable && !off_the_line;
  }
  /// Only if there is an arrival.
  double ratio_error() const { return arrival->ratio - ratio; }
  double speed_error_per_s() const { return arrival->speed_per_s - speed_per_s; }
};

struct BranchMap {
  controllers::Branch branch;
  std::vector<MapCell> cells;  ///< speed by speed, in each ratio by ratio
};

struct LoadMap {
  double load_kg = 0.0;
  double weighed_kg = 0.0, spread_kg = 0.0;
  double believed_kg = 0.0;  ///< what the controller goes on with: weighed, or the calibrated range's end
  bool extrapolated = false;
  std::string failure{};  ///< why there is no map: it could not be weighed, or the calibration does not hold
  controllers::ReachOfLoad limits{};
  std::vector<BranchMap> branches{};

  double weighing_error() const { return weighed_kg / load_kg - 1.0; }
};

struct ErrorMaps {
  controllers::Reach reach;
  std::vector<LoadMap> loads;
  bool interrupted = false;  ///< the user stopped it; cells not begun say so in `failure`
};

/// Root mean squares over some of a map's cells.
struct MapError {
  std::size_t cells = 0;
  double ratio = 0.0, speed_per_s = 0.0;
};
MapError error_over(const BranchMap& map, const std::function<bool(const MapCell&)>& chosen);

/// Whether a calibration was made with loads on both sides of that one. Both come from round numbers in
/// files: the rounding of a unit is no difference.
bool covers(const controllers::CalibratedRange& range, double load_kg);

/// Whether a load of those limits can pass a contraction ratio at a speed [1/s], positive on both branches:
/// between the ends of its way there, and not above the largest speed.
bool within_reach(const controllers::Reach& reach, const controllers::ReachOfLoad& limits,
                  controllers::Branch branch, double ratio, double speed_per_s);

/// Weighs each load once, as the controller does, then runs the controller to every target with that load as
/// the one it believes in. On `threads` threads (0: all the machine has); the result does not depend on it.
/// Throws Interrupted if stopped while weighing.
ErrorMaps error_maps(const MapPlan& plan, unsigned threads, const ProgressHook& progress);

}  // namespace mckibben::run
