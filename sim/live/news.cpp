// Names, units and numbers; see the header.
#include <cmath>

#include <fmt/format.h>

#include <sim/input/fields_json.hpp>
#include <sim/live/page.hpp>
#include <sim/output/diagnosis_words.hpp>

namespace mckibben::live {
namespace {

/// Numbers of the page; what is none is null.
void append(std::string& text, double value, int digits) {
  text += std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "null";
}

}  // namespace

std::vector<plant::Channel> channels_of(const plant::Rig& rig) {
  return plant::channels_of(rig, {.pair = rig.pair() != nullptr});
}

input::Json signals_json(const plant::Rig& rig) {
  input::Json list = input::Json::array();
  for (const plant::Channel& channel : channels_of(rig))
    list.push_back({{"key", channel.key()}, {"unit", channel.page_unit()}});
  return list;
}

void append(std::string& text, const std::vector<plant::Channel>& channels, const Sample& sample) {
  text += '[';
  for (const plant::Channel& channel : channels) {
    if (&channel != &channels.front()) text += ',';
    append(text, channel.on_page(sample), channel.signal->kind == plant::Kind::time ? 10 : 7);
  }
  text += ']';
}

input::Json effect_json(const Switch& one) {
  input::Json json{{"name", one.name},
                   {"on", one.on},
                   {"size", one.size.value},
                   {"says", output::readable(one.size.value, one.size.unit)}};
  if (one.has_shape()) {
    json["shape"] = one.shape.value;
    json["shape_says"] = output::readable(one.shape.value, one.shape.unit);
  }
  return json;
}

input::Json sweep_json(const Sweep& sweep) {
  const char* shape = sweep.shape == Sweep::Shape::sine       ? "sine"
                      : sweep.shape == Sweep::Shape::triangle ? "triangle"
                                                              : "stairs";
  return {{"shape", shape}, {"low", sweep.low_mA}, {"high", sweep.high_mA}, {"period", sweep.period_s}};
}

}  // namespace mckibben::live
