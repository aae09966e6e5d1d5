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

std::size_t Experiment::rows(std::size_t run) const {
  return data_.runs[run].rows() * data_.runs[run].readings.size();
}

std::vector<Experiment::Part> Experiment::parts(const Runs& runs) const {
  std::vector<Part> list;
  Eigen::Index begin = 0;
  for (const std::size_t run : runs) {
    list.push_back({run, begin, static_cast<Eigen::Index>(data_.runs[run].rows())});
    begin += static_cast<Eigen::Index>(rows(run));
  }
  return list;
}

double Experiment::floor_of(const domain::Run& run, std::size_t reading) const {
  return reading == 0 ? floor_.judged : floor_.beside(run.readings[reading].channel);
}

void Experiment::compare(const Readings& readings, std::size_t run, double* residuals) const {
  const domain::Run& measured = data_.runs[run];
  const auto& masked = masked_[run];
  for (std::size_t i = 0; i < measured.readings.size(); ++i) {
    const domain::Reading& read = measured.readings[i];
    const double floor = floor_of(measured, i);
    // A counter rounds down: the middle of its count is the best guess. Other sensors do not.
    const double middle = i == 0 ? floor_.middle : 0.0;
    for (std::size_t k = 0; k < read.values.size(); ++k)
      *residuals++ =
          masked[k] || read.is_missing(k) ? 0.0 : (read.values[k] + middle - readings.readings[i][k]) / floor;
  }
}

namespace {

/// As many times of the way from one to another.
void go(Readings& readings, const Readings& from, const Readings& to, double times) {
  for (std::size_t i = 0; i < readings.readings.size(); ++i)
    for (std::size_t k = 0; k < readings.readings[i].size(); ++k)
      readings.readings[i][k] += times * (to.readings[i][k] - from.readings[i][k]);
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
    const Eigen::VectorXd along = (residuals(here, run) - residuals(aside, run)) / by.memory_step;
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

}  // namespace mckibben::diagnose
