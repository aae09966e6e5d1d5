// Settings share lanes with the one that they are changes of; see the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <sim/diagnose/predict.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/engine/batch.hpp>
#include <sim/identify/decisive.hpp>
#include <sim/identify/simulator.hpp>

namespace mckibben::identify {
namespace {

using diagnose::Readings;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t others = engine::Batch::width - 1;  // in the lanes beside the first
constexpr std::size_t most_knots = 24;                    // of a run
constexpr double step = 0.01;                             // of an input or a start, for a difference
// Of a load, to both sides: a load at rest on its stop, or held by friction, shows no smaller one.
constexpr double load_step = 0.1;
constexpr double length_step_m = 5e-4;  // of a given length, to both sides: a sensor of length shows it

/// What one setting reads in a block's rows.
Eigen::VectorXd seen(const Rows& rows, const Block& block, const Readings& readings, const Bench& bench) {
  const std::vector<double>& list = readings.readings[block.reading];
  Eigen::VectorXd part = Eigen::Map<const Eigen::VectorXd>(list.data(), block.rows);
  const double ahead_s = bench.ahead_s - bench.of_run(delays, block.run);
  if (bench.clock != 0.0 || ahead_s != 0.0) part = clocked(part, bench.clock, ahead_s / rows.row_s);
  if (block.kind == 0) part.array() += bench.zero;
  return part;
}

/// Calls `visit` with each of a run's blocks, and the part of a column that is its.
template <class Visit>
void each_block(const Rows& rows, std::size_t run, const Visit& visit) {
  for (const Block& block : rows.blocks)
    if (block.run == run) visit(block, Eigen::seqN(block.begin, block.rows));
}

/// What is not known of a run that began on its way, and how well it is guessed from its first readings: the
/// threads carry what its acceleration asks of them; nobody has seen what effects remember.
struct StartNumber {
  double ride::Underway::*of;
  double deviation;
};
constexpr std::array<StartNumber, 6> start_numbers{{{&ride::Underway::off_rise_m, 2e-4},
                                                    {&ride::Underway::off_speed_m_per_s, 5e-3},
                                                    {&ride::Underway::off_acceleration_m_per_s2, 1.0},
                                                    {&ride::Underway::off_muscle_Pa, 2e4},
                                                    {&ride::Underway::off_valve_Pa, 2e4},
                                                    {&ride::Underway::memories, 1.0}}};

/// How one begins on its way: by what is known, and by its setting.
void begin(const Bench& bench, std::size_t run, ride::Underway& begins) {
  if (bench.starts.empty()) return;
  const Eigen::VectorXd& off = bench.starts[run];
  for (Eigen::Index i = 0; i < off.size(); ++i) {
    const StartNumber& number = start_numbers.at(static_cast<std::size_t>(i));
    begins.*(number.of) += off[i] * number.deviation;
  }
}

/// A prediction that is made of a run, and where its readings go.
struct Job {
  std::size_t run;
  std::vector<std::size_t> settings;  ///< the first is the one whose changes others are
  bool tells_first = true;            ///< one job of a run does
};

}  // namespace

Eigen::VectorXd clocked(const Eigen::VectorXd& read, double rate, double later_rows) {
  Eigen::VectorXd list(read.size());
  for (Eigen::Index row = 0; row < read.size(); ++row) {
    const double at = std::max(static_cast<double>(row) * (1.0 + rate) + later_rows, 0.0);
    const auto before = std::min(static_cast<Eigen::Index>(at), read.size() - 1);
    const Eigen::Index after = std::min(before + 1, read.size() - 1);
    list[row] = std::lerp(read[before], read[after], std::min(at - static_cast<double>(before), 1.0));
  }
  return list;
}

template <class Make>
Eigen::MatrixXd Simulator::once(std::size_t passes, const Make& make) const {
  if (keeps_ && asked_ < kept_.size()) return kept_[asked_++];
  Eigen::MatrixXd made = make();
  passes_ += static_cast<long>(passes);
  if (keeps_) {
    kept_.push_back(made);
    ++asked_;
  }
  return made;
}

Eigen::VectorXd Simulator::read(const Setting& setting) const {
  return once(1, [&] {
    Eigen::MatrixXd list = Eigen::MatrixXd::Constant(rows_.size(), 1, nothing);
    const std::size_t runs = rows_.runs.size();
    diagnose::predict_all(
        runs, runs, threads_, rows_.data().rig.integrator.method,
        [&](std::size_t run) {
          const domain::Run& measured = rows_.data().runs[rows_.runs[run]];
          diagnose::Wanted one{&measured, {setting.of_run(measured, run)}};
          one.disturbance.begin = [&setting, run](std::size_t, ride::Underway& begins) {
            begin(setting.bench, run, begins);
          };
          one.tolerance = diagnose::thresholds.predict.tolerance_alone;
          return one;
        },
        [&](std::size_t run, const std::vector<Readings>& readings, const std::exception_ptr& failure) {
          if (failure) return;
          each_block(rows_, run, [&](const Block& block, const auto& part) {
            list(part, 0) = seen(rows_, block, readings.front(), setting.bench);
          });
        });
    return list;
  });
}

Eigen::MatrixXd Simulator::differences(std::span<const Setting> settings,
                                       std::optional<double> tolerance) const {
  return once(settings.size(), [&] {
    Eigen::MatrixXd list =
        Eigen::MatrixXd::Constant(rows_.size(), static_cast<Eigen::Index>(settings.size()), nothing);
    std::vector<Job> jobs;
    for (std::size_t run = 0; run < rows_.runs.size(); ++run)
      for (std::size_t first = 1; first == 1 || first < settings.size(); first += others) {
        jobs.push_back({run, {0}, first == 1});
        for (std::size_t i = first; i < std::min(first + others, settings.size()); ++i)
          jobs.back().settings.push_back(i);
      }
    const auto wanted = [&](const Job& job) {
      diagnose::Wanted one{&rows_.data().runs[rows_.runs[job.run]], {}};
      one.tolerance = tolerance;
      for (const std::size_t i : job.settings) one.rigs.push_back(settings[i].of_run(*one.run, job.run));
      one.disturbance.begin = [&settings, job](std::size_t i, ride::Underway& begins) {
        begin(settings[job.settings[i]].bench, job.run, begins);
      };
      return one;
    };
    const auto take = [&](const Job& job, const std::vector<Readings>& readings) {
      each_block(rows_, job.run, [&](const Block& block, const auto& part) {
        const Eigen::VectorXd base = seen(rows_, block, readings.front(), settings[0].bench);
        if (job.tells_first) list(part, 0) = base;
        for (std::size_t k = 1; k < job.settings.size(); ++k)
          list(part, static_cast<Eigen::Index>(job.settings[k])) =
              seen(rows_, block, readings[k], settings[job.settings[k]].bench) - base;
      });
    };
    const auto fly = [&](const std::vector<Job>& all, bool again) {
      std::vector<char> missed(all.size(), 0);
      diagnose::predict_all(
          all.size(), all.size() * engine::Batch::width, threads_, rows_.data().rig.integrator.method,
          [&](std::size_t index) { return wanted(all[index]); },
          [&](std::size_t index, const std::vector<Readings>& readings, const std::exception_ptr& failure) {
            if (!failure)
              take(all[index], readings);
            else if (!again)
              missed[index] = 1;
          });
      // Some of a group could not go on: each by itself.
      std::vector<Job> alone;
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (missed[i] == 0) continue;
        if (all[i].tells_first) alone.push_back({all[i].run, {0}, true});
        for (std::size_t k = 1; k < all[i].settings.size(); ++k)
          alone.push_back({all[i].run, {0, all[i].settings[k]}, false});
      }
      return alone;
    };
    if (const auto alone = fly(jobs, false); !alone.empty()) fly(alone, true);
    return list;
  });
}

