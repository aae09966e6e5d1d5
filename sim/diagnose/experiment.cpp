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

Eigen::VectorXd Experiment::residuals(const Rig& rig, const Runs& runs) const {
  return slopes(rig, std::span<const Change>{}, runs).residuals;
}

namespace {

double step_of(const Parameter& p, double value) {
  return p.logarithmic ? value * p.step : p.step;
}

bool may_be(const Parameter& p, double value) {
  return value >= p.lowest && value <= p.highest;
}

Experiment::Change change_by(const Parameter& p, double value, double change) {
  return {[p, value, change](Loaded& h) { p.put(h.rig, value + change); },
          p.logarithmic ? change / value : change / p.scale};
}

}  // namespace

std::vector<Experiment::Change> Experiment::changes_of(const Rig& rig,
                                                       std::span<const Parameter> parameters) {
  std::vector<Change> changes;
  for (const Parameter& p : parameters) {
    const double value = value_of(rig, p.path), step = step_of(p, value);
    // Not over the edge of its range, and not over the kink that an effect has where it is absent.
    changes.push_back(change_by(p, value, may_be(p, value + step) ? step : -step));
  }
  return changes;
}

Experiment::Slopes Experiment::slopes(const Rig& rig, std::span<const Parameter> parameters,
                                      const Runs& runs) const {
  return slopes(rig, changes_of(rig, parameters), runs);
}

