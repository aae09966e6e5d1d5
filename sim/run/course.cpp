// Stamps to drives; see the header.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <sim/data/scatter.hpp>
#include <sim/domain/outer_force.hpp>
#include <sim/run/course.hpp>

namespace mckibben::run {
namespace {

using domain::Hold, domain::MeasuredColumn, domain::Measurement;

constexpr double jump_s = 1e-6;  // of a pressure that is held until its next stamp

/// What of a drive each signal is that may be given, by its key in data sets: of the muscle, or of all.
struct Giving {
  std::string_view key;
  void (*put)(ride::Drive& drive, ride::Command& of_muscle, double value, const plant::Rig& rig);
};
constexpr auto givings = std::to_array<Giving>(
    {{"command", [](auto&, auto& muscle, double mA, auto&) { muscle.current_mA = mA; }},
     {"valve_pressure", [](auto&, auto& muscle, double Pa, auto&) { muscle.valve_pressure_Pa = Pa; }},
     {"muscle_pressure", [](auto&, auto& muscle, double Pa, auto&) { muscle.muscle_pressure_Pa = Pa; }},
     {"contraction", [](auto& drive, auto&, double ratio, auto&) { drive.contraction_ratio = ratio; }},
     {"joint_force", [](auto& drive, auto&, double N, auto&) { drive.joint_force_N = N; }},
     {"joint_torque",
      [](auto& drive, auto&, double N_m, auto& rig) {
        drive.joint_force_N = domain::as_force_N(N_m, rig.joint.wheel_radius_m);
      }},
     {"supply_pressure", [](auto& drive, auto&, double Pa, auto&) { drive.supply_pressure_Pa = Pa; }}});
static_assert(std::ranges::all_of(plant::signals, [](const plant::Signal& signal) {
  return !signal.may_be_given || std::ranges::find(givings, signal.in_dataset, &Giving::key) != givings.end();
}));

/// How far on to the next stamp each kind of given column is: commands, which are held; forces and the
/// supply, which are held as well, at their mean; what is what it is at an instant, and runs straight on.
struct Shares {
  double command = 0.0, force = 0.0, straight = 0.0;

  double of(const MeasuredColumn& column) const {
    if (column.is_command()) return command;
    return is_force(column) ? force : straight;
  }
  static bool is_force(const MeasuredColumn& column) {
    return column.channel.signal->kind == plant::Kind::input && !column.is_command();
  }
};

class Drives {
 public:
  Drives(const Measurement& measured, const plant::Rig& rig) : measured_(measured), rig_(rig) {
    course_.outer_force = measured.gives_outer_force();
    for (const MeasuredColumn& column : measured.columns)
      if (column.given && !column.values.empty())
        given_.emplace_back(&column,
                            std::ranges::find(givings, column.channel.signal->in_dataset, &Giving::key)->put);
  }

  Course operator()() { return measured_.point_s > 0.0 ? points() : stamped(); }

 private:
  Course stamped() {
    const std::size_t stamps = measured_.time_s.size();
    const bool holds = measured_.recorded.hold == Hold::previous;
    const bool linear = measured_.recorded.hold == Hold::linear;
    bool jumps = false, ramps = false;
    for (const auto& [column, put] : given_) {
      const bool force = Shares::is_force(*column);
      jumps = jumps || (holds && !force && !column->is_command());
      ramps = ramps || (linear && column->is_command()) || (!holds && force);
    }
    auto row = measured_.rows.begin();
    for (std::size_t k = 0; k < stamps; ++k) {
      const double now_s = measured_.time_s[k];
      if (jumps && k > 0)
        add(now_s - std::min(jump_s, 0.5 * (now_s - measured_.time_s[k - 1])), at(k - 1, k - 1));
      if (measured_.rows.empty() || (row != measured_.rows.end() && *row == k)) {
        course_.rows.push_back(course_.time_s.size());
        if (!measured_.rows.empty()) ++row;
      }
      const std::size_t next = std::min(k + 1, stamps - 1);
      const double gap_s = measured_.time_s[next] - now_s;
      const double parts = ramps ? std::max(1.0, std::ceil(gap_s / rig_.tick_s)) : 1.0;
      for (double part = 0.0; part < parts; part += 1.0) {
        const double mean = (part + 0.5) / parts;
        add(now_s + part / parts * gap_s,
            at(k, next, {linear ? mean : 0.0, holds ? 0.0 : mean, part / parts}));
      }
    }
    return std::move(course_);
  }

