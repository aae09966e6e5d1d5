// Residuals and slopes; see the header. Parameters share a batch item, seven at a time, with the rig that
// they are changes of.
#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <utility>

#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/engine/batch.hpp>
#include <sim/engine/failure.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::diagnose {

Experiment::Experiment(const domain::Dataset& data, std::vector<std::vector<bool>> masked, unsigned threads,
                       Runs trusted)
    : data_(data),
      masked_(std::move(masked)),
      threads_(threads),
      floor_(noise_floor(data, masked_, std::move(trusted))) {}

namespace {

/// Calls `visit(kind, values)` for each reading of a run beside the one that is judged.
template <class Visit>
void each_beside(const domain::Run& run, const Visit& visit) {
  for (const domain::Beside which : domain::besides)
    if (const auto* values = run.beside(which)) visit(which, *values);
}

}  // namespace

std::size_t Experiment::rows(std::size_t run) const {
  const domain::Run& measured = data_.runs[run];
  std::size_t readings = 1;
  each_beside(measured, [&](auto, const auto&) { ++readings; });
  return measured.judged().size() * readings;
}

std::vector<Experiment::Part> Experiment::parts(const Runs& runs) const {
  std::vector<Part> list;
  Eigen::Index begin = 0;
  for (const std::size_t run : runs) {
    list.push_back({run, begin, static_cast<Eigen::Index>(data_.runs[run].judged().size())});
    begin += static_cast<Eigen::Index>(rows(run));
  }
  return list;
}

void Experiment::compare(const Readings& readings, std::size_t run, double* residuals) const {
  const domain::Run& measured = data_.runs[run];
  const std::size_t ticks = measured.judged().size();
  const auto& masked = masked_[run];
  for (std::size_t k = 0; k < ticks; ++k) {
    // A counter rounds down: the middle of its count is the best guess. Other sensors do not.
    const double read = measured.judged()[k] + floor_.middle;
    residuals[k] = masked[k] ? 0.0 : (read - readings.judged[k]) / floor_.judged;
  }
  each_beside(measured, [&](domain::Beside which, const std::vector<double>& read) {
    residuals += ticks;
    const auto& predicted = readings.beside(which);
    for (std::size_t k = 0; k < ticks; ++k)
      residuals[k] =
          masked[k] || measured.is_missing(which, k) ? 0.0 : (read[k] - predicted[k]) / floor_.beside(which);
  });
}

namespace {

/// One reading after the other, in floors, as residuals are.
Eigen::VectorXd in_floors(const Readings& readings, const NoiseFloor& floor, const domain::Run& run) {
  const auto rows = static_cast<Eigen::Index>(readings.judged.size());
  Eigen::VectorXd list = Eigen::Map<const Eigen::VectorXd>(readings.judged.data(), rows) / floor.judged;
  each_beside(run, [&](domain::Beside which, const auto&) {
    list.conservativeResize(list.size() + rows);
    list.tail(rows) =
        Eigen::Map<const Eigen::VectorXd>(readings.beside(which).data(), rows) / floor.beside(which);
  });
  return list;
}

/// As many times of the way from one to another.
void go(std::vector<double>& values, const std::vector<double>& from, const std::vector<double>& to,
        double times) {
  for (std::size_t k = 0; k < values.size(); ++k) values[k] += times * (to[k] - from[k]);
}
void go(Readings& readings, const Readings& from, const Readings& to, double times) {
  go(readings.judged, from.judged, to.judged, times);
  for (const domain::Beside which : domain::besides)
    go(readings.beside(which), from.beside(which), to.beside(which), times);
}

}  // namespace

bool Experiment::seeks_memories(const Rig& rig) const {
  return data_.recorded.start != domain::Start::settled && rig.remembers();
}