Eigen::MatrixXd Simulator::rubs(const Setting& setting, double reach_m, std::size_t places) const {
  return once(places + 1, [&] {
    Eigen::MatrixXd list = Eigen::MatrixXd::Zero(rows_.size(), static_cast<Eigen::Index>(places));
    constexpr double rub_N = 0.3, slip_m_per_s = 1e-3;
    const double width_m = reach_m / static_cast<double>(places), rest_m = setting.rig.muscle.rest_length_m;
    const std::size_t groups = (places + others - 1) / others;
    diagnose::predict_all(
        rows_.runs.size() * groups, rows_.runs.size() * groups * engine::Batch::width, threads_,
        rows_.data().rig.integrator.method,
        [&](std::size_t index) {
          const std::size_t run = index / groups, first = index % groups * others;
          diagnose::Wanted one{&rows_.data().runs[rows_.runs[run]], {}};
          const std::size_t count = std::min(others, places - first);
          one.rigs.assign(count + 1, setting.of_run(*one.run, run));
          one.disturbance.begin = [&setting, run](std::size_t, ride::Underway& begins) {
            begin(setting.bench, run, begins);
          };
          one.disturbance.drive = [=](const ride::Rider& rider, std::size_t i, double, double,
                                      ride::Drive& drive) {
            if (i == 0) return;
            const auto& joint = rider.now.flow.state.joint;
            const double centre_m = (static_cast<double>(first + i) - 0.5) * width_m;
            const double near =
                std::max(1.0 - std::abs(joint.contraction_ratio * rest_m - centre_m) / width_m, 0.0);
            drive.joint_force_N +=
                rub_N * std::tanh(joint.contraction_speed_per_s * rest_m / slip_m_per_s) * near;
          };
          return one;
        },
        [&](std::size_t index, const std::vector<Readings>& readings, const std::exception_ptr& failure) {
          if (failure) return;
          const std::size_t run = index / groups, first = index % groups * others;
          each_block(rows_, run, [&](const Block& block, const auto& part) {
            const Eigen::VectorXd base = seen(rows_, block, readings.front(), setting.bench);
            for (std::size_t i = 1; i < readings.size(); ++i)
              list(part, static_cast<Eigen::Index>(first + i - 1)) =
                  (seen(rows_, block, readings[i], setting.bench) - base) / rub_N;
          });
        });
    return list;
  });
}

