// Linear systems as courses on control have them, in time or from one sample to the next:
//
//   dx/dt = A x + B u   or   x(k+1) = A x(k) + B u(k);   y = C x + D u
#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

namespace mckibben::linear {

using Matrix = Eigen::MatrixXd;
using Complex = std::complex<double>;

struct System {
  Matrix A, B, C, D;
  double step_s = 0.0;  ///< from one sample to the next; 0: in time

  Eigen::Index states() const { return A.rows(); }
};

/// Sorted by size, then by imaginary part.
std::vector<Complex> poles(const System& system);
/// Of one input and one output with D = 0: what may move while the output stays at 0.
std::vector<Complex> zeros(const System& system);

/// Of one input and one output, at a frequency [rad/s].
Complex response(const System& system, double rad_per_s);
/// The same at s = 1e-7 1/s, which is nearer to rest than anything a rig remembers.
double gain_at_rest(const System& system);

/// What a computer sees that samples the output each `step_s` and holds its input in between, which acts
/// `delay_s` late (Franklin, Powell, Workman, Digital Control 1998, section 4.3). D must be 0.
System sampled(const System& system, double step_s, double delay_s = 0.0);

/// A system in samples as it is seen each `times` samples, its input held in between; D must be 0.
System held(const System& system, int times);

/// `then` on what `first` puts out.
System in_series(const System& first, const System& then);
/// Its output, with the sign changed, added to its input.
System closed(const System& loop);
/// Whether nothing grows.
bool is_stable(const System& system);

/// u = -K x that keeps the sum of y'y + u'u least (discrete algebraic Riccati equation, by doubling: Chu,
/// Fan, Lin, Int. J. Control 77 (2004) 767-788). Only of systems in samples.
Matrix least_squares_feedback(const System& system);

}  // namespace mckibben::linear
