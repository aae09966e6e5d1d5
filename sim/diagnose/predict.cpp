// What drove a run drives riders; see the header.
#include <algorithm>
#include <memory>
#include <string_view>
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
        rest_length_m_(run.rest_length_m),
        done_(std::move(done)),
        readings_(rigs.size()) {
    for (const domain::Reading& reading : run.readings) channels_.push_back(reading.channel);
    for (Readings& one : readings_) {
      one.readings.resize(channels_.size());
      for (std::vector<double>& values : one.readings) values.reserve(course().rows.size());
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
      for (std::size_t k = 0; k < channels_.size(); ++k)
        readings_[i].readings[k].push_back(seen(rider, channels_[k]));
      readings_[i].pressure_Pa.push_back(rider.now.reading.of(plant::Sensed::muscle_pressure));
    }
    readings_[0].states.push_back(all[0].now.flow.state);
  }

  double seen(const ride::Rider& rider, const plant::Channel& channel) const {
    const ride::Reading& now = rider.now.reading;
    const plant::Rig& rig = rider.plant().rig();
    const std::string_view key = channel.signal->in_dataset;
    if (key == "angle") return now.wheel_m / rig.joint.wheel_radius_m;
    if (key == "contraction")
      return now.wheel_m / (rest_length_m_ > 0.0 ? rest_length_m_ : rig.muscle.rest_length_m);
    const plant::Sensed sensed = plant::named<plant::Sensed>(key).value();
    const plant::Sensor* sensor = rig.sensors.of(sensed);
    if (sensed != plant::Sensed::force || (sensor != nullptr && sensor->is_late()))
      return now.of(sensed, channel.muscle);
    return std::max(rider.cord_force_N(channel.muscle), 0.0);  // a cord that would push is slack
  }

  std::vector<plant::Channel> channels_;  // that were read
  double rest_length_m_;                  // that readings go by; 0: each rig's own
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
