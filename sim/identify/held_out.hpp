// Runs predicted from the others, by the model made straight at its optimum: no simulation.
#pragma once

#include <vector>

#include <sim/identify/model.hpp>

namespace mckibben::identify {

/// Runs that are held out together: those of one load, or each by itself where there are fewer than three.
std::vector<std::vector<std::size_t>> groups_of(const Rows& rows);

/// log p(rows of a group | all others), of each group; after the model's evidence.
Eigen::VectorXd held_out(const Model& model, const std::vector<std::vector<std::size_t>>& groups);

/// What a model leaves of each row where its group is predicted from all others. Numbers of the runs
/// themselves (faults of the bench, how they began) are the run's own.
Eigen::VectorXd unpredicted(const Model& model, const std::vector<std::vector<std::size_t>>& groups);

/// Of what is `left`: the part that is a run's own numbers, where they are most probable.
Eigen::VectorXd of_runs(const Model& model, const Eigen::VectorXd& left);

}  // namespace mckibben::identify
