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
  linear::Question question;
  std::vector<linear::Study> studies;
  std::vector<std::string> not_linear{};  ///< controllers
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

/// The PID by margins as a scenario has it.
std::string pid_line(const Linearised& all, const linear::Study& study);

}  // namespace mckibben::output
