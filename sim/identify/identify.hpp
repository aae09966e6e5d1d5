// What is missing, by one likelihood, in five stages:
//
//   rows      what was read, and what wander of the input does to it         rows, simulator
//   fit       the rig as described, and with its parameters free             model, error
//   screen    which sets of effects and bench faults would explain more      screen
//   descend   the best of them, to their most probable numbers               model
//   decide    the simplest that predicts unseen runs as well                 decide
//
// Screen and descend go on from the best set as long as that gains.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <sim/identify/decide.hpp>
#include <sim/identify/estimates.hpp>
#include <sim/identify/model.hpp>

namespace mckibben::identify {

struct Settings {
  unsigned threads = 0;
  std::function<void(const std::string&)> say{};  ///< hears of each step
};

struct Identified {
  Decision decision{};
  std::vector<Judged> table{};
  std::vector<Estimate> sizes{};       ///< of effects and bench faults of the one chosen
  std::vector<Estimate> parameters{};  ///< of its rig, in deviations of the sheet
  double left = 0.0, white = 0.0,
         model_error = 0.0;  ///< rms of the judged reading; in units of a count or the noise
  long passes = 0;
};

/// Of data with rows (data::with_rows). Throws data::UnfitData, run::Interrupted.
Identified identify(domain::Dataset data, const Settings& settings);

}  // namespace mckibben::identify
