// Folders take their places: all of them or none, also if the program is killed or the disk is full at any
// step. They wait in a container, a folder beside their places that nobody else writes (Lock).
//
//   1. all files are brought to the disk, then a record of what is to go where
//   2. each folder changes places with what stood there; an error undoes this, a kill leaves the record
//   3. what stood there before is removed if it is an earlier result of the same job, else set aside
//   4. the record is removed
//
// Whoever finds a record does what is left of 2 to 4. Which folders have changed places is told by their
// lists of files, whose digests are in the record.
// As long as there is a record, the container may hold what stood there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mckibben::output {

inline constexpr const char* record_name = "publish";

/// A sealed folder of the container, and where it is to go as the result of a job.
struct Move {
  std::string folder;
  std::filesystem::path place;
  std::string job;
};

/// What stood at a place and has been moved.
struct Aside {
  std::filesystem::path from, to;
};

/// Lets folders take their places. Returns what was set aside. Throws CannotWrite; then all is where it was.
std::vector<Aside> put_in_place(const std::filesystem::path& container, const std::vector<Move>& moves);

/// Whether somebody was killed in put_in_place.
bool is_on_its_way(const std::filesystem::path& container);

/// Completes what somebody was killed at. Throws CannotWrite; it can then be tried again.
std::vector<Aside> complete(const std::filesystem::path& container);

/// Says in a line what became of something that was found.
std::string to_text(const Aside& aside);

}  // namespace mckibben::output
