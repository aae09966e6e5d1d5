// The pictures of a diagnosis, drawn by us: where model and data disagree, how candidates rank and resemble
// each other, what nominal parameters had absorbed, errors run by run. All are 460 units wide, so that their
// text stays readable on a small screen; colours are those of the page's style (c0 to c6).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <plant/rig.hpp>
#include <sim/diagnose/diagnosis.hpp>
#include <sim/report/contents.hpp>

namespace mckibben::report {

/// What is in a cell of the map, its lengths in the unit that the reader wants.
std::string cell_html(const diagnose::Cell& cell, const plant::Rig& rig, std::string_view tag = "span");

/// The map of disagreement: a picture for each factor.
std::vector<Picture> where_pictures(const diagnose::Diagnosis& diagnosis, const plant::Rig& rig);

/// Candidates, a picture for each round, their bars on one scale.
std::vector<Picture> ranking_pictures(const diagnose::Diagnosis& diagnosis, const plant::Rig& rig);

/// Prior deviations by which nominal parameters are moved without and with the effects.
std::string absorbed_svg(const diagnose::Diagnosis& diagnosis);

/// Errors of the models, run by run in this order, on a logarithmic axis. A row leads to its run's plots
/// (data-group). `changed`: whether there is a corrected rig.
std::string errors_svg(const std::vector<const diagnose::RunGap*>& runs, const diagnose::Gap& gap,
                       bool changed, const plant::Rig& rig);

}  // namespace mckibben::report
