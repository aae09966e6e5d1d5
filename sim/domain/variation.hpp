// What a campaign draws anew for each repeat: numbers of the rig, each by a law of its own.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mckibben::domain {

enum class DrawLaw { normal, uniform };
constexpr auto names(DrawLaw) {
  using enum DrawLaw;
  return std::array{std::pair{normal, std::string_view{"normal"}},
                    std::pair{uniform, std::string_view{"uniform"}}};
}

/// How draws are spread: each by chance, or one in each of as many equally likely intervals as there are
/// repeats (McKay, Beckman & Conover 1979).
enum class Sampling { random, latin_hypercube };
constexpr auto names(Sampling) {
  using enum Sampling;
  return std::array{std::pair{random, std::string_view{"random"}},
                    std::pair{latin_hypercube, std::string_view{"latin_hypercube"}}};
}

/// A normal law is cut at so many deviations to either side.
inline constexpr double most_deviations = 4.0;

struct Varied {
  std::string path;  ///< keys of a rig file: muscle.rest_radius
  std::string unit;  ///< SI, of the numbers below
  DrawLaw law = DrawLaw::normal;
  double middle = 0.0, deviation = 0.0;  ///< normal
  double low = 0.0, high = 0.0;          ///< all that can be drawn

  /// From low to high; for a normal law those at which it is cut.
  static Varied normal(double middle, double deviation) {
    return {"",
            "",
            DrawLaw::normal,
            middle,
            deviation,
            middle - most_deviations * deviation,
            middle + most_deviations * deviation};
  }
  static Varied uniform(double low, double high) {
    return {"", "", DrawLaw::uniform, 0.5 * (low + high), 0.0, low, high};
  }
};

struct Variation {
  std::vector<Varied> numbers;
  Sampling sampling = Sampling::random;

  bool absent() const { return numbers.empty(); }
};

}  // namespace mckibben::domain