Experiment::Slopes Experiment::fine_slopes(const Rig& rig, std::span<const Parameter> parameters,
                                           const Runs& runs) const {
  std::vector<Parameter> wide(parameters.begin(), parameters.end());
  for (Parameter& p : wide) p.step *= thresholds.fit.wider_steps;
  auto changes = changes_of(rig, wide);
  const auto count = static_cast<Eigen::Index>(wide.size());
  std::vector<Eigen::Index> two_sided;
  for (Eigen::Index j = 0; j < count; ++j) {
    const Parameter& p = wide[static_cast<std::size_t>(j)];
    const double value = value_of(rig, p.path), step = step_of(p, value);
    if (!may_be(p, value + step) || !may_be(p, value - step)) continue;
    changes.push_back(change_by(p, value, -step));
    two_sided.push_back(j);
  }
  auto sides = slopes(rig, changes, runs);
  Slopes result{std::move(sides.residuals), sides.columns.leftCols(count)};
  for (Eigen::Index k = 0; k < std::ssize(two_sided); ++k) {
    auto column = result.columns.col(two_sided[static_cast<std::size_t>(k)]);
    column = 0.5 * (column + sides.columns.col(count + k)).eval();
  }
  return result;
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

Wanted Experiment::wanted(const Rig& rig, std::span<const Change> changes, std::size_t run) const {
  Wanted one{&data_.runs[run], {{rig, data_.runs[run].load_kg}}};
  for (const Change& change : changes) {
    one.rigs.push_back(one.rigs.front());
    change.apply(one.rigs.back());
  }
  return one;
}

void Experiment::note(const std::vector<Readings>& readings, std::span<const Change> changes,
                      std::size_t before, bool base, const Part& part, Slopes& result) const {
  const domain::Run& measured = data_.runs[part.run];
  if (before == 0 && base) compare(readings[0], part.run, result.residuals.data() + part.begin);
  const auto ticks = static_cast<std::size_t>(part.rows);
  for (std::size_t c = 0; c < changes.size(); ++c) {
    const Readings& changed = readings[1 + c];
    double* column = result.columns.col(static_cast<Eigen::Index>(before + c)).data() + part.begin;
    const auto tell = [&](const std::vector<double>& to, const std::vector<double>& from, double floor) {
      for (std::size_t k = 0; k < ticks; ++k)
        column[k] = masked_[part.run][k] ? 0.0 : (to[k] - from[k]) / (floor * changes[c].size);
    };
    tell(changed.judged, readings[0].judged, floor_.judged);
    each_beside(measured, [&](domain::Beside which, const auto&) {
      column += ticks;
      tell(changed.beside(which), readings[0].beside(which), floor_.beside(which));
      for (std::size_t k = 0; k < ticks; ++k)
        if (measured.is_missing(which, k)) column[k] = 0.0;
    });
  }
}

Experiment::Slopes Experiment::slopes(const Rig& rig, std::span<const Change> changes,
                                      const Runs& runs) const {
  const auto list = parts(runs);
  Eigen::Index total = 0;
  for (const std::size_t run : runs) total += static_cast<Eigen::Index>(rows(run));
  Slopes result{Eigen::VectorXd(total), Eigen::MatrixXd(total, static_cast<Eigen::Index>(changes.size()))};
  // Of runs on their way one place more is taken: see `begun`.
  const std::size_t width = engine::Batch::width - (data_.recorded.start == domain::Start::moving ? 2 : 1);
  std::vector<Group> groups;
  for (const Part& part : list)
    for (std::size_t first = 0; first == 0 || first < changes.size(); first += width)
      groups.push_back({part, first, std::min(changes.size(), first + width)});
  // The longest first, so that no thread is left with one at the end.
  std::ranges::stable_sort(groups, std::ranges::greater{}, [](const Group& group) {
    return group.part.rows * static_cast<Eigen::Index>(1 + group.last - group.first);
  });
  std::vector<Group> failed = fly(rig, changes, groups, result, false);
  // Those that some change keeps from flying fly change by change.
  std::vector<Group> single;
  for (const Group& group : failed) {
    if (group.first == 0) single.push_back({group.part, 0, 0});
    for (std::size_t c = group.first; c < group.last; ++c) single.push_back({group.part, c, c + 1});
  }
  for (const Group& group : fly(rig, changes, single, result, true))
    result.columns.col(static_cast<Eigen::Index>(group.first)).setZero();
  return result;
}

// Groups that cannot fly, all of whose failures may be forgiven: because of a change that may fail, if it is
// alone, or one of some that fly together.
std::vector<Experiment::Group> Experiment::fly(const Rig& rig, std::span<const Change> changes,
                                               const std::vector<Group>& groups, Slopes& result,
                                               bool alone) const {
  std::size_t rigs = 0;
  for (const Group& group : groups) rigs += 1 + group.last - group.first;
  std::vector<std::exception_ptr> failures(groups.size());
  const auto of = [&](const Group& group) { return changes.subspan(group.first, group.last - group.first); };
  const auto asked = [&](std::size_t i) { return wanted(rig, of(groups[i]), groups[i].part.run); };
  const auto told = [&](std::size_t i, const std::vector<Readings>& readings,
                        const std::exception_ptr& failure) {
    failures[i] = failure;
    // Of those alone only a group without changes tells what the rig itself does.
    const bool base = !alone || groups[i].last == groups[i].first;
    if (!failure) note(readings, of(groups[i]), groups[i].first, base, groups[i].part, result);
  };
  const auto begin = [&](std::size_t i) {
    try {
      told(i, begun(groups[i].part.run, asked(i).rigs), nullptr);
    } catch (const engine::NumericalFailure&) {
      told(i, {}, std::current_exception());
    }
  };
  if (seeks_memories(rig))
    run::for_each_job(groups.size(), threads_, begin, [](std::size_t) {});
  else
    predict_all(groups.size(), rigs, threads_, data_.rig.integrator.method, asked, told);
  std::vector<Group> failed;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (!failures[i]) continue;
    const auto group = of(groups[i]);
    if (std::none_of(group.begin(), group.end(), [](const Change& change) { return change.may_fail; }))
      std::rethrow_exception(failures[i]);
    failed.push_back(groups[i]);
  }
  return failed;
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
      [&](std::size_t i) { return wanted(rig, {}, runs[i]); },
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
