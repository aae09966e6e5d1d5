// Parameters by path; see the header.
#include <cmath>
#include <stdexcept>

#include <sim/diagnose/parameter.hpp>

namespace mckibben::diagnose {

std::string_view of_muscle_1(std::string_view path) {
  return path.starts_with(of_muscle_2) ? path.substr(of_muscle_2.size()) : path;
}

std::string keys_of(const EffectName& who) {
  return std::string(who.side == Side::two ? of_muscle_2 : "")
      .append("effects.")
      .append(who.effect)
      .append(".");
}

Found find(Rig& rig, std::string_view path) {
  Found found = domain::find_number(rig, path);
  if (found.value == nullptr) throw std::invalid_argument("no parameter " + std::string(path));
  return found;
}

double value_of(const Rig& rig, std::string_view path) {
  Rig copy = rig;
  return *find(copy, path).value;
}

void Parameter::put(Rig& rig, double value) const {
  *find(rig, path).value = value;
  if (both_sides) *find(rig, std::string(of_muscle_2) + path).value = value;
}
double Parameter::unscaled(double number) const {
  return logarithmic ? origin * std::exp(number * scale) : origin + number * scale;
}
double Parameter::scaled(double value) const {
  return logarithmic ? std::log(value / origin) / scale : (value - origin) / scale;
}

}  // namespace mckibben::diagnose
