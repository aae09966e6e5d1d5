// Readers of measured tables: of text, of LabVIEW's and MATLAB's files. Each reads the wanted columns; those
// that are not needed only if they are there.

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sim/input/table.hpp>

namespace mckibben::input {

// Tables in text, whatever the file's ending: text_layout.hpp finds them. Numbers are finite, in quotes or
// not, with a decimal point or a decimal comma throughout. Columns are named by their heading or by their
// number. Extra ones are ignored (and may hold text); cells that lack at the end of a row are empty.

/// What to say of a column that is not among the headings `found`, besides that.
using MissingHint = std::string (*)(const WantedColumn& column, std::span<const std::string_view> found);

/// That a file was too large for all of its lines; empty if it was not.
std::string note_of_thinned(const Source& source);

/// Reads the wanted columns; those that are not needed only if they are there.
Table read_text(const Source& source, std::span<const WantedColumn> wanted, TableProblems& problems,
                MissingHint hint = nullptr);

/// The same for columns under our own names.
Table read_table(const Source& source, std::span<const std::string_view> required,
                 std::span<const std::string_view> optional, TableProblems& problems);

// LabVIEW Measurement files (.lvm), after National Instruments' specification of versions 1 and 2: a header,
// then segments, each with a header of its own, a row of channel names, and rows with a tab (or a comma)
// between the cells and perhaps a remark at the end.

/// Times of the first channel, and of that whose name follows: their X column, or X0 and Delta_X where there
/// is none, since the first row. Times that are as near as that are the same.
inline constexpr std::string_view lvm_time = "time_s", lvm_time_of = "time of ";
inline constexpr double lvm_same_s = 1e-6;

/// Reads the wanted channels. `in_file` is a channel's name, or its column's number from 1; left empty, it is
/// `lvm_time`. Channels without `own_clock` must have that time. `segment`: which one, from 1; 0 for all of
/// them, one after the other.
Table read_lvm(const Source& source, std::span<const WantedColumn> wanted, std::size_t segment,
               TableProblems& problems);

/// The channels of the first segment, without those of time and of remarks; none if it cannot be read.
std::vector<std::string> lvm_channels(const Source& source);

// Tables in MATLAB's MAT-files: a vector for each column.

/// Reads the wanted columns: variables (`current`), fields (`run.current`) or columns of a matrix
/// (`data(:,2)`), all of one length, of finite numbers.
Table read_mat_table(const Source& source, std::span<const WantedColumn> wanted, TableProblems& problems);

enum class Format { text, lvm, mat };

/// By its ending, and by how it begins.
Format format_of(const std::string& file, std::string_view text);

}  // namespace mckibben::input
