// A search for what is missing that was ended, as a file: what it had simulated. A search on the same data
// asks for the same in the same order, so it goes on from there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sim/domain/input_file.hpp>
#include <sim/identify/simulator.hpp>

namespace mckibben::tasks {

/// The file's leaf, in the folder of a diagnosis.
inline constexpr const char* kept_search = "search.bin";

/// A line of text (version, hash of the input files, shapes), then the numbers as the machine has them;
/// sealed.
std::string bytes_of(const identify::Simulated& simulated, const std::vector<domain::InputFile>& inputs);

/// Throws input::MissingInput where there is no such file; input::BadInput where it is of other data, of
/// another version, or damaged.
identify::Simulated simulated_in(const std::filesystem::path& file,
                                 const std::vector<domain::InputFile>& inputs);

}  // namespace mckibben::tasks