namespace {

/// Puts one unit of wander into what drives a rig: of muscle 1 or 2.
void wander_by(double units, std::size_t muscle, const plant::Rig& rig, ride::Drive& drive) {
  ride::Command& command = muscle == 0 ? static_cast<ride::Command&>(drive) : drive.opposite;
  const double pressure_unit_Pa = rig.valve.span_pressure_Pa / 16.0;
  if (command.muscle_pressure_Pa)
    *command.muscle_pressure_Pa += units * pressure_unit_Pa;
  else if (command.valve_pressure_Pa)
    *command.valve_pressure_Pa += units * pressure_unit_Pa;
  else if (rig.valve.is_on_off())
    command.current_mA += units * (rig.valve.span_command - rig.valve.zero_command) / 16.0;
  else  // of what drifts most, the regulator: where it is asked for nothing, too
    command.stray_pressure_Pa += units * pressure_unit_Pa;
}

/// A hat of one unit at each knot, linear between.
double hat(const std::vector<double>& knots, std::size_t knot, double at_s) {
  const double width = knots[2] - knots[1];
  return std::max(1.0 - std::abs(at_s - knots[knot]) / width, 0.0);
}

}  // namespace

Wander Simulator::wander(const Setting& setting) const {
  const domain::Dataset& data = rows_.data();
  const bool held = data.lengths_are_given();
  const std::size_t muscles = data.rig.pair() != nullptr ? 2 : 1;
  Wander made;
  struct Lane {
    std::size_t knot = 0, muscle = 0;
    double label = 0.0;  ///< what is added to it: kg of load, or m of a given length
    const StartNumber* start = nullptr;
  };
  // As many for every setting, as one begins where another was.
  made.starts = data.recorded.start == domain::Start::moving ? start_numbers.size() : 0;
  std::vector<std::vector<Lane>> lanes;
  std::size_t most = 0;
  for (const std::size_t run : rows_.runs) {
    const domain::Run& measured = data.runs[run];
    const double lasts_s = std::max(rows_.row_s * static_cast<double>(measured.rows() - 1), rows_.row_s);
    const auto pieces = static_cast<std::size_t>(
        std::clamp(std::ceil(lasts_s / decisive.wander_knot_s), 1.0, static_cast<double>(most_knots)));
    std::vector<double> knots{-lasts_s / static_cast<double>(pieces)};
    for (std::size_t k = 0; k <= pieces; ++k)
      knots.push_back(lasts_s * static_cast<double>(k) / static_cast<double>(pieces));
    std::vector<Lane>& list = lanes.emplace_back();
    std::vector<double> all;
    const std::size_t felt =
        data.rig.valve.seals() ? 1 : knots.size();  // of a sealed muscle, how it is filled
    for (std::size_t muscle = 0; muscle < muscles; ++muscle)
      for (std::size_t k = 0; k < felt; ++k) {
        list.push_back({k, muscle});
        all.push_back(knots[k] +
                      1e9 * static_cast<double>(muscle));  // the muscles' wanders know nothing of each other
      }
    for (std::size_t i = 0; i < made.starts; ++i) list.push_back({.start = &start_numbers.at(i)});
    const double label =
        held ? length_step_m : load_step * setting.bench.load_kg(measured.load_kg, lanes.size() - 1);
    if (label != 0.0)
      for (const double side : {label, -label}) list.push_back({.label = side});
    most = std::max(most, all.size() + made.starts);
    made.knots.push_back(std::move(all));
  }
  made.columns = Eigen::MatrixXd::Zero(rows_.size(), static_cast<Eigen::Index>(most));
  made.read = made.label = made.together = Eigen::VectorXd::Zero(rows_.size());
  struct Group {
    std::size_t run, first, last;
  };
  std::vector<Group> groups;
  for (std::size_t run = 0; run < lanes.size(); ++run)
    for (std::size_t first = 0; first < lanes[run].size(); first += others)
      groups.push_back({run, first, std::min(first + others, lanes[run].size())});
  const Eigen::MatrixXd all = once(most + 3, [&] {
    diagnose::predict_all(
        groups.size(), groups.size() * engine::Batch::width, threads_, data.rig.integrator.method,
        [&](std::size_t index) {
          const Group& g = groups[index];
          diagnose::Wanted one{&data.runs[rows_.runs[g.run]], {}};
          one.rigs.assign(g.last - g.first + 1, setting.of_run(*one.run, g.run));
          for (std::size_t i = g.first; i < g.last; ++i) {
            const double label = lanes[g.run][i].label;
            if (held)
              one.rigs[i - g.first + 1].rig.joint.length_offset_m += label;
            else
              one.rigs[i - g.first + 1].load_kg += label;
          }
          one.disturbance.drive = [&, g,
                                   begin_s = one.run->measured && !one.run->measured->time_s.empty()
                                                 ? one.run->measured->time_s.front()
                                                 : 0.0](const ride::Rider&, std::size_t i, double from_s,
                                                        double to_s, ride::Drive& drive) {
            if (i == 0) return;
            const Lane& lane = lanes[g.run][g.first + i - 1];
            if (lane.label != 0.0 || lane.start != nullptr) return;
            const auto& knots = made.knots[g.run];
            const bool given = lane.muscle == 0 ? drive.given() != plant::GivenPressure::none
                                                : drive.opposite.given() != plant::GivenPressure::none;
            const double at_s = (given ? to_s : from_s) - begin_s;
            const double share = std::isinf(at_s) ? (lane.knot == 0 ? 1.0 : 0.0)
                                 : lane.knot == 0 ? 0.0
                                                  : hat(knots, lane.knot, at_s);
            if (share != 0.0) wander_by(step * share, lane.muscle, data.rig, drive);
          };
          one.disturbance.begin = [&, g](std::size_t i, ride::Underway& begins) {
            begin(setting.bench, g.run, begins);
            const StartNumber* number = i == 0 ? nullptr : lanes[g.run][g.first + i - 1].start;
            if (number != nullptr) begins.*(number->of) += step * number->deviation;
          };
          return one;
        },
        [&](std::size_t index, const std::vector<Readings>& readings, const std::exception_ptr& failure) {
          if (failure) return;
          const Group& g = groups[index];
          each_block(rows_, g.run, [&](const Block& block, const auto& part) {
            const Eigen::VectorXd base = seen(rows_, block, readings.front(), setting.bench);
            if (g.first == 0) made.read(part) = base;
            for (std::size_t i = g.first; i < g.last; ++i) {
              const Eigen::VectorXd change =
                  seen(rows_, block, readings[i - g.first + 1], setting.bench) - base;
              if (const double side = lanes[g.run][i].label; side != 0.0)
                made.label(part) += change / (2.0 * side);
              else
                made.columns(part, static_cast<Eigen::Index>(i)) = change / step;
            }
          });
        });
    Eigen::MatrixXd list(rows_.size(), made.columns.cols() + 2);
    list << made.columns, made.read, made.label;
    return list;
  });
  made.columns = all.leftCols(made.columns.cols());
  made.read = all.col(made.columns.cols());
  made.label = all.col(made.columns.cols() + 1);
  for (const Block& block : rows_.blocks)
    made.together.segment(block.begin, block.rows) = made.columns.middleRows(block.begin, block.rows)
                                                         .leftCols(std::ssize(made.knots[block.run]))
                                                         .rowwise()
                                                         .sum();
  return made;
}

}  // namespace mckibben::identify
