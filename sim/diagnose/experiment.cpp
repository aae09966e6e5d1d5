// Residuals and slopes; see the header. Parameters fly in flocks of seven beside the rig they are changes of.
#include <algorithm>
#include <cmath>
#include <mutex>

#include <sim/diagnose/experiment.hpp>
#include <sim/engine/failure.hpp>
#include <sim/engine/flock.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::diagnose {

Experiment::Experiment(const domain::Dataset& data, std::vector<std::vector<bool>> masked, unsigned threads,
                       Runs trusted)
    : data_(data),
      masked_(std::move(masked)),
      threads_(threads),
      floor_(noise_floor(data, masked_, std::move(trusted))) {}

std::size_t Experiment::rows(std::size_t run) const {
  const domain::Run& measured = data_.runs[run];
  return measured.current_mA.size() * (measured.muscle_pressure_Pa ? 2 : 1);
}

std::vector<Experiment::Part> Experiment::parts(const Runs& runs) const {
  std::vector<Part> list;
  Eigen::Index begin = 0;
  for (const std::size_t run : runs) {
    list.push_back({run, begin, static_cast<Eigen::Index>(data_.runs[run].current_mA.size())});
    begin += static_cast<Eigen::Index>(rows(run));
  }
  return list;
}

void Experiment::compare(const Readings& readings, std::size_t run, double* residuals) const {
  const domain::Run& measured = data_.runs[run];
  const std::size_t ticks = measured.current_mA.size();
  for (std::size_t k = 0; k < ticks; ++k) {
    const bool counts = !masked_[run][k];
    // A counter rounds down: the middle of its count is the best guess.
    const double ratio = measured.contraction_ratio[k] + 0.5 * floor_.count;
    residuals[k] = counts ? (ratio - readings.contraction_ratio[k]) / floor_.ratio : 0.0;
    if (measured.muscle_pressure_Pa)
      residuals[ticks + k] =
          counts ? ((*measured.muscle_pressure_Pa)[k] - readings.pressure_Pa[k]) / floor_.pressure_Pa : 0.0;
  }
}

Eigen::VectorXd Experiment::residuals(const plant::Rig& rig, const Runs& runs) const {
  return slopes(rig, std::span<const Change>{}, runs).residuals;
}

Experiment::Slopes Experiment::slopes(const plant::Rig& rig, std::span<const Parameter> parameters,
                                      const Runs& runs) const {
  std::vector<Change> changes;
  for (const Parameter& p : parameters) {
    const double value = value_of(rig, p.path);
    double change = p.logarithmic ? value * p.step : p.step;
    // Not over the edge of its range, and not over the kink that an effect has where it is absent.
    if (value + change > p.highest || value + change < p.lowest) change = -change;
    changes.push_back(
        {[path = p.path, value, change](Hanging& h) { *find(h.rig, path).value = value + change; },
         p.logarithmic ? change / value : change / p.scale});
  }
  return slopes(rig, changes, runs);
}

Experiment::Slopes Experiment::slopes(const plant::Rig& rig, std::span<const Change> changes,
                                      const Runs& runs) const {
  constexpr std::size_t wing = engine::Flock::most - 1;
  const std::size_t flocks = std::max<std::size_t>(1, (changes.size() + wing - 1) / wing);
  const auto list = parts(runs);
  Eigen::Index total = 0;
  for (const std::size_t run : runs) total += static_cast<Eigen::Index>(rows(run));
  Slopes result{Eigen::VectorXd(total), Eigen::MatrixXd(total, static_cast<Eigen::Index>(changes.size()))};
  // Flies changes [first, last) of a run beside the rig itself.
  const auto fly = [&](const Part& part, std::size_t first, std::size_t last) {
    const domain::Run& measured = data_.runs[part.run];
    std::vector<Hanging> rigs{{rig, measured.load_kg}};
    for (std::size_t c = first; c < last; ++c) {
      rigs.push_back(rigs.front());
      changes[c].apply(rigs.back());
    }
    const auto readings = predict(measured, rigs, data_.rig.integrator.method);
    if (first == 0) compare(readings[0], part.run, result.residuals.data() + part.begin);
    for (std::size_t c = first; c < last; ++c) {
      const Readings& changed = readings[1 + c - first];
      double* column = result.columns.col(static_cast<Eigen::Index>(c)).data() + part.begin;
      const auto ticks = static_cast<std::size_t>(part.rows);
      for (std::size_t k = 0; k < ticks; ++k) {
        const bool counts = !masked_[part.run][k];
        const double ratio = changed.contraction_ratio[k] - readings[0].contraction_ratio[k];
        column[k] = counts ? ratio / (floor_.ratio * changes[c].size) : 0.0;
        if (measured.muscle_pressure_Pa) {
          const double pressure_Pa = changed.pressure_Pa[k] - readings[0].pressure_Pa[k];
          column[ticks + k] = counts ? pressure_Pa / (floor_.pressure_Pa * changes[c].size) : 0.0;
        }
      }
    }
  };
  std::mutex guard;
  std::vector<bool> failed(changes.size());
  const auto job = [&](std::size_t index) {
    const Part& part = list[index / flocks];
    const std::size_t first = index % flocks * wing, last = std::min(changes.size(), first + wing);
    try {
      fly(part, first, last);
      return;
    } catch (const engine::NumericalFailure&) {
      const auto may_fail = [](const Change& change) { return change.may_fail; };
      if (!std::any_of(changes.begin() + static_cast<std::ptrdiff_t>(first),
                       changes.begin() + static_cast<std::ptrdiff_t>(last), may_fail))
        throw;
    }
    if (first == 0) fly(part, 0, 0);
    for (std::size_t c = first; c < last; ++c) {
      try {
        fly(part, c, c + 1);
      } catch (const engine::NumericalFailure&) {
        if (!changes[c].may_fail) throw;
        const std::lock_guard lock(guard);
        failed[c] = true;
      }
    }
  };
  run::for_each_job(list.size() * flocks, threads_, job, [](std::size_t) {});
  for (std::size_t c = 0; c < changes.size(); ++c)
    if (failed[c]) result.columns.col(static_cast<Eigen::Index>(c)).setZero();
  return result;
}

Eigen::VectorXd Experiment::residuals(const Readings& readings, std::size_t run) const {
  Eigen::VectorXd list(static_cast<Eigen::Index>(rows(run)));
  compare(readings, run, list.data());
  return list;
}

Readings Experiment::readings(const plant::Rig& rig, std::size_t run) const {
  const Hanging hanging{rig, data_.runs[run].load_kg};
  return predict(data_.runs[run], {&hanging, 1}, data_.rig.integrator.method).front();
}

double Experiment::rmse(const Eigen::VectorXd& residuals, const Runs& runs) const {
  double squares = 0.0;
  std::size_t count = 0;
  for (const Part& part : parts(runs)) {
    squares += residuals.segment(part.begin, part.rows).squaredNorm();
    count += static_cast<std::size_t>(std::count(masked_[part.run].begin(), masked_[part.run].end(), false));
  }
  return floor_.ratio * std::sqrt(squares / static_cast<double>(std::max<std::size_t>(count, 1)));
}

}  // namespace mckibben::diagnose
