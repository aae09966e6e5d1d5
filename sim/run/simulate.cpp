// What drives a ride tick by tick: a controller, through the instruments, with noise.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <sim/ride/batch.hpp>
#include <sim/ride/sample.hpp>
#include <sim/run/drawn_noise.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

using plant::Sensed;

/// What a run does at each instant, and what it leaves behind. `done` hears that.
class Run : public ride::BatchItem {
 public:
  using Done = std::function<void(Recording recording)>;

  Run(const RunPlan& plan, controllers::Controller& controller, Done done)
      : plan_(plan),
        controller_(controller),
        done_(std::move(done)),
        rider_(ride::Loaded{plan.rig, plan.load_kg}),
        first_(-controller.preparation_ticks()),
        begin_(first_ - std::lround(plan.rig.settling_time_s / plan.rig.tick_s)),
        k_(begin_),
        counter_(plan.rig),
        disturbance_(plan.noise, plan.rig, plan.seed, plan.stream) {
    recording_.samples.reserve(plan_.ticks);
    ask_timed([&] { return controller_.rest(); });
    drive_.stray_current_mA = drive_.opposite.stray_current_mA = 0.0;  // one draw is no noise
    rider_.start(ride::settling(drive_, plan_.rig), time_s(begin_));
  }

  std::span<ride::Rider> riders() override { return {&rider_, 1}; }

  bool go_on() override {
    if (k_ > begin_ && k_ <= first_) look();  // at the end of each tick of settling
    if (k_ < first_) {
      hold();
    } else {
      if (k_ == first_) recording_.left_speed = rider_.speed();
      if (k_ == 0) rider_.open_ledger();
      if (!tick() || k_ + 1 >= static_cast<std::int64_t>(plan_.ticks)) return false;
    }
    ++k_;
    return true;
  }

  void end(const engine::Counters& solver, const engine::NumericalFailure* failure) override {
    const engine::Flow& last = rider_.now.flow;
    if (failure != nullptr) recording_.failure = failure->what();
    recording_.ledger = last.ledger;
    if (plan_.keep_ledger && !recording_.samples.empty()) {
      const Sample& first = recording_.samples.front();
      recording_.imbalance =
          rider_.plant().imbalance(first.state, last.state, last.ledger, first.cords(), last.memory);
    }
    recording_.solver = solver;
    if (recording_.solver.stiff_from_tick >= 0) recording_.solver.stiff_from_tick += begin_;
    recording_.findings = findings_for(controller_, plan_.rig);
    recording_.driven.pair = plan_.rig.pair() != nullptr;
    recording_.driven.joint_force = !plan_.outer_forces.empty();
    note_slack(recording_, plan_.rig);
    done_(std::move(recording_));
  }

 private:
  /// The ticks that a controller needs to find out about its load leave no row. False if it gives up.
  bool tick() {
    look();
    try {
      ask_timed([&] { return controller_.step({k_, time_s(k_), counts_}); });
    } catch (const controllers::ControllerFailure& failure) {
      recording_.failure = failure.what();
      return false;
    }
    hold();
    // Of a gauge on the muscle whether there is one or not.
    ride::SensorNoise noise{};
    draw(Sensed::muscle_pressure, noise);
    if (k_ >= 0) write(noise);
    return true;
  }

  void write(ride::SensorNoise noise) {
    for (const plant::Sensor& sensor : plan_.rig.sensors) {
      if (sensor.signal == Sensed::contraction) continue;
      if (sensor.signal != Sensed::muscle_pressure) draw(sensor.signal, noise);
      if (k_ > 0 && !takes_a_reading(sensor))
        for (std::size_t muscle : {0, 1}) noise[muscle][sensor.signal] = noise_[muscle][sensor.signal];
    }
    noise_ = noise;
    Sample row = ride::sample_of(rider_, counts_, noise);
    row.time_s = tidy_s(time_s(k_));
    recording_.take(row);
  }

  void draw(Sensed signal, ride::SensorNoise& noise) {
    noise[0][signal] = disturbance_.of(signal);
    if (plan_.rig.pair()) noise[1][signal] = disturbance_.of(signal);
  }

  /// Or shows the one that it showed a tick ago.
  bool takes_a_reading(const plant::Sensor& sensor) const {
    return sensor.taken_s(time_s(k_)) != sensor.taken_s(time_s(k_ - 1));
  }

  void look() {
    const double jitter_m = disturbance_.of(Sensed::contraction) * plan_.rig.muscle.rest_length_m;
    if (k_ <= begin_ + 1 || takes_a_reading(sensor_))
      counts_ = counter_.count(rider_.now.reading.wheel_m + jitter_m);
  }

