// What was recorded of a session, as data sets on disk. Recordings of one rig go into one data set, each a
// run with its load; once effects are switched the rig is another one, and a new data set begins. As those
// that `dataset` makes, it holds the rig without what was switched on; that is in a folder beside it, with
// -truth at its end. Rows are on disk as they come: in OUT.unfinished, until their data set is whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <string>
#include <vector>

#include <sim/live/session.hpp>
#include <sim/output/folder.hpp>
#include <sim/output/unfinished.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::live {

struct Recording {
  plant::Rig rig, known;     ///< as it was; without what was switched on
  std::uint64_t number = 0;  ///< of a session's
  double load_kg = 0.0;      ///< of one muscle
  bool settled = false;      ///< it began at rest
  run::Recording rows{};
  std::string ended{};  ///< why, if the user did not stop it

  /// The same with the rows from that one on.
  Recording from(std::size_t row) const;
};

/// Fewer rows make no run.
inline constexpr std::size_t least_rows = 100;

class DataSets {
 public:
  /// `first`: the folder of the first data set; the next ones are called FIRST-2, ... `session`: words that
  /// no other session has, so that none takes the place of another's. `say`: hears what was set aside.
  DataSets(std::filesystem::path first, std::string session, output::Say say);

  /// More rows of a recording that goes on: those behind `rows_of(number)`. What cannot be written is said
  /// once.
  void follow(const Recording& further);
  std::size_t rows_of(std::uint64_t number) const;
  /// It comes to nothing.
  void drop(std::uint64_t number);

  /// Adds a run, and writes its data set anew. Returns the folder. Throws output::CannotWrite; the run is
  /// kept, and written with the next one.
  std::filesystem::path put(Recording recording);
  /// Writes again what could not be written. Throws output::CannotWrite.
  void flush();

  std::size_t runs() const { return runs_.size(); }  ///< of the data set that was written last

 private:
  struct Followed {
    std::uint64_t number;
    std::size_t rows = 0;
    std::list<output::Unfinished> folders{};  ///< what was measured, and the truth
  };

  void begin(Followed& one, const Recording& first);
  void write();
  std::filesystem::path folder() const;

  std::filesystem::path first_;
  std::string session_;
  output::Say say_;
  std::size_t number_ = 0;
  bool written_ = true;
  std::vector<Recording> runs_;
  std::list<Followed> followed_;
};

}  // namespace mckibben::live
