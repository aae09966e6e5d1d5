// Numbers that carry their slopes along (forward differentiation): value and derivatives by N unknowns. Like
// Eigen's AutoDiffScalar, bit for bit, but evaluated operation by operation:
// what does not pile up types compiles faster.
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace mckibben::engine {

template <int N>
struct Dual {
  using Slopes = Eigen::Matrix<double, N, 1>;

  double value;
  Slopes slopes;

  Dual() = default;
  Dual(double constant) : value(constant), slopes(Slopes::Zero()) {}
  Dual(double v, const Slopes& s) : value(v), slopes(s) {}
  /// The unknown number `index` itself.
  static Dual unknown(double value, int index) { return {value, Slopes::Unit(index)}; }

  Dual operator-() const { return {-value, -slopes}; }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slopes + b.slopes}; }
  friend Dual operator+(const Dual& a, double b) { return {a.value + b, a.slopes}; }
  friend Dual operator+(double a, const Dual& b) { return {a + b.value, b.slopes}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slopes - b.slopes}; }
  friend Dual operator-(const Dual& a, double b) { return {a.value - b, a.slopes}; }
  friend Dual operator-(double a, const Dual& b) { return {a - b.value, -b.slopes}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slopes * b.value + b.slopes * a.value};
  }
  friend Dual operator*(const Dual& a, double b) { return {a.value * b, a.slopes * b}; }
  friend Dual operator*(double a, const Dual& b) { return {b.value * a, b.slopes * a}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    return {a.value / b.value, (a.slopes * b.value - b.slopes * a.value) * (1.0 / (b.value * b.value))};
  }
  friend Dual operator/(const Dual& a, double b) { return {a.value / b, a.slopes * (1.0 / b)}; }
  friend Dual operator/(double a, const Dual& b) {
    return {a / b.value, b.slopes * (-a / (b.value * b.value))};
  }

  // Which way a law branches is a matter of values.
  friend auto operator<=>(const Dual& a, const Dual& b) { return a.value <=> b.value; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }

  friend Dual abs(const Dual& x) { return {std::abs(x.value), x.slopes * (x.value < 0.0 ? -1.0 : 1.0)}; }
  friend Dual sqrt(const Dual& x) {
    const double root = std::sqrt(x.value);
    return {root, x.slopes * (0.5 / root)};
  }
  friend Dual exp(const Dual& x) {
    const double e = std::exp(x.value);
    return {e, x.slopes * e};
  }
  friend Dual log(const Dual& x) { return {std::log(x.value), x.slopes * (1.0 / x.value)}; }
  friend Dual sin(const Dual& x) { return {std::sin(x.value), x.slopes * std::cos(x.value)}; }
  friend Dual cos(const Dual& x) { return {std::cos(x.value), x.slopes * -std::sin(x.value)}; }
  friend Dual acos(const Dual& x) {
    return {std::acos(x.value), x.slopes * (-1.0 / std::sqrt(1.0 - x.value * x.value))};
  }
  friend Dual tanh(const Dual& x) {
    const double cosh = std::cosh(x.value);
    return {std::tanh(x.value), x.slopes * (1.0 / (cosh * cosh))};
  }
  friend Dual pow(const Dual& x, double exponent) {
    return {std::pow(x.value, exponent), x.slopes * (exponent * std::pow(x.value, exponent - 1.0))};
  }
};

}  // namespace mckibben::engine
