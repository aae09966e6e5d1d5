// Stamps to drives; see the header.
#include <algorithm>
#include <cmath>
#include <utility>

#include <sim/data/scatter.hpp>
#include <sim/run/course.hpp>

namespace mckibben::run {
namespace {

using domain::Hold, domain::Measurement;

constexpr double jump_s = 1e-6;  // of a pressure that is held until its next stamp

bool any_given(const Measurement& measured) {
  return measured.sides[0].pressure_is_given || measured.sides[1].pressure_is_given;
}
bool any_command(const Measurement& measured) {
  return !measured.sides[0].current_mA.empty() || !measured.sides[1].current_mA.empty();
}

class Drives {
 public:
  Drives(const Measurement& measured, const plant::Rig& rig) : measured_(measured), rig_(rig) {}

  Course operator()() { return measured_.point_s > 0.0 ? points() : stamped(); }

 private:
  Course stamped() {
    const std::size_t stamps = measured_.time_s.size();
    const bool jumps = measured_.recorded.hold == Hold::previous && any_given(measured_);
    const bool ramps = measured_.recorded.hold == Hold::linear && any_command(measured_);
    auto row = measured_.rows.begin();
    for (std::size_t k = 0; k < stamps; ++k) {
      const double now_s = measured_.time_s[k];
      if (jumps && k > 0)
        add(now_s - std::min(jump_s, 0.5 * (now_s - measured_.time_s[k - 1])), at(k - 1, k - 1, 0.0));
      if (measured_.rows.empty() || (row != measured_.rows.end() && *row == k)) {
        course_.rows.push_back(course_.time_s.size());
        if (!measured_.rows.empty()) ++row;
      }
      const std::size_t next = std::min(k + 1, stamps - 1);
      const double gap_s = measured_.time_s[next] - now_s;
      const double parts = ramps ? std::max(1.0, std::ceil(gap_s / rig_.tick_s)) : 1.0;
      for (double part = 0.0; part < parts; part += 1.0)
        add(now_s + part / parts * gap_s, at(k, next, ramps ? (part + 0.5) / parts : 0.0, part / parts));
    }
    return std::move(course_);
  }

  Course points() {
    const auto& read_s = measured_.time_s;
    const auto is_judged = [&](std::size_t k) {
      return measured_.rows.empty() || std::ranges::binary_search(measured_.rows, k);
    };
    for (std::size_t k = 0; k < read_s.size(); ++k) {
      if (k > 0) {
        add(read_s[k - 1] + jump_s, at(k - 1, k, 1.0));
        add(read_s[k - 1] + 0.5 * measured_.point_s, at(k, k, 0.0));
      }
      if (is_judged(k)) course_.rows.push_back(course_.time_s.size());
      add(read_s[k], at(k, k, 0.0));
    }
    return std::move(course_);
  }

  void add(double time_s, const ride::Drive& drive) {
    course_.time_s.push_back(time_s);
    course_.drives.push_back(drive);
  }

  /// At stamp k, and as far on to another: commands by `held`, pressures and lengths by `on`.
  ride::Drive at(std::size_t k, std::size_t next, double held, double on = 0.0) const {
    const auto between = [&](const std::vector<double>& values, double share) {
      return share == 0.0 ? values[k] : std::lerp(values[k], values[next], share);
    };
    ride::Drive drive;
    const auto act = [&](const Measurement::Side& side, ride::Command& command) {
      if (side.pressure_is_given)
        command.muscle_pressure_Pa = between(side.muscle_pressure_Pa, on);
      else if (!side.current_mA.empty())
        command.current_mA = between(side.current_mA, held);
    };
    act(measured_.sides[0], drive);
    act(measured_.sides[1], drive.opposite);
    if (measured_.length_is_given) drive.contraction_ratio = between(measured_.contraction_ratio, on);
    return drive;
  }

  const Measurement& measured_;
  const plant::Rig& rig_;
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
  go(drive.muscle_pressure_Pa, next.muscle_pressure_Pa);
  go(drive.opposite.muscle_pressure_Pa, next.opposite.muscle_pressure_Pa);
  go(drive.contraction_ratio, next.contraction_ratio);
  return drive;
}

double Course::until_s(std::size_t k, double alone_s) const {
  if (k + 1 < time_s.size()) return time_s[k + 1];
  return time_s[k] + (k > 0 ? time_s[k] - time_s[k - 1] : alone_s);
}

Course course_of(const Measurement& measured, const plant::Rig& rig) {
  Course course = Drives(measured, rig)();
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
