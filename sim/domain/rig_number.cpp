// The field lists of the plant, walked with the path as a guide; see the header.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <iomanip>
#include <limits>
#include <sstream>
#include <utility>

#include <plant/geometry.hpp>
#include <sim/domain/number.hpp>
#include <sim/domain/renamed.hpp>
#include <sim/domain/rig_number.hpp>

namespace mckibben::domain {
namespace {

/// Elements of a list go by their place, sensors by what they read.
std::string key_in(const auto&, std::size_t place) {
  return std::to_string(place);
}
std::string key_in(const plant::Sensors& sensors, std::size_t place) {
  return std::string(plant::name_of(sensors[place].signal));
}

/// The visitor of a field list that goes into structs and lists of structs.
template <class Own>
class Walker {
 public:
  template <class T, class... Rest>
  void operator()(std::string_view key, T& value, const Rest&... rest) {
    if constexpr (std::same_as<std::remove_const_t<T>, double>) {
      own().number(key, value, rest...);
    } else if constexpr (requires { T::fields(value, own()); }) {
      own().enter(key, value, [&] { T::fields(value, own()); });
    } else if constexpr (requires { T::value_type::fields(value.front(), own()); }) {
      own().enter(key, value, [&] {
        for (std::size_t i = 0; i < value.size(); ++i)
          own().enter(key_in(value, i), value[i], [&] { T::value_type::fields(value[i], own()); });
      });
    }
  }
  void required(std::string_view key, auto& value, const auto&... rest) { (*this)(key, value, rest...); }

 private:
  Own& own() { return static_cast<Own&>(*this); }
};

class Guide : public Walker<Guide> {
 public:
  Guide(std::string_view path, plant::CommandUnit commands) : rest_(path), commands_(commands) {}

  void number(std::string_view key, double& value, std::string_view unit, double lowest, double highest,
              std::string_view meaning) {
    if (key != name_today(rest_)) return;
    const auto [least, most] = in_unit(commands_, unit, plant::Limits{lowest, highest});
    found = {&value, in_unit(commands_, unit), least, most, std::string(meaning)};
  }
  // Goes on inside `key` if the path leads there.
  void enter(std::string_view key, const auto&, const auto& inside) {
    if (rest_.size() <= key.size() || !rest_.starts_with(key) || rest_[key.size()] != '.') return;
    const std::string_view whole = rest_;
    rest_.remove_prefix(key.size() + 1);
    inside();
    rest_ = whole;
  }

  RigNumber found;

 private:
  std::string_view rest_;
  plant::CommandUnit commands_;
};

class PathLister : public Walker<PathLister> {
 public:
  void number(std::string_view key, const auto&...) { list.push_back(prefix_ + std::string(key)); }
  void enter(std::string_view key, const auto&, const auto& inside) {
    const std::string before = prefix_;
    prefix_ += std::string(key) + ".";
    inside();
    prefix_ = before;
  }

  std::vector<std::string> list;

 private:
  std::string prefix_;
};

class Judge : public Walker<Judge> {
 public:
  void number(const auto&...) {}
  void enter(std::string_view key, const auto& value, const auto& inside) {
    const std::string before = prefix_;
    prefix_ += std::string(key) + ".";
    inside();
    judge(value);
    prefix_ = before;
  }
  void judge(const auto& value) {
    const auto report = [&](std::string_view key, std::string_view message) {
      if (broken.empty()) broken = prefix_ + std::string(key) + ": " + std::string(message);
    };
    if constexpr (requires { value.rules(report); }) value.rules(report);
  }

  std::string broken;

