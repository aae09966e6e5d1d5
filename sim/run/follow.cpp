// Stamp after stamp; see the header.
#include <algorithm>
#include <cmath>
#include <utility>

#include <plant/instruments.hpp>
#include <sim/engine/failure.hpp>
#include <sim/ride/sample.hpp>
#include <sim/run/follow.hpp>

namespace mckibben::run {
namespace {

using ride::Drive;

ride::Ride ride_of(const domain::RigFile& rig, double load_kg) {
  if (const plant::Pair* pair = rig.pair()) return {paired(rig, *pair), rig.integrator, true};
  return {ride::Hanging{rig, load_kg}, rig.integrator, true};
}

/// Whether something is not left to the equations.
bool is_given(const Driven& driven) {
  return driven.length || driven.pressure[0] || driven.pressure[1];
}

class Following {
 public:
  Following(const domain::RigFile& rig, double load_kg, const Course& course)
      : rig_(rig), course_(course), ride_(ride_of(rig, load_kg)), counter_(rig) {}

  Recording operator()() {
    recording_.samples.reserve(course_.rows.size());
    const Drive& first = course_.drives.front();
    recording_.driven = {
        .pair = rig_.pair() != nullptr,
        .length = first.contraction_ratio.has_value(),
        .pressure = {first.muscle_pressure_Pa.has_value(), first.opposite.muscle_pressure_Pa.has_value()}};
    try {
      begin();
      auto row = course_.rows.begin();
      for (std::size_t k = 0; k < stamps(); ++k) {
        ride_.hold(course_.toward(k), course_.until_s(k, rig_.tick_s));
        if (row != course_.rows.end() && *row == k) {
          recording_.take(sample(k));
          ++row;
        }
        if (row == course_.rows.end()) break;
        ride_.advance();
      }
    } catch (const engine::NumericalFailure& failure) {
      recording_.failure = failure.what();
    }
    close();
    return std::move(recording_);
  }

 private:
  std::size_t stamps() const { return course_.time_s.size(); }
  double time(std::size_t k) const { return course_.time_s[k]; }

  /// Settled, or on its way; the counter goes along.
  void begin() {
    for (long k = start({&ride_.rider(), 1}, course_, rig_); k > 0; --k) {
      ride_.step(course_.drives.front(), before_s(course_, rig_, k - 1));
      counter_.count(ride_.reading().wheel_m);
    }
    ride_.open_ledger();
  }

  Sample sample(std::size_t k) {
    Sample row = ride::sample_of(ride_.rider(), counter_.count(ride_.reading().wheel_m));
    row.time_s = time(k);
    return row;
  }

  void close() {
    const engine::Flow& end = ride_.flow();
    recording_.ledger = end.ledger;
    recording_.solver = ride_.counters();
    if (recording_.samples.empty()) return;
    // Where values are given, only `erk` keeps an exact ledger (docs/architecture.md, An instant).
    const bool exact =
        rig_.integrator.method != solver::Method::cvode && recording_.solver.stiff_from_tick < 0;
    if (exact || !is_given(recording_.driven))
      recording_.imbalance = ride_.plant().imbalance(recording_.samples.front().state, end.state, end.ledger);
    if (recording_.solver.stiff_from_tick >= 0)
      recording_.solver.stiff_from_tick -= std::lround(rig_.settling_time_s / rig_.tick_s);
    note_slack(recording_);
  }

  const domain::RigFile& rig_;
  const Course& course_;
  ride::Ride ride_;
  plant::PositionReader counter_;
  Recording recording_;
};

}  // namespace

double before_s(const Course& course, const plant::Rig& rig, long ticks) {
  return course.time_s.front() - static_cast<double>(ticks) * rig.tick_s;
}

long start(std::span<ride::Rider> riders, const Course& course, const plant::Rig& rig,
           std::span<const double> memories) {
  const long ticks = course.begins ? 0 : std::lround(rig.settling_time_s / rig.tick_s);
  for (std::size_t i = 0; i < riders.size(); ++i) {
    riders[i].start(course.drives.front(), before_s(course, rig, ticks));
    if (!course.begins) continue;
    ride::Underway begins = *course.begins;
    if (!memories.empty()) begins.memories = memories[i];
    ride::set_off(riders[i], begins);
  }
  return ticks;
}

ride::Paired paired(const domain::RigFile& rig, const plant::Pair& pair) {
  return {rig, plant::opposite_rig(rig, pair), pair};
}

Recording follow(const domain::RigFile& rig, double load_kg, const Course& course) {
  return Following(rig, load_kg, course)();
}

}  // namespace mckibben::run
