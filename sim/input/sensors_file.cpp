// Elements of the list, and old keys; see the header.
#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <sim/input/sensors_file.hpp>
#include <sim/input/suggest.hpp>

namespace mckibben::input {
namespace {

using plant::Sensed, plant::Sensor, plant::SensorKind, plant::Sensors;

constexpr auto kinds_or_none = [] {
  constexpr auto kinds = names(SensorKind{});
  std::array<std::string_view, kinds.size() + 1> all{};
  for (std::size_t i = 0; i < kinds.size(); ++i) all[i] = kinds[i].second;
  all.back() = no_sensor;
  return all;
}();

std::string kinds_that_read(Sensed signal) {
  std::vector<std::string_view> list;
  for (const plant::SensorSheet& sheet : plant::sensor_kinds)
    if (may_read(sheet.kind, signal)) list.push_back(name_of(sheet.kind));
  return join(list);
}

/// One sensor's map.
class Element : public StructReader {
 public:
  using StructReader::StructReader;

  void read(Sensors& into, std::vector<Sensed>& named, const ReadContext& context) {
    if (!is_map()) return;
    Sensor sensor;
    required("signal", sensor.signal, "what it reads");
    require("kind", "how it reads, or none");
    const Node* said = take("kind");
    const auto kind = said == nullptr ? std::nullopt : choice("kind", *said, kinds_or_none);
    if (!kind || !clean()) return;
    if (std::ranges::find(named, sensor.signal) != named.end())
      return broken_rule("signal", "another sensor of the list reads it, too");
    named.push_back(sensor.signal);
    if (kinds_or_none[*kind] == no_sensor) {
      check_unknown({});
      if (sensor.signal == Sensed::contraction)
        return broken_rule("kind", "every rig has a sensor of contraction, which controllers read");
      return into.remove(sensor.signal);
    }
    sensor.kind = names(SensorKind{})[*kind].first;
    if (!may_read(sensor.kind, sensor.signal))
      return broken_rule("kind", fmt::format("does not read {}; what does: {}", name_of(sensor.signal),
                                             kinds_that_read(sensor.signal)));
    if (const Sensor* before = into.of(sensor.signal); before != nullptr && before->kind == sensor.kind)
      sensor = *before;
    numbers(sensor, context);
    into.put(sensor);
  }

  void read(const OldSensorKey& old, Sensors& into, const ReadContext& context) {
    if (!is_map()) return;
    const Sensor* before = into.of(old.signal);
    Sensor sensor = before != nullptr ? *before : Sensor{.signal = old.signal, .kind = old.kind};
    bool fitted = before != nullptr;
    SensorKind kind = sensor.kind;
    if (old.signal != Sensed::contraction) {
      (*this)("fitted", fitted, "");
    } else if (old.key == "sensor") {
      required("kind", kind, "");
      if (!clean()) return;
      if (!may_read(kind, old.signal))
        return broken_rule("kind", "does not read the position; what does: " + kinds_that_read(old.signal));
    }
    sensor.kind = old.key == "encoder" ? SensorKind::encoder : kind;
    numbers(sensor, context);
    sensor.kind = kind;  // of an encoder that another sensor stands in for, the disk is kept
    if (fitted)
      into.put(sensor);
    else
      into.remove(old.signal);
  }

 private:
  void numbers(Sensor& sensor, const ReadContext& context) {
    context_ = context.below(name_of(sensor.signal));
    Sensor::fields(sensor, *this);
    check_unknown({});
    const auto report = [this](std::string_view key, std::string_view message) { broken_rule(key, message); };
    if (clean()) sensor.rules(report);
    if (clean() && sensor.counts_pulses()) own_gearing(sensor.wheel_ratio);
  }

  /// Another encoder hardly has the gearing of the base's.
  void own_gearing(double wheel_ratio) {
    const Node* pulses = map_.find("pulses_per_turn");
    if (pulses == nullptr || map_.find("wheel_ratio") != nullptr || wheel_ratio == 1.0) return;
    problems_.warning(
        source_, pulses->place,
        fmt::format("pulses_per_turn = {} without wheel_ratio: the base's {:g} turns of the disk "
                    "for one of the joint stay; write wheel_ratio: 1 if there is no gearing",
                    pulses->text, wheel_ratio));
  }
};

bool lists(const Node& map, Sensed signal) {
  const Node* list = map.find("sensors");
  return list != nullptr && std::ranges::any_of(list->children, [&](const Node& one) {
           const Node* said = one.find("signal");
           return said != nullptr && said->text == name_of(signal);
         });
}

/// An old key as an element of the list.
std::string element(const OldSensorKey& old, const Node& node) {
  const Node *kind = node.find("kind"), *fitted = node.find("fitted");
  std::string_view as = kind != nullptr ? std::string_view(kind->text) : name_of(old.kind);
  if (fitted != nullptr && fitted->text == "false") as = no_sensor;
  std::string text = fmt::format("{{signal: {}, kind: {}", name_of(old.signal), as);
  for (const Node& child : node.children)
    if (&child != kind && &child != fitted && as != no_sensor)
      text += fmt::format(", {}: {}", child.key, child.text);
  return text + "}";
}

}  // namespace

void read_sensors(const Source& source, const Node& node, Sensors& into, Problems& problems,
                  const ReadContext& context) {
  std::vector<Sensed> named;
  for (const Node& one : node.children) Element(source, one, problems).read(into, named, context);
}

void read_old_sensors(const Source& source, const Node& map, Sensors& into, Problems& problems,
                      const ReadContext& context) {
  for (const OldSensorKey& old : old_sensor_keys) {
    const Node* node = map.find(old.key);
    if (node == nullptr) continue;
    if (lists(map, old.signal))
      problems.error(source, node->key_place,
                     fmt::format("{}: the list sensors has one of {}, too; write only that", old.key,
                                 name_of(old.signal)));
    else
      Element(source, *node, problems).read(old, into, context);
  }
}

std::string in_place_of_old_sensors(const Node& map) {
  std::string list;
  const auto is_other = [](const Node* sensor) {
    const Node* kind = sensor == nullptr ? nullptr : sensor->find("kind");
    return kind != nullptr && kind->text != name_of(SensorKind::encoder);
  };
  for (const OldSensorKey& old : old_sensor_keys) {
    const Node* node = map.find(old.key);
    if (node == nullptr || node->kind != Node::Kind::map) continue;
    const bool unused = old.key == "encoder" && is_other(map.find("sensor"));
    if (!unused) list += (list.empty() ? "" : ", ") + element(old, *node);
  }
  return list.empty() ? "" : "sensors: [" + list + "]";
}

}  // namespace mckibben::input
