// Measured columns that differ from what the rig would do by a scale or a zero, or go beyond it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sim/data/examine.hpp>
#include <sim/data/finding.hpp>
#include <sim/data/units.hpp>
#include <sim/domain/columns.hpp>

namespace mckibben::data {

/// Measured and simulated, row by row.
struct Compared {
  std::vector<std::size_t> runs{};
  std::vector<double> measured{}, model{};

  /// Rows of a run in which one of its readings is there; nothing if the simulation ended early.
  void add(std::size_t place, const domain::Run& run, const Expected& expected, std::size_t reading = 0) {
    if (reading >= expected.readings.size()) return;
    const domain::Reading& read = run.readings[reading];
    const std::vector<double>& simulated = expected.readings[reading];
    if (read.values.size() != simulated.size()) return;
    runs.push_back(place);
    for (std::size_t k = 0; k < simulated.size(); ++k) {
      if (read.is_missing(k)) continue;
      measured.push_back(read.values[k]);
      model.push_back(simulated[k]);
    }
  }
  void add(const Compared& more) {
    runs.insert(runs.end(), more.runs.begin(), more.runs.end());
    measured.insert(measured.end(), more.measured.begin(), more.measured.end());
    model.insert(model.end(), more.model.begin(), more.model.end());
  }
};

/// A decoder that counts every second edge, or every edge twice: of a contraction or an angle.
std::optional<Finding> halved_or_doubled(const Compared& reading, const std::string& key,
                                         domain::ColumnPlace place);

/// A contraction that is too large or too small by the same everywhere. `ratio_per_unit`: of its column.
std::optional<Finding> other_zero(const Compared& contraction, domain::ColumnPlace place,
                                  double ratio_per_unit);

/// Runs that begin away from where the load rests, under a pressure that comes nowhere near to lifting it:
/// what no effect and no strength of the muscle explains.
std::optional<Finding> other_zero_at_rest(const domain::Dataset& data, const std::vector<Expected>& expected,
                                          domain::ColumnPlace place);

/// Contractions that neither the braid nor the model in any run comes near to.
std::optional<Finding> beyond_the_rig(const domain::Dataset& data, const std::vector<Expected>& expected);

/// Commands that fill where contraction falls and vent where it rises: those of two valves that are open or
/// shut set a flow, so that no scale of the contraction shows it.
std::optional<Finding> reversed_flow(const domain::Dataset& data);

/// A gauge that goes along with the model and shows many times, or a part of, what it would do: in another
/// of the `units` that it may be in,
std::optional<Finding> other_unit_of_gauge(const Compared& gauge, const std::string& key,
                                           domain::ColumnPlace place, const std::vector<Unit>& units);
/// or by a factor: that of a gauge is one for all runs that it reads, or none.
std::optional<Finding> other_gain(const std::vector<Compared>& runs, const std::string& key,
                                  domain::ColumnPlace place);
/// or what a wrong span of the valve that fills the muscle would have the rig do, in all runs. `runs`: of
/// each alone.
std::optional<Finding> other_span(const std::vector<Compared>& runs, const std::string& key,
                                  domain::ColumnPlace place, const plant::Valve& valve);
/// A gauge that reads another constant too much or too little where all runs begin at rest, and comes back
/// to it. `accuracy_Pa`: rms.
std::optional<Finding> other_zero_of_gauge(const std::vector<Compared>& runs, const std::string& key,
                                           domain::ColumnPlace place, double accuracy_Pa);
/// A load cell that reads the same too much or too little whatever hangs, by the same factor, or both; or in
/// one run: its zero there, or the label. `runs`: of each alone; `unit_N`: of the column.
std::optional<Finding> load_cell_off(const domain::Dataset& data, const std::vector<Expected>& expected,
                                     const std::vector<Compared>& runs, const std::string& key,
                                     domain::ColumnPlace place, double unit_N, double accuracy_N);
/// Runs whose load cell does not read what hangs there, beside others whose does: it would in the unit or
/// with the zero of the others, or in another unit;
std::vector<Finding> load_cell_read_otherwise(const domain::Dataset& data,
                                              const std::vector<Expected>& expected,
                                              const std::vector<Compared>& runs, const std::string& key,
                                              double accuracy_N);
/// or the column of another reading would.
std::vector<Finding> exchanged_with_a_load_cell(const domain::Dataset& data,
                                                const std::vector<Expected>& expected);
/// A pressure that is given to a muscle at given lengths, in a larger unit than is said, by its force.
std::vector<Finding> pressures_of_a_held_muscle(const domain::Dataset& data);
/// Whether a gauge may read so many times what the rig would do.
bool is_gauge_slope(double slope);

/// Another unit in which readings move as far as the model and little is left between them: its root, of the
/// readings' range.
struct FittingUnit {
  std::string name;
  double left;
};
std::optional<FittingUnit> unit_that_fits(const Compared& reading, const domain::ColumnPlace& said,
                                          const std::vector<Unit>& units);

}  // namespace mckibben::data
