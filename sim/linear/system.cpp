// Eigenvalues, exponentials and one Riccati equation; see the header.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <sim/linear/system.hpp>

#include <unsupported/Eigen/MatrixFunctions>

namespace mckibben::linear {
namespace {

constexpr double rounding = 1e-12;

/// Those that the arithmetic does not resolve beside the system's largest pole are 0.
std::vector<Complex> sorted(std::vector<Complex> values, double largest) {
  for (Complex& value : values)
    if (std::abs(value) <= rounding * largest) value = 0.0;
  std::sort(values.begin(), values.end(), [](const Complex& a, const Complex& b) {
    const double one = std::abs(a), two = std::abs(b);
    if (std::abs(one - two) > 1e-9 * (one + two)) return one < two;
    return std::tuple(a.real(), a.imag()) < std::tuple(b.real(), b.imag());
  });
  return values;
}

Complex at(const System& system, const Complex& s) {
  const Eigen::MatrixXcd left = s * Eigen::MatrixXcd::Identity(system.states(), system.states()) - system.A;
  const Eigen::VectorXcd state = left.partialPivLu().solve(system.B.cast<Complex>().col(0));
  return (system.C.cast<Complex>().row(0) * state)(0) + system.D(0, 0);
}

/// State after `time_s`, and what an input that is held from its beginning adds.
struct Flown {
  Matrix state, input;
};
Flown flown(const System& system, double time_s) {
  const Eigen::Index n = system.states(), m = system.B.cols();
  Matrix both = Matrix::Zero(n + m, n + m);
  both.topLeftCorner(n, n) = system.A * time_s;
  both.topRightCorner(n, m) = system.B * time_s;
  const Matrix power = both.exp();
  return {power.topLeftCorner(n, n), power.topRightCorner(n, m)};
}

}  // namespace

std::vector<Complex> poles(const System& system) {
  const Eigen::VectorXcd values = system.A.eigenvalues();
  return sorted({values.begin(), values.end()}, values.cwiseAbs().maxCoeff());
}

// Inputs that keep the output at 0 also keep its first r - 1 derivatives there, which have no input in them.
// What moves then moves in the kernel of all of these.
std::vector<Complex> zeros(const System& system) {
  const Eigen::Index n = system.states();
  const Eigen::VectorXd input = system.B.col(0);
  Matrix still(n, n);
  Eigen::RowVectorXd row = system.C.row(0);
  for (Eigen::Index r = 1; r <= n && row.norm() > 0.0; ++r, row = (row * system.A).eval()) {
    still.col(r - 1) = row.transpose().normalized();
    const double direct = row.dot(input);
    if (std::abs(direct) <= rounding * row.norm() * input.norm()) continue;
    const Matrix held = system.A - input * (row * system.A) / direct;
    const Matrix turned = still.leftCols(r).householderQr().householderQ();
    const Matrix kernel = turned.rightCols(n - r);
    if (n == r) return {};
    const Eigen::VectorXcd values = (kernel.transpose() * held * kernel).eval().eigenvalues();
    return sorted({values.begin(), values.end()}, system.A.eigenvalues().cwiseAbs().maxCoeff());
  }
  return {};
}

Complex response(const System& system, double rad_per_s) {
  const Complex turn(0.0, rad_per_s);
  return at(system, system.step_s > 0.0 ? std::exp(turn * system.step_s) : turn);
}

double gain_at_rest(const System& system) {
  constexpr double slow_per_s = 1e-7;
  return at(system, system.step_s > 0.0 ? std::exp(slow_per_s * system.step_s) : slow_per_s).real();
}

System sampled(const System& system, double step_s, double delay_s) {
  if (!system.D.isZero(0.0)) throw std::invalid_argument("sampled: the input reaches the output at once");
  const Eigen::Index n = system.states(), m = system.B.cols();
  const double whole = std::floor(delay_s / step_s + 1e-9), rest_s = std::max(delay_s - whole * step_s, 0.0);
  const bool split = rest_s > 1e-9 * step_s;
  const auto late = static_cast<Eigen::Index>(whole), inputs = late + (split ? 1 : 0);
  const Flown first = flown(system, step_s - (split ? rest_s : 0.0)), second = flown(system, rest_s);
  System result{Matrix::Zero(n + inputs * m, n + inputs * m), Matrix::Zero(n + inputs * m, m),
                Matrix::Zero(system.C.rows(), n + inputs * m), system.D, step_s};
  const auto past = [&](Eigen::Index ago) { return n + (ago - 1) * m; };  // column of u(k - ago)
  result.A.topLeftCorner(n, n) = first.state * second.state;
  if (late > 0)
    result.A.block(0, past(late), n, m) = first.input;
  else
    result.B.topRows(n) = first.input;
  if (split) result.A.block(0, past(late + 1), n, m) = first.state * second.input;
  if (inputs > 0) result.B.middleRows(n, m).setIdentity();
  for (Eigen::Index ago = 2; ago <= inputs; ++ago)
    result.A.block(past(ago), past(ago - 1), m, m).setIdentity();
  result.C.leftCols(n) = system.C;
  return result;
}

System held(const System& system, int times) {
  System result = system;
  for (int i = 1; i < times; ++i) {
    result.B = (system.A * result.B + system.B).eval();
    result.A = (system.A * result.A).eval();
  }
  result.step_s *= times;
  return result;
}

System in_series(const System& first, const System& then) {
  const Eigen::Index n = first.states(), m = then.states();
  System result{Matrix::Zero(n + m, n + m), Matrix(n + m, first.B.cols()), Matrix(then.C.rows(), n + m),
                then.D * first.D, std::max(first.step_s, then.step_s)};
  result.A.topLeftCorner(n, n) = first.A;
  result.A.bottomLeftCorner(m, n) = then.B * first.C;
  result.A.bottomRightCorner(m, m) = then.A;
  result.B << first.B, then.B * first.D;
  result.C << then.D * first.C, then.C;
  return result;
}

System closed(const System& loop) {
  const Matrix back = (Matrix::Identity(loop.D.rows(), loop.D.rows()) + loop.D).inverse();
  return {loop.A - loop.B * back * loop.C, loop.B * back, back * loop.C, back * loop.D, loop.step_s};
}

bool is_stable(const System& system) {
  constexpr double rounding = 1e-9;  // of what stays where it is: a memory that nothing reaches
  const auto all = poles(system);
  return std::all_of(all.begin(), all.end(), [&](const Complex& pole) {
    return system.step_s > 0.0 ? std::abs(pole) < 1.0 + rounding : pole.real() < rounding;
  });
}

Matrix least_squares_feedback(const System& system) {
  const Matrix unit = Matrix::Identity(system.states(), system.states());
  Matrix A = system.A, G = system.B * system.B.transpose(), H = system.C.transpose() * system.C;
  for (int doubling = 0; doubling < 60; ++doubling) {
    const Matrix halfway = (unit + G * H).inverse(), half_A = halfway * A;
    const Matrix more = A.transpose() * H * half_A;
    G += A * halfway * G * A.transpose();
    H += more;
    A = A * half_A;
    if (more.norm() <= 1e-13 * H.norm()) break;
  }
  const Matrix weight =
      Matrix::Identity(system.B.cols(), system.B.cols()) + system.B.transpose() * H * system.B;
  return weight.inverse() * system.B.transpose() * H * system.A;
}

}  // namespace mckibben::linear
