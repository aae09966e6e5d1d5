// The parameters of a model as they are reported: with 95 % intervals of the posterior, which model error has
// widened; and the rig that has them, in as many digits as they need.
#pragma once

#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/identify/model.hpp>

namespace mckibben::identify {

/// All of one model, after its evidence.
struct Estimates {
  plant::Rig rig;
  std::vector<diagnose::NamedEffect> effects{};  ///< with their parameters, as in the point
  std::vector<diagnose::FittedNumber> bench{};  ///< numbers of the bench that all runs share, as in the point
  std::vector<diagnose::Moved> moved{};
  std::vector<diagnose::LawTerm> law{};
  std::vector<diagnose::LeftOpen> left_open{};
};
Estimates estimates_of(const Model& model);

/// The model's point; with general terms, which are straight lines from there, where they lead.
Point most_probable(const Model& model);

}  // namespace mckibben::identify
