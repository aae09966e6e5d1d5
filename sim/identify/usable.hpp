// What of measured data counts, before anything is fitted.
#pragma once

#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::identify {

struct Usable {
  std::vector<std::vector<bool>> masked;  ///< [run][row]: readings that are not the load's
  std::vector<std::size_t> runs;
  std::vector<std::string> warnings{};  ///< each names its run
  std::vector<diagnose::FaultyRun> faulty{};
  std::string cannot_tell{};  ///< why these data decide nothing; empty where they may
};

/// What the data show by themselves is not fitted: dead gauges, which go from `data`, copies, runs that never
/// move, single odd readings. Labels of loads are the likelihood's. Throws data::UnfitData where a column is
/// not what it is called; run::Interrupted.
Usable usable(domain::Dataset& data, unsigned threads);

}  // namespace mckibben::identify
