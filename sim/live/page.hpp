// The page in a browser: three texts, which ask for nothing outside the program. What it draws of the rig,
// its colours and its plots are those of reports (sim/report).
#pragma once

#include <string>
#include <vector>

#include <sim/input/json.hpp>
#include <sim/live/session.hpp>

namespace mckibben::live {

struct Page {
  std::string html, css, js;
};

/// `name`: of the rig, for the heading.
Page page_of(const std::string& name, const plant::Rig& rig, const Session& session);

/// What the page is sent of each instant, and what these signals are: key, unit.
std::vector<plant::Channel> channels_of(const plant::Rig& rig);
input::Json signals_json(const plant::Rig& rig);

/// Appends a sample as a list of numbers, one for each channel; what is no number is null.
void append(std::string& text, const std::vector<plant::Channel>& channels, const Sample& sample);

input::Json effect_json(const Switch& one);
input::Json sweep_json(const Sweep& sweep);

}  // namespace mckibben::live
