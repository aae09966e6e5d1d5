// See the header.
#include <algorithm>
#include <filesystem>
#include <utility>

#include <plant/geometry.hpp>
#include <sim/run/simulate.hpp>
#include <sim/study/evidence.hpp>

namespace mckibben::study {
namespace {

double nearest(const std::vector<double>& values, double wanted) {
  return *std::min_element(values.begin(), values.end(),
                           [&](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); });
}

/// Looks up in a recording what was true in the rows that the calibration used.
class Witness {
 public:
  Witness(const Evidence& evidence, std::size_t run)
      : rig_(evidence.campaign.rig),
        braid_(rig_.muscle),
        valve_(run::knowledge_of(rig_, {}).valve),
        per_count_(run::contraction_per_count(rig_)),
        run_(run),
        load_kg_(evidence.dataset.runs[run].load_kg),
        samples_(evidence.recordings[run].samples) {}

  Row row(std::size_t k, thesis::Direction direction, double speed_mA_per_s) const {
    const run::Sample& now = samples_[k];
    Row row;
    row.run = run_;
    row.row = k;
    row.direction = direction;
    row.load_kg = load_kg_;
    row.speed_mA_per_s = speed_mA_per_s;
    row.slope_mA_per_s = (now.current_mA - samples_[k - 1].current_mA) / rig_.tick_s;
    row.contraction_ratio = (static_cast<double>(now.counts) + 0.5) * per_count_;
    row.line_Pa = valve_.pressure_Pa(now.current_mA);
    row.muscle_Pa = now.state.side.muscle_pressure_Pa;
    row.friction_N = -row.up() * now.friction_force_N;
    row.generated_N_per_Pa = braid_.force_N(row.contraction_ratio, 1.0);
    row.surface_m2 = braid_.contact_surface_m2(row.contraction_ratio);
    row.truly = {now.state.joint.contraction_speed_per_s, acceleration_m_per_s2(now)};
    row.late = differences([&](std::size_t i) { return samples_[i].state.joint.contraction_ratio; }, k);
    row.counted =
        differences([&](std::size_t i) { return static_cast<double>(samples_[i].counts) * per_count_; }, k);
    return row;
  }

 private:
  // The used rows are above e = 0, where the taut threads' stop does nothing.
  double acceleration_m_per_s2(const run::Sample& now) const {
    const plant::Joint& joint = rig_.joint;
    const double v = rig_.muscle.rest_length_m * now.state.joint.contraction_speed_per_s;
    const double hung_kg = load_kg_ + joint.load_offset_kg;
    const double moved_kg =
        hung_kg + joint.wheel_inertia_kg_m2 / (joint.wheel_radius_m * joint.wheel_radius_m);
    return (now.braid_force_N + now.friction_force_N - joint.guide_damping_N_s_per_m * v -
            hung_kg * plant::gravity_m_per_s2 + now.effects_pull_N) /
           moved_kg;
  }

  template <class Ratio>
  Row::Motion differences(const Ratio& ratio, std::size_t k) const {
    const double last = ratio(k) - ratio(k - 1), before = ratio(k - 1) - ratio(k - 2);
    return {last / rig_.tick_s, rig_.muscle.rest_length_m * (last - before) / (rig_.tick_s * rig_.tick_s)};
  }

  const plant::Rig& rig_;
  plant::Braid braid_;
  controllers::ValveLine valve_;
  double per_count_;
  std::size_t run_;
  double load_kg_;
  const std::vector<run::Sample>& samples_;
};

void look_up(Evidence& evidence) {
  const thesis::Grid& grid = evidence.from_current.grid;
  for (std::size_t r = 0; r < evidence.dataset.runs.size(); ++r) {
    const thesis::ProcessedRun processed = thesis::process(evidence.dataset.runs[r], evidence.dataset, {});
    if (!processed.unusable.empty()) continue;
    const Witness witness(evidence, r);
    const double speed = nearest(grid.speeds_mA_per_s, processed.current_speed_mA_per_s);
    for (const thesis::Direction direction : thesis::directions)
      for (const std::size_t k : processed.rows[static_cast<std::size_t>(direction)])
        evidence.rows.push_back(witness.row(k, direction, speed));
  }
}

}  // namespace

Evidence gather(domain::Campaign campaign, unsigned threads, const run::ProgressHook& progress) {
  Evidence evidence;
  campaign.rig.gauge = {.fitted = true, .resolution_Pa = 0.0};
  campaign.noise.gauge_Pa = 0.0;
  evidence.campaign = std::move(campaign);
  const auto jobs = run::jobs_of(evidence.campaign);
  std::vector<run::CampaignRun> runs(jobs.size());
  run::run_jobs(
      evidence.campaign, jobs, threads, [&](const run::CampaignRun& run) { runs[run.job.stream - 1] = run; },
      progress);
  evidence.dataset.rig = evidence.campaign.rig;
  const auto& files = evidence.campaign.inputs;
  evidence.dataset.path = files.empty() ? evidence.campaign.name : files.front().name;
  evidence.dataset.inputs = evidence.campaign.inputs;
  for (run::CampaignRun& run : runs) {
    if (!run.failure.empty()) {
      evidence.failed.push_back(run.job.id);
      continue;
    }
    evidence.dataset.runs.push_back(run::measured(evidence.campaign, run));
    evidence.recordings.push_back(std::move(run.recording));
  }
  thesis::Options current;
  current.orders_can_be_asked = false;  // a study has no such options
  thesis::Options gauge = current;
  gauge.processing.pressure = thesis::PressureSource::gauge;
  evidence.from_current = thesis::calibrate(evidence.dataset, current);
  evidence.from_gauge = thesis::calibrate(evidence.dataset, gauge);
  look_up(evidence);
  return evidence;
}

Row look_at(const Evidence& evidence, std::size_t run, std::size_t row, thesis::Direction direction,
            double speed_mA_per_s) {
  return Witness(evidence, run).row(row, direction, speed_mA_per_s);
}

std::vector<double> shown_speeds(const thesis::Grid& grid) {
  std::vector<double> shown;
  for (const double wanted : {5.6, 6.7, 8.3, 11.1, 16.7}) {
    const double speed = nearest(grid.speeds_mA_per_s, wanted);
    if (shown.empty() || shown.back() != speed) shown.push_back(speed);
  }
  return shown;
}

}  // namespace mckibben::study