  void ask_timed(auto answer) {
    const auto begin = std::chrono::steady_clock::now();
    ask(answer());
    recording_.controller_s +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  void ask(const controllers::Command& wanted) {
    const auto given = [&](double wanted_mA) {
      return controller_.already_quantised() ? wanted_mA : plant::dac_output_mA(plan_.rig.dac, wanted_mA);
    };
    drive_.current_mA = given(wanted.current_mA);
    drive_.stray_current_mA = disturbance_.current_mA();
    if (!plan_.rig.pair()) return;
    drive_.opposite.current_mA = given(wanted.opposite_mA);
    drive_.opposite.stray_current_mA = disturbance_.current_mA();
  }

  void hold() {
    drive_.stray_pressure_Pa = disturbance_.reference_Pa(time_s(k_));
    for (; next_force_ < plan_.outer_forces.size(); ++next_force_) {
      if (plan_.outer_forces[next_force_].at_s > time_s(k_) + ride::same_instant_s) break;
      drive_.joint_force_N = plan_.outer_forces[next_force_].force_N;
    }
    rider_.hold(k_ < 0 ? ride::settling(drive_, plan_.rig) : drive_, time_s(k_ + 1));
  }

  double time_s(std::int64_t k) const { return static_cast<double>(k) * plan_.rig.tick_s; }

  const RunPlan& plan_;
  controllers::Controller& controller_;
  Done done_;
  ride::Rider rider_;
  std::int64_t first_, begin_, k_;  // ticks: of the controller, of the settling, now
  ride::Drive drive_;
  std::size_t next_force_ = 0;
  const plant::Sensor& sensor_ = plan_.rig.sensors.position();
  plant::PositionReader counter_;
  DrawnNoise disturbance_;
  std::int64_t counts_ = 0;
  ride::SensorNoise noise_{};  ///< of the last row
  Recording recording_;
};

/// No load, no motion.
bool moves(const RunPlan& plan) {
  return plan.rig.pair() || plan.rig.can_hang(plan.load_kg);
}

/// Pairs go alone, as `follow` has them: to the same bits.
ride::BatchKey key_of(const RunPlan& plan) {
  const ride::Rider rider(ride::Loaded{plan.rig, plan.load_kg});
  ride::BatchKey key = ride::batch_key({&rider, 1}, {}, plan.rig.integrator, plan.keep_ledger);
  key.in_lanes = key.in_lanes && !plan.rig.pair();
  return key;
}

Prepare preparing(const Ordering& ordering, const Finished& finished) {
  return [&](std::size_t index) -> std::optional<BatchTask> {
    const auto order = std::make_shared<Order>(ordering(index));
    if (moves(order->plan))
      return BatchTask{key_of(order->plan), [=, &finished] {
                         return std::make_shared<Run>(order->plan, *order->controller,
                                                      [index, order, &finished](Recording recording) {
                                                        finished(index, std::move(recording));
                                                      });
                       }};
    finished(index, without_load());
    return std::nullopt;
  };
}

}  // namespace

std::vector<controllers::Finding> findings_for(const controllers::Controller& controller,
                                               const plant::Rig& rig) {
  std::vector<controllers::Finding> found = controller.findings();
  for (controllers::Finding& finding : found)
    for (std::string* text : {&finding.name, &finding.unit}) *text = in_unit(rig.command_unit(), *text);
  return found;
}

Recording simulate(const RunPlan& plan, controllers::Controller& controller) {
  if (!moves(plan)) return without_load();
  Recording result;
  Run run(plan, controller, [&](Recording recording) { result = std::move(recording); });
  ride::Alone(run.riders(), key_of(plan)).run(run);
  return result;
}

void simulate_all(std::size_t count, unsigned threads, const Ordering& ordering, const Finished& finished) {
  run_batch(count, count, threads, preparing(ordering, finished));
}

void simulate_all(const Take& take, std::size_t about, unsigned threads, const Ordering& ordering,
                  const Finished& finished) {
  run_batch(take, about, threads, preparing(ordering, finished));
}

double contraction_per_count(const plant::Rig& rig) {
  return plant::count_height_m(rig) / rig.muscle.rest_length_m;
}

namespace {

controllers::ForceModel force_model(const plant::Muscle& muscle) {
  return {muscle.rest_radius_m * std::sqrt(plant::pulling_share(muscle)),
          muscle.rest_length_m,
          muscle.braid_angle_rad,
          muscle.end_correction,
          muscle.contact_surface == plant::ContactSurface::printed,
          muscle.count};
}

}  // namespace

controllers::Knowledge knowledge_of(const plant::Rig& rig, std::vector<double> target) {
  controllers::Knowledge known{.contraction_per_count = contraction_per_count(rig),
                               .middle_of_count = plant::middle_of_count(rig.sensors.position()),
                               .tick_s = rig.tick_s,
                               .largest_current_mA = rig.dac.largest_command,
                               .target = std::move(target),
                               .model = force_model(rig.muscle),
                               .valve = domain::valve_line(rig.valve),
                               .reach = {}};
  if (rig.has_angle()) known.wheel_radius_m = rig.joint.wheel_radius_m;
  if (const plant::Pair* pair = rig.pair())
    known.pair = {.opposite = force_model(pair->opposite.muscle),
                  .opposite_valve = domain::valve_line(pair->opposite.valve),
                  .mounted_ratio = pair->contraction_ratio,
                  .opposite_mounted_ratio = pair->opposite_contraction_ratio,
                  .stiffness_N_m_per_rad = {}};
  return known;
}

}  // namespace mckibben::run
