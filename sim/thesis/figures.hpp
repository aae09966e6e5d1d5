// The thesis's figures 4.2 to 4.49 as tables, and how each is drawn.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

#include <sim/thesis/calibrate.hpp>

namespace mckibben::thesis {

struct Column {
  std::string name;  ///< with its unit
  std::vector<double> values;
};

/// One curve of a figure: two columns, or some of their rows.
struct Curved {
  std::string label;
  std::size_t x = 0, y = 0;  ///< columns
  bool dots = false;         ///< otherwise a line
  std::size_t begin = 0, end = static_cast<std::size_t>(-1);
};

struct Figure {
  std::string number;  ///< "4.2"; empty for a picture that is not the thesis's
  std::string title, x_label, y_label;
  std::vector<Column> columns{};  ///< all of one length
  std::vector<Curved> curves{};

  /// figure_4_02
  std::string file_name() const;
  /// One value more for each column.
  void add_row(std::initializer_list<double> values);
};

/// All of them, in order. Pressures in Pa, or in kgf/m2 as the thesis prints them. Of clouds of samples every
/// n-th is kept, so that no figure has more than `most_dots`.
std::vector<Figure> figures(const CalibrationResult& result, bool kgf);

inline constexpr std::size_t most_dots = 1500;
inline constexpr double kgf_per_m2_Pa = plant::gravity_m_per_s2;

}  // namespace mckibben::thesis