// A further rig of the group, with its memories a little off, tells what they change; a straight line then
// takes all readings to where the run's own say. Where that is far, all fly again from near there.
std::vector<Readings> Experiment::begun(std::size_t run, std::vector<Loaded> rigs) const {
  const domain::Run& measured = data_.runs[run];
  const solver::Method method = data_.rig.integrator.method;
  if (!seeks_memories(rigs.front().rig)) return predict(measured, rigs, method);
  const StartThresholds& by = thresholds.start;
  rigs.push_back(rigs.front());
  double off = 0.0;
  for (int flight = 1;; ++flight) {
    std::vector<double> memories(rigs.size(), off);
    memories.back() += by.memory_step;
    auto readings = predict(measured, rigs, method, memories);
    const Readings here = readings.front(), aside = std::move(readings.back());
    readings.pop_back();
    Eigen::VectorXd along =
        (in_floors(aside, floor_, measured) - in_floors(here, floor_, measured)) / by.memory_step;
    const auto& masked = masked_[run];
    for (Eigen::Index k = 0; k < along.size(); ++k)
      if (masked[static_cast<std::size_t>(k) % masked.size()]) along[k] = 0.0;
    double* part = along.data();
    each_beside(measured, [&](domain::Beside which, const auto&) {
      part += masked.size();
      for (std::size_t k = 0; k < masked.size(); ++k)
        if (measured.is_missing(which, k)) part[k] = 0.0;
    });
    const double square = along.squaredNorm() + 1.0 / (by.memory * by.memory);
    const auto further = [&](const Readings& from) {
      return std::clamp(off + along.dot(residuals(from, run)) / square, -by.memory, by.memory) - off;
    };
    if (const double wanted = further(here); std::abs(wanted) > by.memory_near && flight < by.flights) {
      off += wanted;
      continue;
    }
    for (Readings& each : readings) go(each, here, aside, further(each) / by.memory_step);
    return readings;
  }
}

Eigen::VectorXd Experiment::residuals(const Readings& readings, std::size_t run) const {
  Eigen::VectorXd list(static_cast<Eigen::Index>(rows(run)));
  compare(readings, run, list.data());
  return list;
}

std::vector<Readings> Experiment::readings(const Rig& rig, const Runs& runs) const {
  std::vector<Readings> list(runs.size());
  if (seeks_memories(rig)) {
    run::for_each_job(
        runs.size(), threads_,
        [&](std::size_t i) {
          list[i] = begun(runs[i], {{rig, data_.runs[runs[i]].load_kg}}).front();
        },
        [](std::size_t) {});
    return list;
  }
  predict_all(
      runs.size(), runs.size(), threads_, data_.rig.integrator.method,
      [&](std::size_t i) {
        return Wanted{&data_.runs[runs[i]], {{rig, data_.runs[runs[i]].load_kg}}};
      },
      [&](std::size_t i, std::vector<Readings> of_run, const std::exception_ptr& failure) {
        if (failure) std::rethrow_exception(failure);
        list[i] = std::move(of_run.front());
      });
  return list;
}

double Experiment::rmse(const Eigen::VectorXd& residuals, const Runs& runs) const {
  double squares = 0.0;
  std::size_t count = 0;
  for (const Part& part : parts(runs)) {
    squares += residuals.segment(part.begin, part.rows).squaredNorm();
    count += static_cast<std::size_t>(std::count(masked_[part.run].begin(), masked_[part.run].end(), false));
  }
  return floor_.judged * std::sqrt(squares / static_cast<double>(std::max<std::size_t>(count, 1)));
}

std::optional<double> Experiment::rmse(domain::Beside which, const Eigen::VectorXd& residuals,
                                       const Runs& runs) const {
  double squares = 0.0, count = 0.0;
  for (const Part& part : parts(runs)) {
    Eigen::Index begin = part.begin;
    const domain::Run& run = data_.runs[part.run];
    each_beside(run, [&](domain::Beside other, const auto& read) {
      begin += part.rows;
      if (other != which) return;
      squares += residuals.segment(begin, part.rows).squaredNorm();
      for (std::size_t k = 0; k < read.size(); ++k)
        count += masked_[part.run][k] || run.is_missing(which, k) ? 0.0 : 1.0;
    });
  }
  if (count == 0.0) return std::nullopt;
  return floor_.beside(which) * std::sqrt(squares / count);
}

}  // namespace mckibben::diagnose
