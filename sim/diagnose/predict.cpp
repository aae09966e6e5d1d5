// What drove a run drives riders; see the header.
#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>
#include <variant>

#include <sim/diagnose/predict.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/engine/failure.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/follow.hpp>
#include <sim/run/side_by_side.hpp>

namespace mckibben::diagnose {
namespace {

/// What riders do at each instant of a run, and what instruments see of them.
class Flight {
 public:
  Flight(const domain::Run& run, std::span<const Hanging> rigs)
      : pair_(rigs.front().rig.pair() != nullptr),
        forces_(run.length_is_given()),
        force_beside_(run.beside(domain::Beside::force) != nullptr),
        rest_length_m_(run.rest_length_m),
        rig_(rigs.front().rig),
        course_(run::course_of(run, rig_)) {
    readings_.resize(rigs.size());
    for (Readings& list : readings_) {
      list.judged.reserve(course_.rows.size());
      list.pressure_Pa.reserve(course_.rows.size());
    }
  }

  const run::Course& course() const { return course_; }

  void begin(std::span<ride::Rider> riders, std::span<const double> memories = {}) {
    settling_ = run::start(riders, course_, rig_, memories);
  }

  /// At an instant: holds what acts until the next one; false if this was the last that is asked for.
  bool go_on(std::span<ride::Rider> riders) {
    if (settling_ > 0) {
      --settling_;
      hold(riders, course_.drives.front(), run::before_s(course_, rig_, settling_));
      return true;
    }
    hold(riders, course_.toward(k_), course_.until_s(k_, rig_.tick_s));  // forces are those of the way ahead
    if (course_.rows[row_] == k_) {
      look(riders);
      if (++row_ == course_.rows.size()) return false;
    }
    ++k_;
    return true;
  }

  std::vector<Readings> close() { return std::move(readings_); }

 private:
  static void hold(std::span<ride::Rider> riders, const ride::Drive& drive, double until_s) {
    for (ride::Rider& rider : riders) rider.hold(drive, until_s);
  }

  void look(std::span<const ride::Rider> riders) {
    for (std::size_t i = 0; i < riders.size(); ++i) {
      const ride::Reading& seen = riders[i].now.reading;
      readings_[i].judged.push_back(forces_ ? riders[i].moment().cord_force_N()
                                            : seen.wheel_m / travel_m(riders[i].plant().rig()));
      readings_[i].pressure_Pa.push_back(seen.muscle_pressure_Pa);
      if (force_beside_) readings_[i].force_N.push_back(std::max(riders[i].moment().cord_force_N(), 0.0));
      if (pair_) readings_[i].opposite_pressure_Pa.push_back(seen.opposite_pressure_Pa);
    }
    readings_[0].states.push_back(riders[0].now.flow.state);
  }

  /// Of the wheel's rim, for a reading of 1.
  double travel_m(const plant::Rig& rig) const {
    if (pair_) return rig.joint.wheel_radius_m;
    return rest_length_m_ > 0.0 ? rest_length_m_ : rig.muscle.rest_length_m;
  }

  bool pair_;             // angles are read
  bool forces_;           // are read, at lengths that are given
  bool force_beside_;     // of the cord is read besides
  double rest_length_m_;  // that readings go by; 0: each rig's own
  plant::Rig rig_;        // whose ticks count
  run::Course course_;
  long settling_ = 0;
  std::size_t k_ = 0, row_ = 0;
  std::vector<Readings> readings_;
};

/// A flight beside others.
class Flying final : public run::Errand {
 public:
  using Done = std::function<void(std::vector<Readings> readings, std::exception_ptr failure)>;

  Flying(Flight flight, const Wanted& wanted, solver::Method method, Done done)
      : flight_(std::move(flight)), wanted_(wanted), method_(method), done_(std::move(done)) {
    for (const Hanging& hanging : wanted_.rigs)
      riders_.emplace_back(ride::Hanging{hanging.rig, hanging.load_kg});
    flight_.begin(riders_);
  }

