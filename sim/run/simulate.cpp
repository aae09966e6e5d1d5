// What drives a ride tick by tick: a controller, through the instruments, with noise.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include <sim/engine/failure.hpp>
#include <sim/ride/ride.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

/// Draws the noise of one run: the same for the same seed and stream, whatever runs beside it.
class Disturbance {
 public:
  Disturbance(const plant::Noise& noise, double tick_s, std::uint64_t seed, std::uint64_t stream)
      : noise_(noise), kept_(std::exp(-tick_s / noise.wander_time_s)) {
    std::seed_seq sequence{seed & 0xffffffffu, seed >> 32, stream & 0xffffffffu, stream >> 32};
    random_.seed(sequence);
    if (noise_.ripple_Pa > 0.0) phase_ = std::uniform_real_distribution(0.0, 2.0 * std::numbers::pi)(random_);
    if (noise_.wander_Pa > 0.0) wander_ = draw();
  }
  double jitter() { return noise_.encoder_jitter * draw(); }
  double gauge_Pa() { return noise_.gauge_Pa * draw(); }
  double current_mA() { return noise_.current_mA * draw(); }
  /// Of the reference pressure; to be asked once a tick.
  double reference_Pa(double time_s) {
    double sum_Pa = 0.0;
    if (noise_.ripple_Pa > 0.0)
      sum_Pa +=
          noise_.ripple_Pa * std::sin(2.0 * std::numbers::pi * time_s / noise_.ripple_period_s + phase_);
    if (noise_.wander_Pa > 0.0) {
      sum_Pa += noise_.wander_Pa * wander_;
      wander_ = kept_ * wander_ + std::sqrt(1.0 - kept_ * kept_) * draw();  // exact over a tick
    }
    return sum_Pa;
  }

 private:
  double draw() { return normal_(random_); }

  plant::Noise noise_;
  double kept_, phase_ = 0.0, wander_ = 0.0;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

class Run {
 public:
  Run(const RunPlan& plan, controllers::Controller& controller)
      : plan_(plan),
        controller_(controller),
        ride_(ride::Hanging{plan.rig, plan.load_kg}, plan.engine, plan.keep_ledger),
        counter_(plan.rig.encoder.wiring, plant::count_height_m(plan.rig.encoder, plan.rig.joint)),
        disturbance_(plan.noise, plan.rig.tick_s, plan.seed, plan.stream) {}

  Recording operator()() {
    if (plan_.load_kg + plan_.rig.joint.load_offset_kg <= 0.0) {
      recording_.failure = "load and load_offset of the rig leave no load";
      return std::move(recording_);
    }
    recording_.samples.reserve(plan_.ticks);
    try {
      settle();
      prepare();
      for (std::size_t k = 0; k < plan_.ticks; ++k) {
        recording_.samples.push_back(tick(static_cast<std::int64_t>(k)));
        recording_.largest_contraction_ratio =
            std::max(recording_.largest_contraction_ratio, ride_.flow().state.joint.contraction_ratio);
        if (k + 1 < plan_.ticks) ride_.advance();
      }
    } catch (const engine::NumericalFailure& failure) {
      recording_.failure = failure.what();
    } catch (const controllers::ControllerFailure& failure) {
      recording_.failure = failure.what();
    }
    const engine::Flow& end = ride_.flow();
    recording_.ledger = end.ledger;
    if (plan_.keep_ledger && !recording_.samples.empty())
      recording_.imbalance = ride_.plant().imbalance(recording_.samples.front().state, end.state, end.ledger);
    recording_.solver = ride_.counters();
    if (recording_.solver.stiff_from_tick >= 0)
      recording_.solver.stiff_from_tick -= settling_ticks() + controller_.preparation_ticks();
    recording_.findings = controller_.findings();
    return std::move(recording_);
  }

 private:
  void settle() {
    const std::int64_t end = -controller_.preparation_ticks(), begin = end - settling_ticks();
    ask(controller_.rest().current_mA);
    ride_.start(drive_, time_s(begin));
    for (std::int64_t k = begin; k < end; ++k) {
      drive_.stray_pressure_Pa = disturbance_.reference_Pa(time_s(k));
      ride_.step(drive_, time_s(k + 1));
      counts();
    }
  }

  // The ticks that a controller needs to find out about its load.
  void prepare() {
    for (std::int64_t k = -controller_.preparation_ticks(); k < 0; ++k) {
      tick(k);
      ride_.advance();
    }
    ride_.open_ledger();
  }

  Sample tick(std::int64_t k) {
    const std::int64_t read = counts();
    ask(controller_.step({k, time_s(k), read}).current_mA);
    drive_.stray_pressure_Pa = disturbance_.reference_Pa(time_s(k));
    ride_.hold(drive_, time_s(k + 1));
    const auto now = ride_.moment();
    const double gauge_Pa = ride_.reading().muscle_pressure_Pa + disturbance_.gauge_Pa();
    return {time_s(k),
            drive_.current_mA,
            ride_.flow().state,
            read,
            plant::gauge_reading_Pa(plan_.rig.gauge, gauge_Pa),
            now.braid_force_N,
            now.friction_force_N,
            now.effects_pull_N};
  }

  std::int64_t counts() {
    const double jitter_m = disturbance_.jitter() * plan_.rig.muscle.rest_length_m;
    return counter_.count(ride_.reading().wheel_m + jitter_m);
  }

  void ask(double wanted_mA) {
    drive_.current_mA =
        controller_.already_quantised() ? wanted_mA : plant::dac_output_mA(plan_.rig.dac, wanted_mA);
    drive_.stray_current_mA = disturbance_.current_mA();
  }

  double time_s(std::int64_t k) const { return static_cast<double>(k) * plan_.rig.tick_s; }
  long settling_ticks() const { return std::lround(plan_.rig.settling_time_s / plan_.rig.tick_s); }

  const RunPlan& plan_;
  controllers::Controller& controller_;
  ride::Ride ride_;
  ride::Drive drive_;
  plant::PulseCounter counter_;
  Disturbance disturbance_;
  Recording recording_;
};

}  // namespace

Recording simulate(const RunPlan& plan, controllers::Controller& controller) {
  return Run(plan, controller)();
}

double contraction_per_count(const plant::Rig& rig) {
  return plant::count_height_m(rig.encoder, rig.joint) / rig.muscle.rest_length_m;
}

controllers::Knowledge knowledge_of(const plant::Rig& rig, std::vector<double> target) {
  return {.contraction_per_count = contraction_per_count(rig),
          .tick_s = rig.tick_s,
          .largest_current_mA = rig.dac.largest_current_mA,
          .target = std::move(target),
          .model = {rig.muscle.rest_radius_m, rig.muscle.rest_length_m, rig.muscle.braid_angle_rad,
                    rig.muscle.end_correction, rig.muscle.contact_surface == plant::ContactSurface::printed},
          .valve = {rig.valve.zero_current_mA, rig.valve.span_current_mA, rig.valve.zero_pressure_Pa,
                    rig.valve.span_pressure_Pa},
          .reach = {}};
}

}  // namespace mckibben::run
