// The tick loop; see the header for the order of things within a tick.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include <plant/plant.hpp>
#include <sim/engine/failure.hpp>
#include <sim/engine/integrator.hpp>
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
        plant_(plan.rig, plan.load_kg),
        integrator_(engine::make_integrator(plant_, plan.engine, plan.keep_ledger)),
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
            std::max(recording_.largest_contraction_ratio, flow_.state.joint.contraction_ratio);
        if (k + 1 < plan_.ticks) integrate(static_cast<std::int64_t>(k));
      }
    } catch (const engine::NumericalFailure& failure) {
      recording_.failure = failure.what();
    } catch (const controllers::ControllerFailure& failure) {
      recording_.failure = failure.what();
    }
    recording_.ledger = flow_.ledger;
    if (plan_.keep_ledger && !recording_.samples.empty())
      recording_.imbalance = plant_.imbalance(recording_.samples.front().state, flow_.state, flow_.ledger);
    recording_.solver = integrator_->counters();
    if (recording_.solver.stiff_from_tick >= 0)
      recording_.solver.stiff_from_tick -= settling_ticks() + controller_.preparation_ticks();
    recording_.findings = controller_.findings();
    return std::move(recording_);
  }

 private:
  void settle() {
    plant_.rig().effects.wheel_m(0.0, plays_);
    hold(controller_.rest().current_mA);
    held_.reference_pressure_Pa = reference_Pa_;
    held_.current_speed_mA_per_s = 0.0;
    flow_.state = plant_.at_rest(held_);
    flow_.ledger = plant_.opened(flow_.state);
    if (plant_.has_events()) held_.slip = plant_.slip_from_rest(flow_.state, flow_.memory, held_);
    const std::int64_t end = -controller_.preparation_ticks();
    for (std::int64_t k = end - settling_ticks(); k < end; ++k) {
      disturb(k);
      integrate(k);
      counts();
    }
  }

  // The ticks that a controller needs to find out about its load.
  void prepare() {
    for (std::int64_t k = -controller_.preparation_ticks(); k < 0; ++k) {
      tick(k);
      integrate(k);
    }
    flow_.ledger = plant_.opened(flow_.state);
  }

  Sample tick(std::int64_t k) {
    const double time_s = static_cast<double>(k) * plan_.rig.tick_s;
    const std::int64_t read = counts();
    const double before_mA = current_mA_;
    hold(controller_.step({k, time_s, read}).current_mA);
    disturb(k);
    held_.current_speed_mA_per_s = (current_mA_ - before_mA) / plan_.rig.tick_s;
    // The level may have jumped with the current's speed (T 4.6): a load that stuck may be free now.
    if (plant_.has_events() && held_.slip == plant::Slip::sticking)
      held_.slip = plant_.slip_from_rest(flow_.state, flow_.memory, held_);
    const auto now = plant_.moment(flow_.state, flow_.memory, held_);
    const double gauge_Pa = flow_.state.side.muscle_pressure_Pa + disturbance_.gauge_Pa();
    return {time_s,
            current_mA_,
            flow_.state,
            read,
            plant::gauge_reading_Pa(plan_.rig.gauge, gauge_Pa),
            now.braid_force_N,
            now.friction_force_N,
            now.effects_pull_N};
  }

  std::int64_t counts() {
    const double length_m = plan_.rig.muscle.rest_length_m;
    const double wheel_m =
        plant_.rig().effects.wheel_m(flow_.state.joint.contraction_ratio * length_m, plays_);
    return counter_.count(wheel_m + disturbance_.jitter() * length_m);
  }

  void hold(double wanted_mA) {
    current_mA_ =
        controller_.already_quantised() ? wanted_mA : plant::dac_output_mA(plan_.rig.dac, wanted_mA);
    const double wanted_Pa = plant_.reference_pressure_Pa(current_mA_ + disturbance_.current_mA());
    reference_Pa_ = plant_.rig().effects.reference_Pa(wanted_Pa, plays_);
  }

  // The slow disturbances come on top of what effects make of the reference.
  void disturb(std::int64_t k) {
    const double time_s = static_cast<double>(k) * plan_.rig.tick_s;
    held_.reference_pressure_Pa = reference_Pa_ + disturbance_.reference_Pa(time_s);
  }

  long settling_ticks() const { return std::lround(plan_.rig.settling_time_s / plan_.rig.tick_s); }

  void integrate(std::int64_t k) {
    const double tick_s = plan_.rig.tick_s;
    integrator_->advance(flow_, held_, static_cast<double>(k) * tick_s, static_cast<double>(k + 1) * tick_s);
  }

  const RunPlan& plan_;
  controllers::Controller& controller_;
  plant::Plant plant_;
  std::unique_ptr<engine::Integrator> integrator_;
  plant::PulseCounter counter_;
  plant::Effects::Plays plays_{};
  Disturbance disturbance_;
  Recording recording_;
  engine::Flow flow_;
  plant::Held held_;
  double current_mA_ = 0.0, reference_Pa_ = 0.0;
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
