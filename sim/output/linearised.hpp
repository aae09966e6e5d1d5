// What the verb `linearise` writes.
#pragma once

#include <string>
#include <vector>

#include <plant/rig.hpp>
#include <sim/domain/input_file.hpp>
#include <sim/linear/study.hpp>

namespace mckibben::output {

struct Linearised {
  std::string name;  ///< of rig or scenario
  plant::Rig rig;
  linear::Question question{};
  std::vector<linear::Study> studies{};
  std::vector<std::string> not_linear{};  ///< controllers
  std::vector<std::string> no_loop{};     ///< those that play a command
  struct Tuned {
    std::string controller;
    controllers::PidForm pid;
  };
  std::vector<Tuned> tuned{};  ///< gains that the scenario left out
  std::vector<domain::InputFile> files{};
};

/// "11 kg at 9.5 mA"
std::string title_of(const Linearised& all, const linear::Study& study);

std::string table_of(const Linearised& all);
std::string json_of(const Linearised& all);
std::string bode_csv(const Linearised& all, const linear::Study& study);
std::string bode_svg(const Linearised& all, const linear::Study& study);
/// Programs that make the systems in python-control and in MATLAB.
std::string python_control(const Linearised& all);
std::string matlab(const Linearised& all);

/// Gains as a scenario has them, and the whole PID by margins.
std::string gains_text(const Linearised& all, const controllers::PidForm& pid);
std::string pid_line(const Linearised& all, const linear::Study& study);

}  // namespace mckibben::output
