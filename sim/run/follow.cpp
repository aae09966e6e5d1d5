// Stamp after stamp; see the header.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <sim/engine/failure.hpp>
#include <sim/ride/sample.hpp>
#include <sim/run/follow.hpp>

namespace mckibben::run {
namespace {

constexpr double never_s = -std::numeric_limits<double>::infinity();
constexpr double run_in_s = 1.0;  // several lags of valve and hose

}  // namespace

Follower::Follower(std::vector<ride::Rider> riders, const plant::Rig& rig, Course course,
                   Disturbance disturbance)
    : rig_(rig),
      course_(std::move(course)),
      disturbance_(std::move(disturbance)),
      riders_(std::move(riders)) {
  settling_ = ticks_before();
  const ride::Drive drive = before();
  for (std::size_t i = 0; i < riders_.size(); ++i) riders_[i].start(settling(drive, i), before_s(settling_));
}

long Follower::ticks_before() const {
  return std::lround((course_.begins ? run_in_s : rig_.settling_time_s) / rig_.tick_s);
}

ride::Drive Follower::before() const {
  ride::Drive drive = course_.drives.front();
  if (course_.begins) {  // commands came as they will go on: odd about the first stamp
    const double as_late_s = 2.0 * course_.time_s.front() - before_s(settling_);
    const auto after = std::ranges::upper_bound(course_.time_s, as_late_s + ride::same_instant_s);
    const ride::Drive& later = course_.drives[static_cast<std::size_t>(after - course_.time_s.begin() - 1)];
    drive.current_mA = 2.0 * drive.current_mA - later.current_mA;
    drive.opposite.current_mA = 2.0 * drive.opposite.current_mA - later.opposite.current_mA;
  }
  if (course_.filled_Pa) drive.muscle_pressure_Pa = course_.filled_Pa;
  return drive;
}

ride::Drive Follower::settling(const ride::Drive& drive, std::size_t rider) const {
  return disturbed(ride::settling(drive, riders_[rider].plant().rig()), rider, never_s, never_s);
}

void Follower::set_off() {
  for (std::size_t i = 0; i < riders_.size(); ++i) {
    ride::Underway begins = *course_.begins;
    if (disturbance_.begin) disturbance_.begin(i, begins);
    ride::set_off(riders_[i], begins);
  }
}

ride::Drive Follower::disturbed(ride::Drive drive, std::size_t rider, double from_s, double to_s) const {
  if (disturbance_.drive) disturbance_.drive(riders_[rider], rider, from_s, to_s, drive);
  return drive;
}

bool Follower::go_on() {
  if (k_ == 0 && settling_ < ticks_before()) settled_a_tick();
  if (settling_ > 0) {
    const double until_s = before_s(settling_ - 1);
    const ride::Drive drive = before();
    for (std::size_t i = 0; i < riders_.size(); ++i) riders_[i].hold(settling(drive, i), until_s);
    --settling_;
    return true;
  }
  if (k_ == 0) {
    if (course_.begins) set_off();
    begin();
  }
  const double until_s = course_.until_s(k_, rig_.tick_s);
  const ride::Drive drive = course_.toward(k_);
  for (std::size_t i = 0; i < riders_.size(); ++i)  // forces are those of the way ahead
    riders_[i].hold(disturbed(drive, i, course_.time_s[k_], until_s), until_s);
  if (row_ < course_.rows.size() && course_.rows[row_] == k_) {
    look(k_);
    ++row_;
  }
  ++k_;
  return row_ < course_.rows.size();
}

Following::Following(const plant::Rig& rig, double load_kg, Course course, Done done)
    : Follower({ride::Rider({rig, load_kg})}, rig, std::move(course)), counter_(rig), done_(std::move(done)) {
  const ride::Drive& first = this->course().drives.front();
  recording_.driven = {.pair = rig.pair() != nullptr,
                       .length = first.contraction_ratio.has_value(),
                       .pressure = {first.given(), first.opposite.given()},
                       .supply = first.supply_pressure_Pa.has_value(),
                       .joint_force = this->course().outer_force};
  recording_.samples.reserve(this->course().rows.size());
}

void Following::look(std::size_t stamp) {
  const ride::Rider& rider = riders().front();
  Sample row = ride::sample_of(rider, counter_.count(rider.now.reading.wheel_m));
  row.time_s = course().time_s[stamp];
  recording_.take(row);
}

void Following::end(const engine::Counters& solver, const engine::NumericalFailure* failure) {
  const ride::Rider& rider = riders().front();
  const engine::Flow& last = rider.now.flow;
  if (failure != nullptr) recording_.failure = failure->what();
  recording_.ledger = last.ledger;
  recording_.solver = solver;
  if (!recording_.samples.empty()) {
    // Where values are given, only `erk` keeps an exact ledger (docs/architecture.md, An instant).
    const Driven& driven = recording_.driven;
    const bool given = driven.length || std::ranges::any_of(driven.pressure, [](auto pressure) {
                         return pressure != plant::GivenPressure::none;
                       });
    const bool exact = rig().integrator.method != solver::Method::cvode && solver.stiff_from_tick < 0;
    const Sample& first = recording_.samples.front();
    if (exact || !given)
      recording_.imbalance =
          rider.plant().imbalance(first.state, last.state, last.ledger, first.cords(), last.memory);
    if (solver.stiff_from_tick >= 0) recording_.solver.stiff_from_tick -= ticks_before();
    note_slack(recording_, rig());
  }
  done_(std::move(recording_));
}

Recording follow(const plant::Rig& rig, double load_kg, const Course& course) {
  Recording recording;
  Following following(rig, load_kg, course, [&](Recording whole) { recording = std::move(whole); });
  ride::Alone(following.riders(), following.key()).run(following);
  return recording;
}

}  // namespace mckibben::run
