// The page in a browser: three texts, which ask for nothing outside the program. What it draws of the rig,
// its colours and its plots are those of reports (sim/report).
#pragma once

#include <string>

#include <sim/live/session.hpp>

namespace mckibben::live {

struct Page {
  std::string html, css, js;
};

/// `name`: of the rig, for the heading.
Page page_of(const std::string& name, const plant::Rig& rig, const Session& session);

}  // namespace mckibben::live
