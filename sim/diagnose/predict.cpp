// What drove a run drives riders; see the header.
#include <algorithm>
#include <memory>
#include <utility>

#include <sim/diagnose/predict.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/engine/failure.hpp>
#include <sim/run/follow.hpp>
#include <sim/run/run_batch.hpp>

namespace mckibben::diagnose {
namespace {

/// What instruments see of riders that follow a run.
class Prediction final : public run::Follower {
 public:
  using Done = std::function<void(std::vector<Readings> readings, std::exception_ptr failure)>;

  Prediction(const domain::Run& run, std::span<const Loaded> rigs, Done done, run::Disturbance disturbance)
      : Follower({rigs.begin(), rigs.end()}, rigs.front().rig, run::course_of(run, rigs.front().rig),
                 std::move(disturbance)),
        pair_(rigs.front().rig.pair() != nullptr),
        angle_(rigs.front().rig.has_angle()),
        forces_(run.length_is_given()),
        gauge_(run.judged_gauge()),
        force_beside_(run.beside(domain::Beside::force) != nullptr),
        valve_beside_(run.valve_pressure_Pa.has_value()),
        opposite_valve_beside_(run.opposite_valve_pressure_Pa.has_value()),
        rest_length_m_(run.rest_length_m),
        done_(std::move(done)),
        readings_(rigs.size()) {
    for (Readings& one : readings_) {
      one.judged.reserve(course().rows.size());
      one.pressure_Pa.reserve(course().rows.size());
    }
  }

  void end(const engine::Counters&, const engine::NumericalFailure* failure) override {
    done_(std::move(readings_), failure == nullptr ? nullptr : std::make_exception_ptr(*failure));
  }

 private:
  void look(std::size_t) override {
    const std::span<const ride::Rider> all = riders();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const ride::Rider& rider = all[i];
      const ride::Reading& seen = rider.now.reading;
      if (!gauge_)
        readings_[i].judged.push_back(forces_ ? rider.moment().cord_force_N()
                                              : seen.wheel_m / travel_m(rider.plant().rig()));
      readings_[i].pressure_Pa.push_back(seen.muscle_pressure_Pa);
      if (force_beside_) readings_[i].force_N.push_back(std::max(rider.moment().cord_force_N(), 0.0));
      if (pair_) readings_[i].opposite_pressure_Pa.push_back(seen.opposite_pressure_Pa);
      if (valve_beside_) readings_[i].valve_pressure_Pa.push_back(seen.valve_pressure_Pa);
      if (opposite_valve_beside_)
        readings_[i].opposite_valve_pressure_Pa.push_back(seen.opposite_valve_pressure_Pa);
      if (gauge_) readings_[i].judged.push_back(readings_[i].beside(*gauge_).back());
    }
    readings_[0].states.push_back(all[0].now.flow.state);
  }

  /// Of the wheel's rim, for a reading of 1.
  double travel_m(const plant::Rig& rig) const {
    if (angle_) return rig.joint.wheel_radius_m;
    return rest_length_m_ > 0.0 ? rest_length_m_ : rig.muscle.rest_length_m;
  }

  bool pair_, angle_;                                         // two muscles; angles are read
  bool forces_;                                               // are read, at lengths that are given
  std::optional<domain::Beside> gauge_;                       // that is judged, where only pressures are read
  bool force_beside_, valve_beside_, opposite_valve_beside_;  // of the cord, of valves are read besides
  double rest_length_m_;                                      // that readings go by; 0: each rig's own
  Done done_;
  std::vector<Readings> readings_;
};

}  // namespace

solver::Settings settings_for(std::span<const Loaded> rigs, solver::Method method) {
  const bool shared = method != solver::Method::cvode && std::ranges::none_of(rigs, [](const Loaded& one) {
                        return one.rig.friction.memory == plant::FrictionMemory::coulomb;
                      });
  return {method, shared ? thresholds.predict.tolerance : thresholds.predict.tolerance_alone};
}

std::vector<Readings> predict(const domain::Run& run, std::span<const Loaded> rigs, solver::Method method,
                              std::span<const double> memories) {
  std::vector<Readings> readings;
  std::exception_ptr failure;
  run::Disturbance begun;
  if (!memories.empty())
    begun.begin = [&](std::size_t i, ride::Underway& begins) { begins.memories = memories[i]; };
  const auto prediction = std::make_shared<Prediction>(
      run, rigs,
      [&](std::vector<Readings> all, std::exception_ptr why) {
        readings = std::move(all);
        failure = std::move(why);
      },
      std::move(begun));
  const ride::BatchKey key = prediction->key(settings_for(rigs, method), false);
  if (rigs.size() == 1 || !key.in_lanes) {
    ride::Alone(prediction->riders(), key).run(*prediction);
  } else {
    ride::Batch batch(key, rigs.size());
    batch.submit(prediction);
    batch.run();
  }
  if (failure) std::rethrow_exception(failure);
  return readings;
}

void predict_all(std::size_t count, std::size_t rigs, unsigned threads, solver::Method method,
                 const std::function<Wanted(std::size_t index)>& wanted, const Predicted& predicted) {
  run::run_batch(count, rigs, threads, [&](std::size_t index) {
    const Wanted one = wanted(index);
    const auto prediction =
        std::make_shared<Prediction>(*one.run, one.rigs, std::bind_front(predicted, index), one.disturbance);
    solver::Settings settings = settings_for(one.rigs, method);
    settings.tolerance = one.tolerance.value_or(settings.tolerance);
    return run::BatchTask{prediction->key(settings, false), [=] { return prediction; }};
  });
}

}  // namespace mckibben::diagnose
