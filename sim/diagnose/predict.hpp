// What instruments would read in a measured run, if the rig were this one: what drove the run sent through
// several rigs side by side, and how the readings change with parameters.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <plant/solver.hpp>
#include <plant/state.hpp>
#include <sim/data/examine.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/ride/rider.hpp>
#include <sim/run/follow.hpp>

namespace mckibben::diagnose {

using ride::Loaded;

/// At each row, before counting.
struct Readings : data::Expected {
  std::vector<plant::State<double>> states;  ///< of the first rig only
};

/// Readings of up to engine::Batch::width rigs, in common steps where these can be had (ride::Batch). Ticks
/// are those of the first rig. `memories`: of runs that began on their way, how far those of each rig's
/// effects are from rest (ride::Underway). Throws engine::NumericalFailure.
std::vector<Readings> predict(const domain::Run& run, std::span<const Loaded> rigs,
                              solver::Method method = solver::Method::automatic,
                              std::span<const double> memories = {});

/// A prediction that is wanted: of a run, for rigs of which the first is the one whose slopes others tell.
struct Wanted {
  const domain::Run* run;
  std::vector<Loaded> rigs;
  run::Disturbance disturbance{};
  std::optional<double> tolerance{};  ///< of the integration; none: as `settings_for` says
};
/// Hears of one: its readings, or why there are none (an engine::NumericalFailure).
using Predicted =
    std::function<void(std::size_t index, std::vector<Readings> readings, std::exception_ptr failure)>;

/// Many predictions, in batches on `threads` threads: those whose rigs can, in common steps; the others as
/// `predict` does. The result of one depends neither on threads nor on what shares the batch. Both
/// functions are called from any thread, in any order. `rigs`: of all together, about. Throws
/// run::Interrupted.
void predict_all(std::size_t count, std::size_t rigs, unsigned threads, solver::Method method,
                 const std::function<Wanted(std::size_t index)>& wanted, const Predicted& predicted);

/// How `predict` integrates these rigs.
solver::Settings settings_for(std::span<const Loaded> rigs, solver::Method method);

}  // namespace mckibben::diagnose
