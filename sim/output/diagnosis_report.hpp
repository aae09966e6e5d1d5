// A diagnosis as a page to read: report.html, one file that needs nothing else, without scripts.
#pragma once

#include <string>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/input/dataset.hpp>

namespace mckibben::output {

std::string report_html(const input::Dataset& data, const diagnose::Diagnosis& diagnosis);

}  // namespace mckibben::output
