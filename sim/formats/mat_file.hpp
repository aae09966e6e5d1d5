// MATLAB's MAT-files of level 5 (what `save -v6` and `save -v7` write).
#pragma once

#include <string>
#include <vector>

#include <sim/formats/table.hpp>

namespace mckibben::formats {

/// What was found of a vector that was asked for.
struct Found {
  std::vector<double> values;
  std::string problem;  ///< why there are none; empty if it was found
};

struct MatContents {
  std::vector<std::string> names;  ///< every vector or matrix of real numbers: `current`, `run.current`
  /// Every vector, and every column of a matrix: by which it is asked for, and how the file calls it besides.
  struct Vector {
    std::string name, label;
  };
  std::vector<Vector> vectors;
  std::vector<std::string> objects{};  ///< what is in it that cannot be read, and what to do

  void add(const std::string& name, const std::string& label, std::size_t rows, std::size_t columns);
  std::vector<Found> found;  ///< one for each that was asked for
};

/// Looks for vectors in the bytes of a MAT-file: a variable (`current`), a field of a struct (`run.current`),
/// one of several structs (`scope.signals(2).values`), a column of a matrix (`data(:,2)`). Throws BadFile:
/// not a MAT-file, of another version, damaged.
MatContents read_mat(const std::string& bytes, const std::vector<std::string>& wanted);

/// A MAT-file with a vector for each column, `units` and `descriptions` (structs with a text for each), and a
/// variable for the title and each attribute. The same table gives the same bytes. Safe to call from several
/// threads. Throws BadFile.
std::string mat_of(const Table& table);

}  // namespace mckibben::formats
