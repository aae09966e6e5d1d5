// Both branches solved for the current's speed nu. With s the slope of the valve's line, pressure follows the
// current at dP/dt = s nu while contracting and -s nu while relaxing.
#include <algorithm>
#include <cmath>

#include <controllers/inverse.hpp>

namespace mckibben::controllers {
namespace {

constexpr double lowest_logarithm_ratio = 1e-3;  // ln e: even an extrapolation ends here

}  // namespace

Inverse::Inverse(const Calibration& calibration, double load_kg, const ValveLine& valve, bool extrapolate)
    : range_(calibration.range), extrapolate_(extrapolate), slope_Pa_per_mA_(valve.slope_Pa_per_mA()) {
  const ContractionModel& up = calibration.contraction;
  const RelaxationModel& down = calibration.relaxation;
  const auto value = [load_kg](const InLoad& polynomial) { return at_load(polynomial, load_kg); };
  a0_ = value(up.a0);
  a1_0_ = value(up.a1_0);
  a1_1_ = value(up.a1_1);
  a2_0_ = value(up.a2_0);
  a2_1_ = value(up.a2_1);
  a3_ = value(up.a3);
  a4_ = value(up.a4);
  b0_0_ = value(down.b0_0);
  b0_1_ = value(down.b0_1);
  b1_ = value(down.b1);
  b2_ = value(down.b2);
  b3_ = value(down.b3);
  b4_0_ = value(down.b4_0);
  b4_1_ = value(down.b4_1);
  b4_2_ = value(down.b4_2);
}

double Inverse::pressure_Pa(Branch branch, double e, double nu) const {
  if (branch == Branch::contraction)
    return a0_ + (a1_0_ * nu + a1_1_) * e + (a2_0_ * nu + a2_1_) * std::exp(a3_ * e) + a4_ * std::log(e);
  return b0_0_ * nu + b0_1_ + b1_ * e + b2_ * std::exp(b3_ * e) +
         (b4_0_ * nu * nu + b4_1_ * nu + b4_2_) * std::log(e);
}

Answer Inverse::operator()(Branch branch, double contraction_ratio, double contraction_speed_per_s) const {
  Answer answer;
  const double inside = std::clamp(contraction_ratio, range_.lowest_ratio, range_.highest_ratio);
  answer.ratio_outside = inside != contraction_ratio;
  const double e = std::max(extrapolate_ ? contraction_ratio : inside, lowest_logarithm_ratio);

  const Speed found = branch == Branch::contraction ? contraction_speed(e, contraction_speed_per_s)
                                                    : relaxation_speed(e, contraction_speed_per_s);
  answer.unreachable = found.unreachable;
  // Faster than any current: the fastest current that was ever tried is the best that is known.
  const double nu = found.unreachable ? range_.highest_speed_mA_per_s : std::max(found.mA_per_s, 0.0);
  const double tried = std::clamp(nu, range_.lowest_speed_mA_per_s, range_.highest_speed_mA_per_s);
  answer.speed_outside = tried != found.mA_per_s || found.unreachable;
  answer.current_speed_mA_per_s = extrapolate_ ? nu : tried;
  answer.pressure_Pa = pressure_Pa(branch, e, answer.current_speed_mA_per_s);
  return answer;
}

// T 4.38 with dP/dt = s nu is linear: s nu = (A nu + B) w, so nu = B w / (s - A w). A w = s is a pole: there
// the pressure that nu adds by itself rises as fast as the line can follow, and beyond it no nu is enough.
Inverse::Speed Inverse::contraction_speed(double e, double w_per_s) const {
  const double exponential = a3_ * std::exp(a3_ * e);
  const double A = a1_0_ + a2_0_ * exponential;
  const double B = a1_1_ + a2_1_ * exponential + a4_ / e;
  const double left = slope_Pa_per_mA_ - A * w_per_s;
  if (left <= 0.0) return {0.0, true};
  return {B * w_per_s / left, false};
}

// T 4.45 with dP/dt = -s nu: q2 nu^2 + q1 nu + q0 = 0 with q2 = b4_0 w/e, q1 = b4_1 w/e + s, q0 = B w.
//
// The physical root is the one that leads to rest: as w goes to 0, q2 and q0 vanish and q1 goes to s, so one
// root goes to -q0/s, that is to 0, and the other to infinity. A load that is to stand still needs a current
// that stands still, so the first is meant, and it is the same root as long as w grows without the two
// meeting: nu = -2 q0 / (q1 + sqrt(q1^2 - 4 q2 q0)), the form that stays exact as q2 vanishes (b4_0 = 0).
// With roots of unlike sign it is the positive one, with two positive roots the smaller. Where they have met
// (no real root), or run through infinity (denominator not positive), no current speed gives that w.
Inverse::Speed Inverse::relaxation_speed(double e, double w_per_s) const {
  const double q2 = b4_0_ * w_per_s / e;
  const double q1 = b4_1_ * w_per_s / e + slope_Pa_per_mA_;
  const double q0 = (b1_ + b2_ * b3_ * std::exp(b3_ * e) + b4_2_ / e) * w_per_s;
  const double discriminant = q1 * q1 - 4.0 * q2 * q0;
  if (discriminant < 0.0) return {0.0, true};
  const double denominator = q1 + std::sqrt(discriminant);
  if (denominator <= 0.0) return {0.0, true};
  return {-2.0 * q0 / denominator, false};
}

}  // namespace mckibben::controllers
