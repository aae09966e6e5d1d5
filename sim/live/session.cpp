// The order of a tick is that of a simulated run (sim/run/simulate.cpp); see the header.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <controllers/waveform.hpp>
#include <plant/command.hpp>
#include <plant/geometry.hpp>
#include <sim/domain/rig_number.hpp>
#include <sim/engine/failure.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/live/session.hpp>
#include <sim/ride/changed.hpp>
#include <sim/ride/sample.hpp>
#include <sim/run/follow.hpp>

namespace mckibben::live {
namespace {

constexpr double shortest_period_s = 0.1, longest_period_s = 1000.0;

ride::Ride ride_of(const plant::Rig& rig, double load_kg) {
  return {ride::Loaded{rig, load_kg}, rig.integrator};
}

}  // namespace

double Sweep::at(double time_s) const {
  const double dwell_s = period_s / (2 * stairs_up);
  switch (shape) {
    case Shape::sine:
      return controllers::SineCurrent{.low_mA = low_mA, .high_mA = high_mA, .period_s = period_s}.at(time_s);
    case Shape::triangle:
      return controllers::TriangleCurrent{.low_mA = low_mA, .high_mA = high_mA, .period_s = period_s}.at(
          time_s);
    case Shape::stairs:
      break;
  }
  return controllers::StairCurrent{
      .low_mA = low_mA, .high_mA = high_mA, .steps = stairs_up, .dwell_s = dwell_s}
      .at(std::fmod(time_s, period_s));
}

double Sweep::when(double current_mA) const {
  const double share = std::clamp((current_mA - low_mA) / (high_mA - low_mA), 0.0, 1.0);
  switch (shape) {
    case Shape::sine:
      return period_s * std::acos(1.0 - 2.0 * share) / (2.0 * std::numbers::pi);
    case Shape::triangle:
      return 0.5 * share * period_s;
    case Shape::stairs:
      break;
  }
  return 0.0;
}

Session::Session(const plant::Rig& rig, double load_kg)
    : switches_(rig),
      rig_(switches_.rig()),
      load_kg_(load_kg),
      commands_{rig.valve.zero_command,
                rig.pair() != nullptr ? rig.pair()->opposite.valve.zero_command : 0.0},
      reader_(rig),
      ride_(ride_of(rig_, load_kg)) {
  start_over();
}

template <class Work>
void Session::guarded(const Work& work) {
  try {
    work();
  } catch (const engine::NumericalFailure& gave_up) {
    failure_ = gave_up.what();
  }
}

std::string Session::out_of_dac(const char* of_current, double command) const {
  return out_of_range(plant::in_unit(rig_.command_unit(), of_current), command, rig_.dac.lowest_command,
                      rig_.dac.largest_command, name_of(rig_.command_unit()));
}

std::string Session::set_command(double command, std::int64_t muscle) {
  std::string why = out_of_dac("current", command);
  if (why.empty() && muscle != 1 && !(pair() && muscle == 2))
    why = fmt::format("muscle = {}: there is none of that number", muscle);
  if (!why.empty()) return why;
  sweep_.reset();
  commands_[muscle == 1 ? 0 : 1] = command;
  return "";
}

std::string Session::set_sweep(const Sweep& sweep) {
  std::string why = out_of_dac("lowest current", sweep.low_mA);
  if (why.empty()) why = out_of_dac("highest current", sweep.high_mA);
  if (why.empty()) why = out_of_range("period", sweep.period_s, shortest_period_s, longest_period_s, "s");
  if (why.empty() && !(sweep.high_mA > sweep.low_mA))
    why = plant::in_unit(rig_.command_unit(),
                         fmt::format("highest current = {:g} mA: must be above the lowest, which is {:g} mA",
                                     sweep.high_mA, sweep.low_mA));
  if (!why.empty()) return why;
  sweep_ = sweep;
  sweep_begin_s_ = time_s() - sweep.when(commands_[0]);
  return "";
}

Session::Loads Session::loads() const {
  const double none_kg = rig_.pulled_kg(0.0), each = rig_.pulled_kg(1.0) - none_kg;
  const double most_kg = (plant::Braid(rig_.muscle).largest_load_kg() - none_kg) / each;
  const double digit = std::pow(10.0, std::floor(std::log10(most_kg)) - 2.0);
  return {std::max(0.0, -rig_.joint.load_offset_kg), std::min(500.0, std::floor(most_kg / digit) * digit)};
}

std::string Session::set_load(double load_kg) {
  if (pair()) return "load: two muscles turn a link; none hangs there";
  const auto [least_kg, most_kg] = loads();
  std::string why = out_of_range("load", load_kg, least_kg, most_kg, "kg");
  if (const std::string heavy = domain::too_heavy(load_kg, rig_); !why.empty() && !heavy.empty())
    why += "; " + heavy;
  if (why.empty() && !rig_.can_hang(load_kg))
    why = fmt::format("load = {:g} kg: {}", load_kg, input::no_mass(rig_));
  if (!why.empty()) return why;
  load_kg_ = load_kg;
  go_on();
  return "";
}

std::string Session::set_effect(std::string_view name, bool on, double size, double shape) {
  if (std::string why = switches_.set(name, on, size, shape); !why.empty()) return why;
  go_on();
  return "";
}

std::string Session::hide_effect(std::string_view name, double size, double shape) {
  if (std::string why = switches_.hide(name, size, shape); !why.empty()) return why;
  go_on();
  return "";
}

void Session::go_on() {
  untouched_ = false;
  rig_ = switches_.rig();
  guarded([&] {
    ride_ = ride::Ride(ride::changed(ride_.rider(), {rig_, load_kg_}), {}, rig_.integrator);
    measure();
  });
}

void Session::start_over() {
  failure_.clear();
  tick_ = 0;
  sweep_begin_s_ = 0.0;
  untouched_ = true;
  reader_ = plant::PositionReader(rig_);
  ride_ = ride_of(rig_, load_kg_);
  sample_ = {};
  drive_ = {};
  hold(wanted_at(0.0));
  guarded([&] {
    const auto ticks = std::lround(rig_.settling_time_s / rig_.tick_s);
    const ride::Drive settling = ride::settling(drive_, rig_);
    ride_.start(settling, static_cast<double>(-ticks) * rig_.tick_s);
    for (auto k = -ticks + 1; k <= 0; ++k) {
      ride_.step(settling, static_cast<double>(k) * rig_.tick_s);
      sample_.counts = reader_.count(ride_.reading().wheel_m);
    }
  });
  measure();
}

Session::Commands Session::wanted_at(double time_s) const {
  if (!sweep_) return commands_;
  const double first_mA = sweep_->at(time_s - sweep_begin_s_);
  return {first_mA, pair() ? sweep_->low_mA + sweep_->high_mA - first_mA : 0.0};
}

void Session::hold(const Commands& wanted) {
  drive_.current_mA = plant::dac_output_mA(rig_.dac, wanted[0]);
  if (pair()) drive_.opposite.current_mA = plant::dac_output_mA(rig_.dac, wanted[1]);
}

/// Of the instant it is at.
void Session::measure() {
  sample_ = ride::sample_of(ride_.rider(), sample_.counts);
  sample_.time_s = time_s();
}

const Sample& Session::step() {
  if (!failure_.empty()) return sample_;
  if (tick_ > 0) {  // the first one is under what it has settled under, so that a recording begins at rest
    commands_ = wanted_at(time_s());
    const Commands before{drive_.current_mA, drive_.opposite.current_mA};
    hold(commands_);
    if (before != Commands{drive_.current_mA, drive_.opposite.current_mA}) untouched_ = false;
  }
  guarded([&] {
    sample_.counts = reader_.count(ride_.reading().wheel_m);
    ride_.hold(drive_, static_cast<double>(tick_ + 1) * rig_.tick_s);
    measure();
    ride_.advance();
    ++tick_;
  });
  return sample_;
}

}  // namespace mckibben::live
