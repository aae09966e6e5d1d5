// A run as a ride follows it: stamps, and what acts on the rig from each to the next. From a table of
// measured stamps, from a row each tick, or made up.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/ride/ride.hpp>
#include <sim/ride/underway.hpp>

namespace mckibben::run {

struct Course {
  std::vector<double> time_s;       ///< stamps, ascending
  std::vector<ride::Drive> drives;  ///< at each: commands, forces, the supply are held from it on; pressures,
                                    ///< lengths are what they are there, and run straight to the next
  std::vector<std::size_t> rows;    ///< stamps that have a row, ascending
  bool outer_force = false;         ///< one is given, on the joint
  std::optional<double> filled_Pa;  ///< as a gauge shows it: to where a sealed muscle is filled before
  std::optional<ride::Underway> begins;  ///< on its way, at the first stamp; none: settled

  /// What acts from stamp `k` until the next. From the last one pressures and lengths go on as they came.
  ride::Drive toward(std::size_t k) const;
  /// When that ends; of the last, as long as the one before it lasted, or `alone_s` where there is none.
  double until_s(std::size_t k, double alone_s) const;
};

/// A row for each stamp. Where inputs do otherwise between stamps than a drive does, there are further
/// stamps: commands, forces and the supply, where they run straight on, are held at their mean for a tick at
/// most, pressures that stay jump within a microsecond. Of settled points the stamp is when a point is read,
/// at the end of its time: its command holds all of that time, a pressure or length that is given runs
/// straight to it in the first half. To the first point pressures rise from none as slowly: let go at a
/// pressure, a load swings past where friction would have held it.
Course course_of(const domain::Measurement& measured, const plant::Rig& rig);

/// Of a run with a clock of its own, or with a row each tick of `rig`.
Course course_of(const domain::Run& run, const plant::Rig& rig);

}  // namespace mckibben::run
