// Units of the page are bar, mA, N, deg; see the header.
#include <array>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include <sim/input/fields_json.hpp>
#include <sim/live/news.hpp>
#include <sim/output/diagnosis_words.hpp>

namespace mckibben::live {
namespace {

/// Numbers of the page; what is none is null.
void append(std::string& text, double value, int digits) {
  text += std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "null";
}

/// The order of what follows is that of `columns` in scroll.js.
std::array<double, 9> shown(const Sample& s) {
  return {s.current_mA,
          s.reference_Pa / plant::Pa_per_bar,
          s.valve_Pa / plant::Pa_per_bar,
          s.muscle_Pa / plant::Pa_per_bar,
          s.contraction_ratio,
          s.read,
          s.braid_N,
          s.friction_N,
          s.effects_N};
}
std::array<double, 15> shown_of_pair(const Sample& s) {
  const SideSample& other = s.opposite;
  return {s.current_mA,
          other.current_mA,
          s.reference_Pa / plant::Pa_per_bar,
          other.reference_Pa / plant::Pa_per_bar,
          s.muscle_Pa / plant::Pa_per_bar,
          other.muscle_Pa / plant::Pa_per_bar,
          s.contraction_ratio,
          other.contraction_ratio,
          s.cord_N,
          other.cord_N,
          s.angle_rad / plant::degree_rad,
          s.read / plant::degree_rad,
          (s.reference_Pa - other.reference_Pa) / plant::Pa_per_bar,
          (s.muscle_Pa - other.muscle_Pa) / plant::Pa_per_bar,
          s.cord_N - other.cord_N};
}

void append_row(std::string& text, double time_s, std::span<const double> values) {
  text += '[';
  append(text, time_s, 10);
  for (const double value : values) {
    text += ',';
    append(text, value, 7);
  }
  text += ']';
}

}  // namespace

void append(std::string& text, const Sample& sample, bool of_pair) {
  if (of_pair)
    append_row(text, sample.time_s, shown_of_pair(sample));
  else
    append_row(text, sample.time_s, shown(sample));
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
