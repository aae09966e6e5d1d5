// Python's lock is given back while something moves; see the header.
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/python/inputs.hpp>
#include <sim/python/long_work.hpp>
#include <sim/python/ride.hpp>
#include <sim/ride/sample.hpp>
#include <sim/run/follow.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::python {
namespace {

constexpr double longest_step_s = 60.0;  // longer ones can be taken in several
// A vacuum; what no muscle holds.
constexpr double lowest_pressure_Pa = -plant::Pa_per_bar, highest_pressure_Pa = 100.0 * plant::Pa_per_bar;

ride::Ride ride_of(const plant::Rig& rig, std::optional<double> load_kg) {
  if (rig.pair() != nullptr && load_kg)
    throw py::value_error(fmt::format(
        "load_kg = {:g}: must be left out; two muscles turn a link, no load hangs there", *load_kg));
  if (rig.pair() == nullptr) {
    if (!load_kg) throw py::value_error("load_kg is missing: the mass that hangs on the muscle, 0 to 500 kg");
    load_within(*load_kg, rig, "load_kg");
  }
  return {ride::Loaded{rig, load_kg.value_or(0.0)}, rig.integrator};
}

/// No pressure asked for.
Given lowest(const plant::Rig& rig) {
  Given given{.command = rig.valve.zero_command};
  if (const plant::Pair* pair = rig.pair()) given.opposite_command = pair->opposite.valve.zero_command;
  return given;
}

}  // namespace

Ride::Ride(const py::object& rig, std::optional<double> load_kg, double shaken)
    : jitter(shaken),
      rig_(std::make_shared<const plant::Rig>(rig_of(rig).file)),
      load_kg_(load_kg),
      ride_(ride_of(*rig_, load_kg)),
      counter_(*rig_) {
  start(lowest(*rig_), 0.0, true);
}

Ride::Ride(const Ride& other)
    : jitter(other.jitter),
      rig_(other.rig_),
      load_kg_(other.load_kg_),
      ride_(other.ride_),
      counter_(other.counter_),
      drive_(other.drive_),
      begin_s_(other.begin_s_),
      ticks_(other.ticks_),
      counts_(other.counts_) {}

void Ride::start(const Given& given, double at_s, bool settle) {
  const Turn turn(busy_);
  const ride::Drive drive = with(given, {});
  if (!std::isfinite(at_s)) throw py::value_error("at_s is not a finite number");
  drive_ = drive;
  const long ticks = settle ? std::lround(rig_->settling_time_s / rig_->tick_s) : 0;
  begin_s_ = at_s;
  ticks_ = -ticks;
  counter_ = plant::PositionReader(*rig_);
  const py::gil_scoped_release released;
  if (ticks > 0) drive_ = ride::settling(drive, *rig_);
  ride_.start(drive_, time_after(0));
  look();
  while (ticks_ < 0) advance();
  drive_ = drive;
}

Shown Ride::step(const Given& given, std::optional<double> dt_s) {
  const Turn turn(busy_);
  if (dt_s && (!(*dt_s > 0.0) || !(*dt_s <= longest_step_s)))
    throw py::value_error(
        fmt::format("dt_s = {:g}: must be above 0 and at most {:g} s", *dt_s, longest_step_s));
  drive_ = with(given, drive_);
  const py::gil_scoped_release released;
  if (dt_s) {
    const double before_s = ride_.time_s();
    begin_s_ = before_s + *dt_s;
    ticks_ = 0;
    ride_.step(drive_, begin_s_);
    look_since(before_s);
  } else {
    advance();
  }
  return shown();
}

Simulated Ride::follow(const Commands& command, const std::optional<Commands>& opposite) {
  const Turn turn(busy_);
  const auto rows = static_cast<std::size_t>(command.size());
  if (command.ndim() != 1 || (opposite && (opposite->ndim() != 1 || opposite->size() != command.size())))
    throw py::value_error("commands have the shape (ticks,), those of both muscles alike");
  if (opposite && !pair()) throw py::value_error("the rig has one muscle; there is no opposite one");
  const double* one = command.data();
  const double* two = opposite ? opposite->data() : nullptr;
  for (std::size_t k = 0; k < rows; ++k) {
    if (!is_command(one[k], *rig_)) command_within(one[k], *rig_, fmt::format("command[{}]", k));
    if (two != nullptr && !is_command(two[k], *rig_))
      command_within(two[k], *rig_, fmt::format("opposite_command[{}]", k));
  }
  const auto recording = std::make_shared<run::Recording>();
  recording->driven.pair = pair();
  drive_.muscle_pressure_Pa.reset();
  if (two != nullptr) drive_.opposite.muscle_pressure_Pa.reset();
  recording->samples.reserve(rows);
  do_long(py::none(), [&](const run::ProgressHook&) {
    for (std::size_t k = 0; k < rows; ++k) {
      if (run::interrupted()) throw run::Interrupted();
      drive_.current_mA = one[k];
      if (two != nullptr) drive_.opposite.current_mA = two[k];
      const double before_s = ride_.time_s();
      ride_.hold(drive_, time_after(1));
      recording->take(ride::sample_of(ride_.rider(), counts_));
      ride_.advance();
      ++ticks_;
      look_since(before_s);
    }
  });
  recording->solver = ride_.counters();
  return {recording, plant::channels_of(*rig_, recording->driven), "ride"};
}

