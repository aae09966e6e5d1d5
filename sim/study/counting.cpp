// Measuring: what was counted against what was true, row by row.
#include <sim/run/simulate.hpp>
#include <sim/study/counting.hpp>

namespace mckibben::study {
namespace {

void add(Counted& sums, double counted, double late, double truly) {
  sums.truly.add(truly);
  sums.error.add(counted - truly);
  sums.rounding.add(counted - late);
  sums.lateness.add(late - truly);
}

/// Adds up the errors of a run's rows, and in the end that of their mean.
class Weigher {
 public:
  explicit Weigher(Weighings& into) : into_(into) {}

  void add(const Row& row, double generated_N, double friction_N) {
    if (row.run != run_) end();
    run_ = row.run;
    const std::array<double, accelerations.size()> given{row.counted.acceleration_m_per_s2, 0.0,
                                                         row.truly.acceleration_m_per_s2};
    for (std::size_t i = 0; i < given.size(); ++i) {
      const double error_kg = weighed_kg(generated_N, friction_N, given[i]) - row.load_kg;
      into_.by_load[row.load_kg][i].add(error_kg);
      into_.by_speed[row.speed_mA_per_s][i].add(error_kg);
      into_.all[i].add(error_kg);
      of_run_[i].add(error_kg);
    }
  }
  void end() {
    if (of_run_.front().count() > 0)
      for (std::size_t i = 0; i < of_run_.size(); ++i) into_.runs[i].add(of_run_[i].mean());
    of_run_ = {};
  }

 private:
  Weighings& into_;
  std::size_t run_ = 0;
  Errors of_run_;
};

}  // namespace

Counting measure_counting(const Evidence& evidence) {
  Counting result;
  const plant::Rig& rig = evidence.campaign.rig;
  result.speed_step_per_s = run::contraction_per_count(rig) / rig.tick_s;
  result.acceleration_step_per_s2 = result.speed_step_per_s / rig.tick_s;
  result.acceleration_step_m_per_s2 = result.acceleration_step_per_s2 * rig.muscle.rest_length_m;
  const auto& model = evidence.from_current.calibration.contraction_friction;
  Weigher alone(result.alone), thesiss(result.thesiss);
  for (const Row& row : evidence.rows) {
    for (Counted* sums : {&result.speed_per_s[row.speed_mA_per_s], &result.all_speed_per_s})
      add(*sums, row.counted.speed_per_s, row.late.speed_per_s, row.truly.speed_per_s);
    for (Counted* sums :
         {&result.acceleration_m_per_s2[row.speed_mA_per_s], &result.all_acceleration_m_per_s2})
      add(*sums, row.counted.acceleration_m_per_s2, row.late.acceleration_m_per_s2,
          row.truly.acceleration_m_per_s2);
    if (row.direction != thesis::Direction::contraction) continue;
    alone.add(row, row.generated_N_per_Pa * row.muscle_Pa, row.friction_N);
    thesiss.add(row, row.generated_N_per_Pa * row.line_Pa,
                model.coefficient(row.contraction_ratio, row.speed_mA_per_s) * row.surface_m2 * row.line_Pa);
  }
  alone.end();
  thesiss.end();
  return result;
}

}  // namespace mckibben::study