  Course points() {
    const auto& read_s = measured_.time_s;
    const auto is_judged = [&](std::size_t k) {
      return measured_.rows.empty() || std::ranges::binary_search(measured_.rows, k);
    };
    if (const double before_s = 0.5 * measured_.point_s, fill_s = filling_s(); fill_s > 0.0) {
      add(read_s[0] - before_s - fill_s, emptied(at(0, 0)));
      add(read_s[0] - before_s, at(0, 0));
    }
    for (std::size_t k = 0; k < read_s.size(); ++k) {
      if (k > 0) {
        add(read_s[k - 1] + jump_s, at(k - 1, k, {.command = 1.0, .force = 1.0}));
        add(read_s[k - 1] + 0.5 * measured_.point_s, at(k, k));
      }
      if (is_judged(k)) course_.rows.push_back(course_.time_s.size());
      add(read_s[k], at(k, k));
    }
    return std::move(course_);
  }

  void add(double time_s, const ride::Drive& drive) {
    course_.time_s.push_back(time_s);
    course_.drives.push_back(drive);
  }

  /// At stamp k, and so far on to another.
  ride::Drive at(std::size_t k, std::size_t next, const Shares& shares = {}) const {
    ride::Drive drive;
    for (const auto& [column, put] : given_) {
      const double share = shares.of(*column);
      const auto& values = column->values;
      put(drive, column->channel.muscle == 2 ? drive.opposite : drive,
          share == 0.0 ? values[k] : std::lerp(values[k], values[next], share), rig_);
    }
    return drive;
  }

  /// How long pressures take to the first point: no faster than to any other. 0: none is given.
  double filling_s() const {
    double first_Pa = 0.0, step_Pa = 0.0;
    bool any = false;
    for (const auto& [column, put] : given_) {
      if (!column->channel.is_pressure()) continue;
      any = true;
      first_Pa = std::max(first_Pa, std::abs(column->values.front()));
      for (std::size_t k = 1; k < column->values.size(); ++k)
        step_Pa = std::max(step_Pa, std::abs(column->values[k] - column->values[k - 1]));
    }
    if (!any) return 0.0;
    return 0.5 * measured_.point_s * (step_Pa > 0.0 ? std::max(1.0, first_Pa / step_Pa) : 1.0);
  }

  /// The same before the muscles were filled.
  static ride::Drive emptied(ride::Drive drive) {
    for (ride::Command* command : {static_cast<ride::Command*>(&drive), &drive.opposite})
      for (auto* pressure : {&command->muscle_pressure_Pa, &command->valve_pressure_Pa})
        if (*pressure) *pressure = 0.0;
    return drive;
  }

  const Measurement& measured_;
  const plant::Rig& rig_;
  std::vector<std::pair<const MeasuredColumn*, decltype(Giving::put)>> given_;
  Course course_;
};

}  // namespace

ride::Drive Course::toward(std::size_t k) const {
  ride::Drive drive = drives[k];
  const bool last = k + 1 == drives.size();
  if (last && k == 0) return drive;
  const ride::Drive& next = drives[last ? k - 1 : k + 1];
  const auto go = [last](std::optional<double>& value, const std::optional<double>& other) {
    if (value) value = last ? 2.0 * *value - *other : *other;
  };
  const auto go_on = [&](ride::Command& command, const ride::Command& other) {
    go(command.muscle_pressure_Pa, other.muscle_pressure_Pa);
    go(command.valve_pressure_Pa, other.valve_pressure_Pa);
  };
  go_on(drive, next);
  go_on(drive.opposite, next.opposite);
  go(drive.contraction_ratio, next.contraction_ratio);
  return drive;
}

double Course::until_s(std::size_t k, double alone_s) const {
  if (k + 1 < time_s.size()) return time_s[k + 1];
  return time_s[k] + (k > 0 ? time_s[k] - time_s[k - 1] : alone_s);
}

Course course_of(const Measurement& measured, const plant::Rig& rig) {
  Course course = Drives(measured, rig)();
  if (rig.valve.seals())
    course.filled_Pa = measured.filled_Pa ? measured.filled_Pa : data::first_pressure_Pa(measured);
  if (measured.recorded.start == domain::Start::moving) {
    const domain::FirstState first = measured.first ? *measured.first : data::first_state(measured);
    const double length_m = rig.muscle.rest_length_m;
    course.begins = {length_m * first.contraction_ratio, length_m * first.speed_per_s,
                     length_m * first.acceleration_per_s2, first.muscle_pressure_Pa};
  }
  return course;
}

Course course_of(const domain::Run& run, const plant::Rig& rig) {
  if (run.measured) return course_of(*run.measured, rig);
  Course course;
  for (std::size_t k = 0; k < run.current_mA.size(); ++k) {
    course.time_s.push_back(static_cast<double>(k) * rig.tick_s);
    course.drives.emplace_back().current_mA = run.current_mA[k];
    course.rows.push_back(k);
  }
  return course;
}

}  // namespace mckibben::run
