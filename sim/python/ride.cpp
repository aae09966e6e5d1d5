// Python's lock is given back while something moves; see the header.
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include <sim/python/inputs.hpp>
#include <sim/python/ride.hpp>
#include <sim/ride/sample.hpp>
#include <sim/run/follow.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::python {
namespace {

double finite(double value, const char* name) {
  if (!std::isfinite(value)) throw py::value_error(std::string(name) + " is not a finite number");
  return value;
}

ride::Ride ride_of(const plant::Rig& rig, std::optional<double> load_kg) {
  if (rig.pair() != nullptr && load_kg) throw py::value_error("two muscles turn a link; no load hangs there");
  if (rig.pair() == nullptr &&
      (!load_kg || !(*load_kg + rig.joint.load_offset_kg > 0.0) || !(*load_kg <= 500.0)))
    throw py::value_error("load_kg: a mass above 0 and up to 500 kg hangs on one muscle");
  return {ride::Loaded{rig, load_kg.value_or(0.0)}, rig.integrator};
}

/// No pressure asked for.
Given lowest(const plant::Rig& rig) {
  Given given{.command = rig.valve.zero_command};
  if (const plant::Pair* pair = rig.pair()) given.opposite_command = pair->opposite.valve.zero_command;
  return given;
}

}  // namespace

Ride::Ride(const py::object& rig, std::optional<double> load_kg)
    : rig_(rig_of(rig).file), ride_(ride_of(rig_, load_kg)), counter_(rig_) {
  start(lowest(rig_), 0.0, true);
}

Ride::Ride(const Ride& other)
    : rig_(other.rig_),
      ride_(other.ride_),
      counter_(other.counter_),
      drive_(other.drive_),
      begin_s_(other.begin_s_),
      ticks_(other.ticks_),
      counts_(other.counts_) {}

void Ride::start(const Given& given, double at_s, bool settle) {
  const Turn turn(busy_);
  drive_ = {};
  take(given);
  finite(at_s, "at_s");
  const long ticks = settle ? std::lround(rig_.settling_time_s / rig_.tick_s) : 0;
  begin_s_ = at_s;
  ticks_ = -ticks;
  counter_ = plant::PositionReader(rig_);
  const py::gil_scoped_release released;
  ride_.start(drive_, time_after(0));
  look();
  while (ticks_ < 0) advance();
}

Shown Ride::step(const Given& given, std::optional<double> dt_s) {
  const Turn turn(busy_);
  take(given);
  const py::gil_scoped_release released;
  if (dt_s) {
    if (!(*dt_s > 0.0) || !std::isfinite(*dt_s)) throw std::invalid_argument("dt_s is a time above 0 s");
    begin_s_ = ride_.time_s() + *dt_s;
    ticks_ = 0;
    ride_.step(drive_, begin_s_);
    look();
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
  const double* one = command.data();
  const double* two = opposite ? opposite->data() : nullptr;
  for (std::size_t k = 0; k < rows; ++k) {
    finite(one[k], "command");
    if (two != nullptr) finite(two[k], "opposite_command");
  }
  const auto recording = std::make_shared<run::Recording>();
  recording->driven.pair = rig_.pair() != nullptr;
  {
    const py::gil_scoped_release released;
    recording->samples.reserve(rows);
    for (std::size_t k = 0; k < rows; ++k) {
      drive_.current_mA = one[k];
      if (two != nullptr) drive_.opposite.current_mA = two[k];
      ride_.hold(drive_, time_after(1));
      recording->take(ride::sample_of(ride_.rider(), counts_));
      ride_.advance();
      ++ticks_;
      look();
    }
    recording->solver = ride_.counters();
  }
  return {recording, plant::channels_of(rig_, recording->driven), "ride"};
}

Ride::Saved Ride::save() const {
  const Turn turn(busy_);
  return {ride_.save(), counter_, drive_, begin_s_, ticks_, counts_};
}

void Ride::restore(const Saved& saved) {
  const Turn turn(busy_);
  ride_.restore(saved.ride);
  counter_ = saved.counter;
  drive_ = saved.drive;
  begin_s_ = saved.begin_s;
  ticks_ = saved.ticks;
  counts_ = saved.counts;
}

engine::Linear Ride::linearise() const {
  const Turn turn(busy_);
  return engine::linearise(ride_.plant(), ride_.flow(), ride_.rider().now.held,
                           {drive_.current_mA, drive_.opposite.current_mA});
}

Shown Ride::shown() const {
  const double rise_m = static_cast<double>(counts_) * plant::count_height_m(rig_);
  const bool pair = rig_.pair() != nullptr;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const ride::Reading& reading = ride_.reading();
  const plant::Sensor* const gauge = rig_.sensors.of(plant::Sensed::muscle_pressure);
  return {ride_.time_s(),
          pair ? none : rise_m / rig_.muscle.rest_length_m,
          pair ? rise_m / rig_.joint.wheel_radius_m : none,
          plant::shown(gauge, reading.muscle_pressure_Pa),
          pair ? plant::shown(gauge, reading.opposite_pressure_Pa) : none,
          counts_};
}

void Ride::take(const Given& given) {
  const auto put = [](const std::optional<double>& value, const char* name, auto& into) {
    if (value) into = finite(*value, name);
  };
  if (!pair() && (given.opposite_command.value_or(0.0) != 0.0 || given.opposite_muscle_pressure_Pa))
    throw py::value_error("the rig has one muscle; there is no opposite one");
  // A valve that has a command again keeps no pressure.
  if (given.command) drive_.muscle_pressure_Pa.reset();
  if (given.opposite_command) drive_.opposite.muscle_pressure_Pa.reset();
  put(given.command, "command", drive_.current_mA);
  put(given.opposite_command, "opposite_command", drive_.opposite.current_mA);
  put(given.muscle_pressure_Pa, "muscle_pressure_Pa", drive_.muscle_pressure_Pa);
  put(given.opposite_muscle_pressure_Pa, "opposite_muscle_pressure_Pa", drive_.opposite.muscle_pressure_Pa);
  put(given.contraction_ratio, "contraction_ratio", drive_.contraction_ratio);
}

void Ride::advance() {
  ride_.step(drive_, time_after(1));
  ++ticks_;
  look();
}

}  // namespace mckibben::python
