// What the studies look at: a campaign simulated in memory, what its instruments measured, what truly
// happened, and the thesis's calibration of it with the pressure from the current and from a true gauge. Only
// the data set is given to the calibrations.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <sim/domain/campaign.hpp>
#include <sim/run/campaign.hpp>
#include <sim/thesis/calibrate.hpp>

namespace mckibben::study {

/// One row that the calibration used, as measured and as it was.
struct Row {
  std::size_t run = 0;  ///< place in the data set
  std::size_t row = 0;  ///< of that run's table
  thesis::Direction direction = thesis::Direction::contraction;
  double load_kg = 0.0;
  double speed_mA_per_s = 0.0;            ///< of the run, as the calibration groups them
  double slope_mA_per_s = 0.0;            ///< of the current at this row, signed
  double contraction_ratio = 0.0;         ///< counted
  double line_Pa = 0.0, muscle_Pa = 0.0;  ///< pressure from the current (T 3.3); the muscle's own
  double friction_N = 0.0;                ///< true, positive against the motion
  double generated_N_per_Pa = 0.0;        ///< T 2.8 for one pascal
  double surface_m2 = 0.0;                ///< T 4.3
  struct Motion {
    double speed_per_s = 0.0, acceleration_m_per_s2 = 0.0;
  } truly,      ///< at this instant
      late,     ///< differences of the true position over the last tick and the last two
      counted;  ///< the same of counts (T 3.3)

  double up() const { return direction == thesis::Direction::contraction ? 1.0 : -1.0; }
};

struct Evidence {
  domain::Campaign campaign;  ///< its rig has a gauge without noise
  domain::Dataset dataset;
  std::vector<run::Recording> recordings;  ///< in the order of the data set's runs
  std::vector<std::string> failed;         ///< runs that the integrator gave up
  thesis::CalibrationResult from_current, from_gauge;
  std::vector<Row> rows;
};

/// Simulates the campaign on `threads` threads (0: all the machine has) and calibrates. Throws
/// run::Interrupted; domain::UnfitData if the data cannot be calibrated.
Evidence gather(domain::Campaign campaign, unsigned threads, const run::ProgressHook& progress);

/// Mean, spread and root mean square of what is added.
class Tally {
 public:
  void add(double value) {
    sum_ += value;
    squares_ += value * value;
    ++count_;
  }
  std::size_t count() const { return count_; }
  double mean() const { return sum_ / static_cast<double>(count_); }
  double rms() const { return std::sqrt(squares_ / static_cast<double>(count_)); }
  double deviation() const { return std::sqrt(std::max(0.0, rms() * rms() - mean() * mean())); }

 private:
  double sum_ = 0.0, squares_ = 0.0;
  std::size_t count_ = 0;
};

/// Any row of a run but its first two; `direction` and `speed_mA_per_s` are as given.
Row look_at(const Evidence& evidence, std::size_t run, std::size_t row, thesis::Direction direction,
            double speed_mA_per_s);

/// Those of the thesis's five current speeds (figures 4.20 to 4.25) that the campaign comes nearest to.
std::vector<double> shown_speeds(const thesis::Grid& grid);

/// T 4.31: load from a row's generated force, friction force and acceleration.
inline double weighed_kg(double generated_N, double friction_N, double acceleration_m_per_s2) {
  return (generated_N - friction_N) / (acceleration_m_per_s2 + plant::gravity_m_per_s2);
}

}  // namespace mckibben::study
