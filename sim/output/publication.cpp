// Record, exchange and undoing; see the header.
#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include <sim/output/file.hpp>
#include <sim/output/manifest.hpp>
#include <sim/output/publication.hpp>

namespace mckibben::output {
namespace fs = std::filesystem;
namespace {

bool is_there(const fs::path& path) {
  return fs::exists(fs::symlink_status(path));
}

/// Where what stood at a place waits if the file system cannot exchange two folders.
fs::path earlier(const fs::path& folder) {
  return folder.string() + ".old";
}

void swap_in(const fs::path& folder, const fs::path& place) {
  if (!is_there(place)) return rename_new(folder, place);
  if (exchange(folder, place)) return;
  rename_new(place, earlier(folder));
  try {
    rename_new(folder, place);
  } catch (const CannotWrite&) {
    rename_new(earlier(folder), place);
    throw;
  }
}

void swap_back(const fs::path& folder, const fs::path& place) {
  if (is_there(folder)) {
    exchange(folder, place);
    return;
  }
  rename_new(place, folder);
  if (is_there(earlier(folder))) rename_new(earlier(folder), place);
}

/// All or, if that cannot be, none.
void swap_all(const fs::path& container, const std::vector<Move>& moves) {
  std::size_t swapped = 0;
  try {
    for (const Move& move : moves) {
      swap_in(container / move.folder, move.place);
      ++swapped;
      bring_to_disk(move.place.parent_path());
    }
    bring_to_disk(container);
  } catch (const CannotWrite&) {
    for (; swapped > 0; --swapped) swap_back(container / moves[swapped - 1].folder, moves[swapped - 1].place);
    throw;
  }
}

/// Removes what stood at a place, or sets it aside. False if that cannot be done now.
bool settle(const fs::path& folder, const Move& move, std::vector<Aside>& asides) {
  bool ours = false;
  try {
    if (!is_there(folder)) return true;
    ours = is_ours(folder, move.job);
    if (ours) {
      remove_folder(folder);
    } else {
      const fs::path to = first_free(move.place);
      rename_new(folder, to);
      asides.push_back({move.place, to});
    }
    return true;
  } catch (const std::runtime_error&) {  // CannotWrite, or of std::filesystem
    if (!ours) asides.push_back({move.place, folder});
    return false;
  }
}

/// What is left to do once all are in their places. What cannot be done now is left to whoever comes next,
/// and so is the record.
std::vector<Aside> settle_all(const fs::path& container, const std::vector<Move>& moves) {
  std::vector<Aside> asides;
  bool settled = true;
  for (const Move& move : moves)
    for (const fs::path& folder : {container / move.folder, earlier(container / move.folder)})
      settled = settle(folder, move, asides) && settled;
  std::error_code ignored;
  if (settled) fs::remove(container / record_name, ignored);
  return asides;
}

struct Recorded {
  Move move;
  std::string seal;
};

/// Four fields for each folder, each ended by NUL: any path can be written so.
std::vector<Recorded> read_record(const fs::path& container) {
  std::vector<Recorded> found;
  std::istringstream record(read_regular(container / record_name).value_or(""));
  Recorded one;
  for (std::string place; std::getline(record, one.move.folder, '\0') && std::getline(record, place, '\0') &&
                          std::getline(record, one.move.job, '\0') && std::getline(record, one.seal, '\0');
       found.push_back(one))
    one.move.place = (container.parent_path() / place).lexically_normal();
  return found;
}

void write_record(const fs::path& container, const std::vector<Move>& moves) {
  std::string record;
  for (const Move& move : moves)
    for (const std::string& field :
         {move.folder, move.place.lexically_relative(container.parent_path()).string(), move.job,
          seal_of(container / move.folder)})
      record += field + '\0';
  write_whole(container / record_name, record);
}

/// Whether the folders are still, or again, in the container.
bool none_has_moved(const fs::path& container) {
  const auto record = read_record(container);
  return std::all_of(record.begin(), record.end(),
                     [&](const Recorded& one) { return seal_of(container / one.move.folder) == one.seal; });
}

}  // namespace

std::vector<Aside> put_in_place(const fs::path& container, const std::vector<Move>& moves) {
  for (const Move& move : moves) bring_tree_to_disk(container / move.folder);
  write_record(container, moves);
  try {
    swap_all(container, moves);
  } catch (const CannotWrite&) {
    std::error_code ignored;
    if (none_has_moved(container)) fs::remove(container / record_name, ignored);
    throw;
  }
  return settle_all(container, moves);
}

bool is_on_its_way(const fs::path& container) {
  return !read_record(container).empty();
}

std::vector<Aside> complete(const fs::path& container) {
  std::vector<Move> waiting, all;
  for (const auto& [move, seal] : read_record(container)) {
    all.push_back(move);
    if (seal_of(container / move.folder) == seal && seal_of(move.place) != seal) waiting.push_back(move);
  }
  swap_all(container, waiting);
  return settle_all(container, all);
}

std::string to_text(const Aside& aside) {
  return fmt::format("{} was not an unchanged earlier result of this verb and input; it was moved to {}",
                     aside.from.string(), aside.to.string());
}

}  // namespace mckibben::output
