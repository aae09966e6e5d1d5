// Names, and which signals a rig has; see the header.
#include <algorithm>
#include <iterator>
#include <stdexcept>

#include <plant/signals.hpp>

namespace mckibben::plant {
namespace {

bool has_angle(const Rig& rig, const Driven& driven) {
  return driven.pair || rig.lever() != nullptr;
}

bool exists(const Channel& channel, const Rig& rig, const Driven& driven) {
  const Needs needs = channel.signal->needs;
  if (rig.valve.seals() && (needs == Needs::command || needs == Needs::valve)) return false;
  switch (needs) {
    case Needs::height:
      return !has_angle(rig, driven);
    case Needs::one_muscle:
      return !driven.pair;
    case Needs::angle:
      return has_angle(rig, driven);
    case Needs::pair:
      return driven.pair;
    case Needs::command:
      return driven.pressure[channel.muscle == 2 ? 1 : 0] == GivenPressure::none &&
             (channel.signal->of_commands_in ? *channel.signal->of_commands_in == rig.command_unit()
                                             : !rig.valve.is_on_off());  // a pressure is asked of it
    case Needs::valve:
      return driven.pressure[channel.muscle == 2 ? 1 : 0] != GivenPressure::muscle;
    case Needs::tank:
      return !rig.effects.get<SupplyDroop>().absent() && !rig.valve.seals() &&
             driven.pressure[0] == GivenPressure::none;
    case Needs::given_supply:
      return driven.supply;
    case Needs::cord: {
      const Pair* pair = channel.muscle == 2 ? rig.pair() : nullptr;
      const Muscle& muscle = pair != nullptr ? pair->opposite.muscle : rig.muscle;
      const bool has_it_already = driven.pair && channel.signal->part == Part::joint;
      return !muscle.cord.absent() && !has_it_already;
    }
    case Needs::outer_force:
      return driven.joint_force && !has_angle(rig, driven);
    case Needs::outer_torque:
      return driven.joint_force && has_angle(rig, driven);
    case Needs::sensor:
      return exists({&signal_of(channel.signal->reads), channel.muscle}, rig, driven) &&
             std::any_of(rig.sensors.begin(), rig.sensors.end(), [&](const Sensor& sensor) {
               return name_of(sensor.signal) == channel.signal->reads;
             });
    case Needs::nothing:
      break;
  }
  return true;
}

std::string numbered(std::string_view key, std::size_t muscle) {
  return muscle == 0 ? std::string(key) : std::string(key) + "_" + std::to_string(muscle);
}

std::string name_of(const Signal& signal, std::size_t muscle) {
  std::string name = numbered(muscle == 0 ? signal.key : signal.of_two, muscle);
  if (!signal.unit.ending.empty()) name.append("_").append(signal.unit.ending);
  return name;
}

std::string of_muscle(std::string words, std::size_t muscle) {
  if (muscle == 0) return words;
  constexpr std::string_view whole = "the muscle";
  const std::string one = "muscle " + std::to_string(muscle);
  const auto at = words.find(whole);
  return at == std::string::npos ? words += " of " + one : words.replace(at, whole.size(), one);
}

}  // namespace

std::string Channel::key() const {
  return numbered(muscle == 0 ? signal->key : signal->of_two, muscle);
}

std::string Channel::key_in_dataset() const {
  const bool own_name = muscle != 0 && signal->of_two != signal->key;
  return numbered(own_name ? signal->of_two : signal->in_dataset, muscle);
}

std::string Channel::name() const {
  return name_of(*signal, muscle);
}

std::string Channel::name_in_dataset() const {
  return name_of(signal->reads.empty() ? *signal : signal_of(signal->reads), muscle);
}

std::string Channel::words_in_dataset() const {
  return of_muscle(std::string(signal->dataset_words.empty() ? signal->words : signal->dataset_words),
                   muscle);
}

std::string Channel::words() const {
  std::string words = of_muscle(std::string(signal->words), muscle);
  if (signal->kind == Kind::state) words += ", true";
  if (signal->kind == Kind::input) words += ", from this row to the next";
  return words;
}

std::vector<Channel> channels_of(const Rig& rig, const Driven& driven) {
  std::vector<Channel> all;
  for (auto first = signals.begin(); first != signals.end();) {
    const auto last = std::find_if(first, signals.end(), [](const Signal& s) { return !s.with_next; }) + 1;
    const bool of_each = driven.pair && first->part == Part::muscle;
    for (std::size_t muscle = of_each ? 1 : 0; muscle <= (of_each ? 2 : 0); ++muscle)
      for (auto signal = first; signal != last; ++signal)
        if (const Channel channel{&*signal, muscle}; exists(channel, rig, driven)) all.push_back(channel);
    first = last;
  }
  return all;
}

std::vector<Channel> recorded_channels(const Rig& rig, const Driven& driven) {
  std::vector<Channel> all = channels_of(rig, driven);
  const bool force = driven.pair || driven.length || driven.force;
  std::erase_if(all, [&](const Channel& channel) {
    const InFiles in_files = channel.signal->in_files;
    const Pair* pair = channel.muscle == 2 ? rig.pair() : nullptr;
    const Effects& effects = pair != nullptr ? pair->opposite.effects : rig.effects;
    return in_files == InFiles::no || (in_files == InFiles::measured_force && !force) ||
           (in_files == InFiles::with_effects && effects.absent());
  });
  return all;
}

std::vector<Channel> measured_channels(const Rig& rig, const Driven& driven) {
  std::vector<Channel> all = recorded_channels(rig, driven);
  std::erase_if(all, [](const Channel& channel) { return channel.signal->kind == Kind::state; });
  return all;
}

const Signal& signal_of(std::string_view key) {
  for (const Signal& signal : signals)
    if (signal.key == key) return signal;
  throw std::invalid_argument("there is no signal " + std::string(key));
}

const Signal& command_of(CommandUnit unit) {
  return *std::find_if(signals.begin(), signals.end(),
                       [&](const Signal& signal) { return signal.of_commands_in == unit; });
}

const Channel& channel_of(const std::vector<Channel>& channels, std::string_view key) {
  for (const Channel& channel : channels)
    if (channel.key() == key) return channel;
  throw std::invalid_argument("there is no signal " + std::string(key));
}

}  // namespace mckibben::plant
