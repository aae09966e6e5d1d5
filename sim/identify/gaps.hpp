// How far models are from the readings of runs that they predict from the others.
#pragma once

#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/identify/identify.hpp>

namespace mckibben::identify {

/// What each model of the table leaves where runs are held out, row by row.
std::vector<Eigen::VectorXd> unpredicted_by_all(const Identified& found);

/// The three models of a report.
struct Three {
  const Model &nominal, &recalibrated, &corrected;
  const Eigen::VectorXd &by_nominal, &by_recalibrated, &by_corrected;  ///< that they leave
};

diagnose::Gap gap_of(const Identified& found, const Three& three, const diagnose::NoiseFloor& floor);

/// Of all runs, those left out as well. `experiment`: of the same data.
std::vector<diagnose::RunGap> gaps_of_runs(const Identified& found, const Three& three,
                                           const diagnose::Experiment& experiment);

}  // namespace mckibben::identify