Ride::Saved Ride::save() const {
  const Turn turn(busy_);
  return {rig_, ride_.save(), counter_, drive_, begin_s_, ticks_, counts_, jitter};
}

void Ride::restore(const Saved& saved) {
  const Turn turn(busy_);
  if (saved.rig != rig_ && fields_of(*saved.rig) != fields_of(*rig_))
    throw py::value_error("what was saved is of another rig");
  ride_.restore(saved.ride);
  counter_ = saved.counter;
  drive_ = saved.drive;
  begin_s_ = saved.begin_s;
  ticks_ = saved.ticks;
  counts_ = saved.counts;
  jitter = saved.jitter;
}

engine::Linear Ride::linearise() const {
  const Turn turn(busy_);
  return engine::linearise(ride_.plant(), ride_.flow(), ride_.rider().now.held,
                           {drive_.current_mA, drive_.opposite.current_mA});
}

Shown Ride::shown() const {
  const double rise_m = static_cast<double>(counts_) * plant::count_height_m(*rig_);
  const bool pair = this->pair(), angle = rig_->has_angle();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const ride::Reading& reading = ride_.reading();
  const plant::Sensor* const gauge = rig_->sensors.of(plant::Sensed::muscle_pressure);
  return {ride_.time_s(),
          angle ? none : rise_m / rig_->muscle.rest_length_m,
          angle ? rise_m / rig_->joint.wheel_radius_m : none,
          plant::shown(gauge, reading.of(plant::Sensed::muscle_pressure)),
          pair ? plant::shown(gauge, reading.of(plant::Sensed::muscle_pressure, 2)) : none,
          counts_};
}

/// What acts from here on; throws py::value_error for what contradicts itself or leaves its range.
ride::Drive Ride::with(const Given& given, const ride::Drive& before) const {
  if (!pair() && (given.opposite_command || given.opposite_muscle_pressure_Pa))
    throw py::value_error("the rig has one muscle; there is no opposite one");
  ride::Drive drive = before;
  const auto put = [&](ride::Command& side, const std::optional<double>& command,
                       const std::optional<double>& pressure_Pa, const std::string& prefix) {
    if (command && pressure_Pa)
      throw py::value_error(
          fmt::format("{0}command and {0}muscle_pressure_Pa: give one, the valve's command "
                      "or the pressure in its place",
                      prefix));
    if (command) {  // a valve that has one again keeps no pressure
      side.current_mA = command_within(*command, *rig_, prefix + "command");
      side.muscle_pressure_Pa.reset();
    }
    if (pressure_Pa)
      side.muscle_pressure_Pa =
          within(*pressure_Pa, lowest_pressure_Pa, highest_pressure_Pa, prefix + "muscle_pressure_Pa", "Pa");
  };
  put(drive, given.command, given.muscle_pressure_Pa, "");
  put(drive.opposite, given.opposite_command, given.opposite_muscle_pressure_Pa, "opposite_");
  if (given.contraction_ratio) {
    if (!plant::Braid(rig_->muscle).in_domain(*given.contraction_ratio))
      throw py::value_error(fmt::format("contraction_ratio = {:g}: this muscle cannot be held there",
                                        *given.contraction_ratio));
    drive.contraction_ratio = given.contraction_ratio;
  }
  return drive;
}

void Ride::advance() {
  const double before_s = ride_.time_s();
  ride_.step(drive_, time_after(1));
  ++ticks_;
  look_since(before_s);
}

void Ride::look() {
  counts_ = counter_.count(ride_.reading().wheel_m + jitter * rig_->muscle.rest_length_m);
}
void Ride::look_since(double before_s) {
  const plant::Sensor& sensor = rig_->sensors.position();
  if (sensor.taken_s(ride_.time_s()) != sensor.taken_s(before_s)) look();
}

}  // namespace mckibben::python
