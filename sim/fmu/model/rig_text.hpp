// A rig as plain lines, `muscle.rest_radius 0.0075`, so that an FMU can carry it and needs no library to read
// it. Every member of the field lists has a line, those that are not at work too; before them stand its
// user's own laws, as the programs that the plant evaluates.
#pragma once

#include <string>
#include <string_view>

#include <plant/rig.hpp>

namespace mckibben::fmu {

/// What an FMU carries with it besides its program.
struct Contents {
  std::string token;  ///< by which an importer tells that description and program belong together
  plant::Rig rig;
};

std::string text_of(const Contents& contents);
/// Throws std::runtime_error naming the line.
Contents contents_of(std::string_view text);

}  // namespace mckibben::fmu
