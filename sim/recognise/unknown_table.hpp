// A measured table of which nobody has said what its columns are: all that can be read of it as numbers, and
// what its file says of the recording.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sim/domain/input_file.hpp>

namespace mckibben::recognise {

struct UnknownColumn {
  std::string name;  ///< by which a data set names it: heading, channel, variable, number
  std::string unit;  ///< that a line below the headings says; empty: none
  bool is_date = false;
  std::string epoch{};               ///< the first number, where all are those since it: stamps since 1970
  std::vector<double> values{};      ///< NaN where there is no number; of dates seconds since the first
  std::string label{};               ///< how the file calls it besides; empty: only by its name
  std::vector<std::string> texts{};  ///< of a column of words: its values are their places in this list
  std::string in_file{}, where{};    ///< of a quantity in a long table: its column, and which rows are its
  std::string odd{};      ///< cells of a column of numbers that hold none; empty: there are no such
  std::string missing{};  ///< a number of it that stands for none; its values are none; empty: there is none
  std::string either{};   ///< a number of it whose sign may stand before decimals or between thousands

  const std::string& heading() const { return label.empty() ? name : label; }
};

/// A line above the table such as `Fs = 1000 Hz`.
struct Remark {
  std::string key, value;
};

struct LoadGuess {
  std::string quantity;  ///< "5 kg", or FILL_IN
  std::string reason;
};

/// A line of words between rows.
struct Between {
  std::size_t row;  ///< below it
  std::size_t line;
  std::string text;
};

struct UnknownTable {
  std::filesystem::path path;
  std::string sheet{};  ///< its name; empty: the file has none
  domain::InputFile input;
  std::vector<std::string> remarks;  ///< lines above the headings
  std::vector<Remark> settings;      ///< those of them that say a value
  std::vector<Between> between{};
  char decimal = '\0';                 ///< before the decimals of its numbers; 0: none of them tells
  std::string note{};                  ///< that not all of its rows are here, or are one run; else empty
  std::vector<UnknownColumn> columns;  ///< of numbers; `time_is_inside` of an .lvm comes without one
  std::vector<UnknownColumn> texts;    ///< of a few words that come again
  std::vector<std::string> words;      ///< columns that hold neither
  bool time_is_inside = false;         ///< an .lvm, which needs no column of time
  bool has_headings = true;
  bool reordered = false;           ///< rows are left out, or in another order than in the file
  std::vector<std::string> part{};  ///< which of the file it is, as a run says it: `segment: 2`
  std::optional<LoadGuess> load{};  ///< that a column of it says

  const UnknownColumn* find(const std::string& name) const;
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
  /// Only these rows of it.
  UnknownTable rows(const std::vector<std::size_t>& which, const std::string& says = "") const;
};

/// One, or one for each sheet. Throws MissingInput; BadInput for a file without a table, or one that can be
/// taken in two ways.
std::vector<UnknownTable> read_unknown(const std::filesystem::path& path, std::uintmax_t together = 0);

/// Time between two rows that the settings say [s]; 0 if they say none, or two.
struct SaidStep {
  double step_s = 0.0;
  std::string reason;
};
SaidStep said_step(const UnknownTable& table);

}  // namespace mckibben::recognise