  std::span<ride::Rider> riders() override { return riders_; }
  bool go_on() override { return flight_.go_on(riders_); }
  void end(const engine::Counters&) override { finish(flight_.close(), nullptr); }
  void alone(const engine::Pace&, const engine::Counters&) override {  // from the start, as it would anywhere
    try {
      finish(predict(*wanted_.run, wanted_.rigs, method_), nullptr);
    } catch (const engine::NumericalFailure&) {
      finish({}, std::current_exception());
    }
  }
  bool is_done() const override { return is_done_; }

 private:
  void finish(std::vector<Readings> readings, std::exception_ptr failure) {
    is_done_ = true;
    done_(std::move(readings), std::move(failure));
  }

  Flight flight_;
  Wanted wanted_;
  solver::Method method_;
  Done done_;
  std::vector<ride::Rider> riders_;
  bool is_done_ = false;
};

std::optional<ride::ConvoyClass> class_of(const Wanted& wanted, const Flight& flight, solver::Method method) {
  std::vector<const plant::Rig*> rigs;
  for (const Hanging& hanging : wanted.rigs) rigs.push_back(&hanging.rig);
  if (wanted.rigs.front().rig.pair() != nullptr) return std::nullopt;  // convoys are of single muscles
  return ride::convoy_class(rigs, flight.course().drives.front(), settings_for(wanted.rigs, method));
}

/// As a ride takes them: all have one muscle, or all have two.
std::variant<std::vector<ride::Hanging>, std::vector<ride::Paired>> riding(std::span<const Hanging> rigs) {
  std::vector<ride::Hanging> hanging;
  std::vector<ride::Paired> pairs;
  for (const Hanging& one : rigs) {
    if (const plant::Pair* pair = one.rig.pair())
      pairs.push_back(run::paired(one.rig, *pair));
    else
      hanging.push_back({one.rig, one.load_kg});
  }
  if (pairs.empty()) return hanging;
  return pairs;
}

}  // namespace

solver::Settings settings_for(std::span<const Hanging> rigs, solver::Method method) {
  const bool shared = std::visit(
      [&](const auto& list) { return ride::can_share_steps(std::span(list), method); }, riding(rigs));
  return {method, shared ? thresholds.predict.tolerance : thresholds.predict.tolerance_alone};
}

std::vector<Readings> predict(const domain::Run& run, std::span<const Hanging> rigs, solver::Method method,
                              std::span<const double> memories) {
  Flight flight(run, rigs);
  const solver::Settings settings = settings_for(rigs, method);
  ride::Ride ride =
      std::visit([&](const auto& list) { return ride::Ride(std::span(list), settings); }, riding(rigs));
  flight.begin(ride.riders(), memories);
  while (flight.go_on(ride.riders())) ride.advance();
  return flight.close();
}

void predict_all(std::size_t count, std::size_t rigs, unsigned threads, solver::Method method,
                 const std::function<Wanted(std::size_t index)>& wanted, const Predicted& predicted) {
  std::atomic<std::size_t> next{0}, done{0};
  const run::Take take = [&]() -> std::optional<std::size_t> {
    const std::size_t index = run::interrupted() ? count : next++;
    return index < count ? std::optional(index) : std::nullopt;
  };
  run::do_all(take, rigs, threads, [&](std::size_t index) -> std::optional<run::Prepared> {
    const auto one = std::make_shared<const Wanted>(wanted(index));
    const Flying::Done tell = [&, index](std::vector<Readings> readings, std::exception_ptr failure) {
      predicted(index, std::move(readings), std::move(failure));
      ++done;
    };
    const auto flight = std::make_shared<Flight>(*one->run, one->rigs);
    if (auto in = class_of(*one, *flight, method))
      return run::Prepared{*std::move(in), [one, flight, method, tell] {
                             return std::make_unique<Flying>(std::move(*flight), *one, method, tell);
                           }};
    Flying(std::move(*flight), *one, method, tell).alone({}, {});
    return std::nullopt;
  });
  if (done < count) throw run::Interrupted();
}

}  // namespace mckibben::diagnose
