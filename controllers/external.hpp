// A controller in a process of its own: one line of counts in, one command out a tick, in any language
// (docs/your_controller.md).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <controllers/guest.hpp>

namespace mckibben::controllers {

/// The version of the lines that go to and fro.
inline constexpr int external_version = 1;

struct ExternalSettings : GuestTerms {
  static constexpr std::string_view kind = "external";
  std::string name{kind};
  std::string command;
  double time_limit_s = 1.0, start_limit_s = 10.0;

  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    visit.required("command", self.command,
                   "what the shell is to run, in the folder of this file: one process for each run");
    visit("time_limit", self.time_limit_s, "s", 1e-3, 3600.0, "longest that it may take for an answer");
    visit("start_limit", self.start_limit_s, "s", 1e-3, 3600.0, "longest that it may take for the first one");
    GuestTerms::fields(self, visit);
  }
  void rules(auto& report) const {
    if (command.find_first_not_of(" \t\n") == std::string::npos) report("command", "must name a program");
    OutputLimits::rules(report);
  }
};

}  // namespace mckibben::controllers