 private:
  std::string prefix_;
};

}  // namespace

RigNumber find_number(plant::Rig& rig, std::string_view path) {
  // As sensors were called when each had a key of its own.
  constexpr auto before =
      std::to_array<std::pair<std::string_view, std::string_view>>({{"encoder.", "sensors.contraction."},
                                                                    {"sensor.", "sensors.contraction."},
                                                                    {"gauge.", "sensors.muscle_pressure."},
                                                                    {"load_cell.", "sensors.force."}});
  constexpr std::string_view of_mechanics = "mechanics.";
  if (path.starts_with(of_mechanics)) {
    Guide guide(path.substr(of_mechanics.size()), rig.command_unit());
    if (plant::Pair* pair = rig.pair()) plant::Pair::fields(*pair, guide);
    if (plant::Lever* lever = rig.lever()) plant::Lever::fields(*lever, guide);
    return guide.found;
  }
  std::string today;
  for (const auto& [old, now] : before)
    if (path.starts_with(old)) path = today = std::string(now) + std::string(path.substr(old.size()));
  Guide guide(path, rig.command_unit());
  plant::Rig::parts(rig, guide);
  return guide.found;
}

std::vector<std::string> paths_of_numbers(const plant::Rig& rig) {
  PathLister lister;
  plant::Rig::parts(rig, lister);
  return lister.list;
}

std::vector<std::string> paths_with_mechanics(const plant::Rig& rig) {
  std::vector<std::string> list = paths_of_numbers(rig);
  if (rig.has_angle()) {
    PathLister lister;
    if (const plant::Pair* pair = rig.pair()) plant::Pair::fields(*pair, lister);
    if (const plant::Lever* lever = rig.lever()) plant::Lever::fields(*lever, lister);
    for (const std::string& path : lister.list) list.push_back("mechanics." + path);
  }
  return list;
}

std::string broken_rule(const plant::Rig& rig) {
  Judge judge;
  plant::Rig::parts(rig, judge);
  if (const plant::Pair* pair = rig.pair())
    judge.enter("mechanics", *pair, [&] { plant::Pair::fields(*pair, judge); });
  if (const plant::Lever* lever = rig.lever())
    judge.enter("mechanics", *lever, [&] { plant::Lever::fields(*lever, judge); });
  judge.judge(rig);
  return judge.broken;
}

double usual_load_kg(const plant::Rig& rig) {
  constexpr double share = 0.13, least_kg = 0.1;
  const double most_N = plant::Braid(rig.muscle).largest_force_N(rig.valve.span_pressure_Pa);
  double kg = share * most_N / plant::gravity_m_per_s2;
  if (rig.lever() != nullptr) {  // what pulls at its muscle goes straight with the load
    const double none_kg = rig.pulled_kg(0.0);
    kg = std::max(least_kg, (kg - none_kg) / (rig.pulled_kg(1.0) - none_kg));
  }
  const double digit = std::pow(10.0, std::floor(std::log10(kg)) - 1.0);
  return std::round(kg / digit) * digit;
}

double most_pressure_Pa(const plant::Rig& rig) {
  return rig.valve.seals() ? rig.valve.fill_pressure_Pa : rig.valve.span_pressure_Pa;
}

namespace {

/// Against its friction.
double most_lifted_kg(const plant::Rig& rig, double pressure_Pa) {
  constexpr double against_friction = 0.9;
  return against_friction * plant::Braid(rig.muscle).force_N(hardly_lifted, pressure_Pa) /
         plant::gravity_m_per_s2;
}

/// Whether a number that is meant by another fits what hangs in other runs, where there are some.
bool is_like(double meant_kg, double load_kg, std::span<const double> others_kg, const plant::Rig& rig) {
  constexpr double far = 2.0;
  double lowest_kg = std::numeric_limits<double>::infinity(), highest_kg = 0.0;
  for (const double other_kg : others_kg) {
    if (other_kg == 0.0 || other_kg == load_kg || !too_heavy(other_kg, rig).empty()) continue;
    lowest_kg = std::min(lowest_kg, other_kg);
    highest_kg = std::max(highest_kg, other_kg);
  }
  return highest_kg == 0.0 || (meant_kg > lowest_kg / far && meant_kg < highest_kg * far);
}

std::string is_it_right(double load_kg, const plant::Rig& rig, std::span<const double> others_kg) {
  const auto fits = [&](double meant_kg) {
    return rig.pulled_kg(meant_kg) < most_lifted_kg(rig, most_pressure_Pa(rig)) &&
           is_like(meant_kg, load_kg, others_kg, rig);
  };
  const std::string asked = "is the number right";
  if (fits(0.1 * load_kg)) return asked + ", or is it a tenth, " + write_kg(0.1 * load_kg) + " kg?";
  if (fits(pound_kg * load_kg)) return asked + ", or is it in lb?";
  if (fits(1e-3 * load_kg)) return asked + ", or is it in g?";
  return asked + "?";
}

}  // namespace

std::string too_heavy(double load_kg, const plant::Rig& rig, std::span<const double> others_kg) {
  const double most_kg = plant::Braid(rig.muscle).largest_load_kg();
  if (rig.pulled_kg(load_kg) <= most_kg) return "";
  std::ostringstream text;
  text << "the taut threads of this muscle bear " << std::setprecision(3) << most_kg
       << " kg before they lie along it (muscle.stop_stiffness, braid_angle): "
       << is_it_right(load_kg, rig, others_kg);
  return text.str();
}

std::string never_lifted(double load_kg, const plant::Rig& rig, double pressure_Pa,
                         std::span<const double> others_kg) {
  const double most_kg = most_lifted_kg(rig, pressure_Pa);
  if (rig.pulled_kg(load_kg) <= most_kg) return "";
  std::ostringstream text;
  text << std::setprecision(3) << "more than the muscle lifts, about " << most_kg << " kg at "
       << pressure_Pa / plant::Pa_per_bar << " bar: " << is_it_right(load_kg, rig, others_kg);
  return text.str();
}

}  // namespace mckibben::domain
