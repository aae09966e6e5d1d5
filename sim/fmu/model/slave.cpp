// Steps of an instance; see the header. The order of an instant is the ride's.
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/domain/outer_force.hpp>
#include <sim/domain/rig_number.hpp>
#include <sim/engine/failure.hpp>
#include <sim/fmu/model/slave.hpp>
#include <sim/ride/bytes.hpp>
#include <sim/ride/sample.hpp>

namespace mckibben::fmu {
namespace {

[[noreturn]] void unknown(Reference reference) {
  throw std::runtime_error("there is no variable with value reference " + std::to_string(reference));
}

}  // namespace

Slave::Slave(plant::Rig rig)
    : rig_(std::move(rig)),
      paths_(parameter_paths(rig_)),
      channels_(channels_of(rig_)),
      current_mA_(rig_.valve.zero_command),
      length_m_(rig_.muscle.rest_length_m) {
  if (const plant::Pair* pair = rig_.pair()) opposite_current_mA_ = pair->opposite.valve.zero_command;
  if (rig_.lifts_a_load()) load_kg_ = domain::usual_load_kg(rig_);
}

void Slave::set(Reference reference, double value) {
  if (mode_ > Mode::stepping) throw std::runtime_error("nothing is set after a failure or the end");
  const bool steps = mode_ == Mode::stepping;
  if (!steps) ride_.reset();  // what has been shown of it is no longer so
  if (!std::isfinite(value)) throw std::runtime_error("a value is no finite number");
  if (reference == current) {
    current_mA_ = value;
  } else if (reference == opposite_current && rig_.pair() != nullptr) {
    opposite_current_mA_ = value;
  } else if (reference == length && rig_.holds_a_length()) {
    length_m_ = value;
  } else if (reference == outside && !rig_.holds_a_length()) {
    outside_ = value;
  } else if (reference == load && rig_.lifts_a_load()) {
    if (steps) require_hanging(value);  // before, parameters may still change the rig
    load_kg_ = value;
  } else if (reference >= first_parameter && reference - first_parameter < paths_.size()) {
    const std::string& path = paths_[reference - first_parameter];
    const domain::RigNumber number = domain::find_number(rig_, path);
    if (steps) throw std::runtime_error(path + ": parameters are set before the start");
    if (value < number.lowest || value > number.highest)
      throw std::runtime_error(fmt::format("{} = {:g} is outside its range, {:g} to {:g}", path, value,
                                           number.lowest, number.highest));
    *number.value = value;
  } else {
    throw std::runtime_error("value reference " + std::to_string(reference) + " cannot be set");
  }
}

/// By the rule for the loads of files.
void Slave::require_hanging(double load_kg) const {
  if (!rig_.lifts_a_load()) return;
  const std::string why =
      rig_.can_hang(load_kg) ? domain::too_heavy(load_kg, rig_) : "there must be some mass";
  if (!why.empty()) throw std::runtime_error(fmt::format("load = {:g} kg: {}", load_kg, why));
}

ride::Drive Slave::drive() const {
  ride::Drive now;
  now.current_mA = plant::dac_output_mA(rig_.dac, current_mA_);
  now.opposite.current_mA = plant::dac_output_mA(rig_.dac, opposite_current_mA_);
  now.joint_force_N = rig_.has_angle() ? domain::as_force_N(outside_, rig_.joint.wheel_radius_m) : outside_;
  if (rig_.holds_a_length()) {
    now.contraction_ratio = 1.0 - length_m_ / rig_.muscle.rest_length_m;
    if (!plant::Braid(rig_.muscle).in_domain(*now.contraction_ratio))
      throw std::runtime_error(fmt::format("length = {:g} m is none that this muscle can have", length_m_));
  }
  return now;
}

void Slave::set_up(double start_s) {
  if (mode_ > Mode::set_up) throw std::runtime_error("the experiment is set up before the initialisation");
  if (!std::isfinite(start_s)) throw std::runtime_error("the start time is no finite number");
  mode_ = Mode::set_up;
  time_s_ = start_s;
}

void Slave::initialise() {
  if (mode_ != Mode::set_up)
    throw std::runtime_error("an initialisation follows the set-up of the experiment, once");
  mode_ = Mode::initialising;
}

void Slave::set_off() {
  if (mode_ != Mode::initialising) throw std::runtime_error("it is not being initialised");
  mode_ = Mode::failed;
  if (!ride_) settle();
  mode_ = Mode::stepping;
}

void Slave::terminate() {
  if (mode_ != Mode::stepping && mode_ != Mode::failed) throw std::runtime_error("it is not under way");
  mode_ = Mode::terminated;
}

void Slave::make_ride() {
  ride_.emplace(ride::Loaded{rig_, hanging_kg_}, rig_.integrator);
  counter_.emplace(rig_);
}

void Slave::settle() {
  if (const std::string broken = domain::broken_rule(rig_); !broken.empty()) throw std::runtime_error(broken);
  require_hanging(load_kg_);
  const ride::Drive at_first = ride::settling(drive(), rig_);
  hanging_kg_ = load_kg_;
  make_ride();
  const auto ticks = std::lround(rig_.settling_time_s / rig_.tick_s);
  const auto before_s = [&](long k) { return time_s_ - static_cast<double>(k) * rig_.tick_s; };
  try {
    ride_->start(at_first, before_s(ticks));
    for (long k = ticks; k > 0; --k) {
      ride_->step(at_first, before_s(k - 1));
      look();
    }
  } catch (...) {
    ride_.reset();  // nobody is shown where it came to
    throw;
  }
  look();
}

void Slave::step(double from_s, double length_s) {
  if (mode_ != Mode::stepping || !ride_)
    throw std::runtime_error("a step before the initialisation has ended, or after a failure or the end");
  if (std::abs(from_s - time_s_) > 1e-9 * std::max(1.0, std::abs(time_s_)))
    throw std::runtime_error("a step from another time than the last one reached");
  if (!(length_s > 0.0)) throw std::runtime_error("a step must have a length");
  if (load_kg_ != hanging_kg_) hang(load_kg_);
  const double until_s = from_s + length_s;
  const ride::Drive now = drive();
  try {
    ride_->step(now, until_s);
    time_s_ = until_s;
  } catch (const engine::NumericalFailure&) {
    mode_ = Mode::failed;
    time_s_ = ride_->time_s();
    look();
    throw;
  }
  look();
}

/// Another mass from here on, at the speed that the last one had.
void Slave::hang(double load_kg) {
  ride::Rider rider(ride::Loaded{rig_, load_kg});
  rider.now = ride_->rider().now;
  ride_.emplace(rider, ride_->save().pace, rig_.integrator);
  hanging_kg_ = load_kg;
}

template <class Self, class Visitor>
void Slave::members(Self& self, Visitor& visit) {
  visit(self.current_mA_, self.opposite_current_mA_, self.length_m_, self.outside_, self.load_kg_,
        self.hanging_kg_, self.time_s_, self.mode_, self.counts_);
}

std::string Slave::bytes(const std::string& token) const {
  ride::BytesWriter write;
  write(token);
  members(*this, write);
  plant::Rig rig = rig_;
  for (const std::string& path : paths_) write(*domain::find_number(rig, path).value);
  write(ride_.has_value());
  if (ride_) {
    const ride::Ride::Saved saved = ride_->save();
    write(saved.rider, saved.pace, *counter_);
  }
  return write.closed();
}

void Slave::become(std::string_view bytes, const std::string& token) {
  ride::BytesReader read(bytes);
  std::string of;
  read(of);
  if (of != token) throw std::runtime_error("these bytes are of a state of another FMU");
  members(*this, read);
  for (const std::string& path : paths_) read(*domain::find_number(rig_, path).value);
  bool rides = false;
  read(rides);
  ride_.reset();
  sample_.reset();
  if (rides) {
    make_ride();
    ride::Ride::Saved saved;
    read(saved.rider, saved.pace, *counter_);
    ride_->restore(saved);
  }
  read.end();
}

void Slave::look() {
  counts_ = counter_->count(ride_->reading().wheel_m);
  sample_.reset();
}

double Slave::get(Reference reference) {
  switch (reference) {
    case time_of_ride:
      return time_s_;
    case current:
      return current_mA_;
    case opposite_current:
      return opposite_current_mA_;
    case load:
      return load_kg_;
    case length:
      return length_m_;
    case outside:
      return outside_;
    default:
      break;
  }
  if (reference >= first_parameter && reference - first_parameter < paths_.size())
    return *domain::find_number(rig_, paths_[reference - first_parameter]).value;
  if (mode_ < Mode::initialising || (mode_ > Mode::stepping && !ride_))
    throw std::runtime_error("outputs are there once it is being initialised, and has not failed then");
  if (!ride_) settle();
  if (reference < first_output || reference - first_output >= channels_.size()) unknown(reference);
  if (!sample_) sample_ = ride::sample_of(ride_->rider(), counts_);
  return channels_[reference - first_output].value(*sample_);
}

}  // namespace mckibben::fmu
