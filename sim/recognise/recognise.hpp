// What tables that nobody described seem to hold: which column is what, in which unit, with which sign and
// zero, which loads hung there, and what follows for the rig. Every guess has its reason; where nothing
// tells, it is left open and stands as FILL_IN in the files, which no reader takes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plant/valve.hpp>
#include <sim/domain/columns.hpp>
#include <sim/domain/fill_in.hpp>
#include <sim/recognise/unknown_table.hpp>

namespace mckibben::recognise {

/// A value as a file says it, and what told it.
struct Told {
  std::string value, reason;
  bool doubtful = false;  ///< a zero that loads seem to have moved
  bool was_read = false;  ///< a zero: the reading without pressure, load or not
  bool open() const { return value == domain::fill_in; }
};
inline Told left_open(std::string reason) {
  return {std::string(domain::fill_in), std::move(reason)};
}

struct ColumnGuess {
  const domain::Quantity* quantity = nullptr;
  Told column, unit;
  std::optional<Told> zero, factor;  ///< none: 0 and 1
  std::optional<Told> input;         ///< what it is read as: it drives the simulation; of time: interval
  std::optional<Told> time;          ///< the column of its own clock
  std::optional<Told> missing{};     ///< a number that stands for none
  std::string in_file{}, where{};    ///< in a long table: the column of all readings, and which rows are its
};

/// A key of a file: `valve.span_command`.
struct Setting {
  std::string key;
  Told told;
};

/// A map from quantities to columns, for tables whose columns have the same names.
struct MapGuess {
  std::vector<ColumnGuess> columns;
  std::vector<Told> ignored;           ///< names of columns, and why
  std::vector<std::string> remarks{};  ///< what else the tables say
  std::optional<Setting> rows;         ///< where no column holds time: `rows_are_ticks` or `settled`

  const ColumnGuess* find(std::string_view key) const;
};

struct RunGuess {
  std::string id;
  std::size_t map = 0;  ///< of `Recognised::maps`
  std::optional<Told> load;
};

struct Recognised {
  std::vector<UnknownTable> tables;  ///< one that holds several runs once for each
  std::vector<RunGuess> runs;        ///< one for each table, or part of one
  std::vector<MapGuess> maps;        ///< the first is that of the data set
  std::vector<Setting> dataset;      ///< its keys besides rig, columns and runs
  std::vector<Setting> rig;

  /// Whether the data set may say it for all runs: a run takes over what its own columns do not name.
  bool each_has(std::string_view key) const;
  bool each_has_rows() const;
  /// How many values are left to be filled in.
  std::size_t open() const;
};

/// What a rig that is known tells of its tables; 0 or empty: nothing does.
struct KnownRig {
  double tick_s = 0.0, rest_length_m = 0.0;
  bool holds_a_length = false;
  std::optional<plant::Valve> valve{};
};

/// Reads and understands. `rig_is_known`: nothing is said of it but the range of commands that are in another
/// unit than its valve's. Throws MissingInput, BadInput.
Recognised recognise(const std::vector<std::filesystem::path>& files, bool rig_is_known,
                     const KnownRig& rig = {});

/// The numbers of a table's column as the map brings them to the unit that is said; empty if none is named.
std::vector<double> shown(const UnknownTable& table, const ColumnGuess& guess);

}  // namespace mckibben::recognise
