// Axes of all pictures: scales from values to pixels, round numbers on them, grid, frame and words. Inks are
// attributes, which a style may overrule by class: `grid`, `axis` (the frame);
// a page does, and where it is dark.
#pragma once

#include <string>
#include <vector>

namespace mckibben::output {

/// A step of 1, 2 or 5 times a power of ten that divides a span into about `parts`.
double tick_step(double span, int parts);

/// Which values lie between which pixels: linear; or, with a floor, linear within it and logarithmic beyond.
struct Scale {
  double from_px, to_px;  ///< of the lowest and the highest value
  double floor = 0.0;
  double low = 1e300, high = -1e300;

  /// Makes room for a value; for none if it is not finite.
  void hold(double value);
  /// Adds a margin on both sides, `least` or more; 0 to 1 where nothing is held.
  void widen(double least = 0.0);
  double px(double value) const;
};

/// A number on an axis, and where it stands.
struct Tick {
  double px;
  std::string text;
};

/// About `parts` round numbers, of a unit of which a value of 1 has `factor`.
/// With a floor: 0 and powers of ten.
std::vector<Tick> round_numbers(const Scale& scale, int parts, double factor = 1.0);

/// A line of a logarithmic axis; only at powers of ten stands a number.
struct Decade {
  double value;
  bool is_power;
};

/// 1, 2 and 5 times each power of ten, from the first power that is not below `low` up to `high`.
std::vector<Decade> decades(double low, double high);

/// An area with two axes; `y` has its lowest value at the lower edge.
struct Panel {
  Scale x, y;
  double words_px = 42.0;  ///< from the left edge to the words of the upward axis
  bool with_grid = true;

  /// The horizontal axis, below: grid, numbers and words.
  std::string across(const std::vector<Tick>& ticks, const std::string& words) const;
  /// The vertical one, on the left.
  std::string upwards(const std::vector<Tick>& ticks, const std::string& words) const;
  std::string frame() const;
  /// Words above the upper left corner.
  std::string heading(const std::string& words) const;
};

}  // namespace mckibben::output
