// modelDescription.xml: what an importer reads of an FMU before it loads it (fmi-standard.org, FMI 2.0
// section 2.2, FMI 3.0 section 2.4), written from the list of variables.
#pragma once

#include <string>

#include <plant/rig.hpp>

namespace mckibben::fmu {

enum class Version { two, three };

struct Description {
  Version version = Version::two;
  std::string name;   ///< of the model
  std::string token;  ///< by which description and program belong together
  bool true_states = false;
};

/// How an importer finds the program: the name of its file without the ending.
inline constexpr const char* model_identifier = "mckibben";

std::string description_xml(const Description& about, const plant::Rig& rig);

}  // namespace mckibben::fmu
