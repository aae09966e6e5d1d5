// A controller in a shared library with the C interface of mckibben_controller.h (docs/your_controller.md).
// Quicker than a process of its own, but what it breaks is ours.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <controllers/guest.hpp>

namespace mckibben::controllers {

struct PluginSettings : GuestTerms {
  static constexpr std::string_view kind = "plugin";
  std::string name{kind};
  std::string library;
  std::string settings;

  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    visit.required("library", self.library, "shared library, as a path from this file");
    visit("settings", self.settings, "any text, which the library is given");
    GuestTerms::fields(self, visit);
  }
  void rules(auto& report) const {
    if (library.empty()) report("library", "must name a file");
    OutputLimits::rules(report);
  }
};

}  // namespace mckibben::controllers
