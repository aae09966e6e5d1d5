// Effects that may be missing beside faults of recordings; see the header. All is linear: what is suspected
// must be fitted before anything of it is believed.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include <Eigen/Cholesky>

#include <sim/diagnose/examination.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {

void Examination::draw_effects() {
  std::vector<Experiment::Change> changes;
  for (const Candidate& c : effects_) {
    if (!c.fits(at_.rig)) continue;
    for (const double shape : c.shapes.empty() ? std::vector{0.0} : c.shapes) {
      changes.push_back({[&c, shape](Loaded& h) {
                           h.rig = c.chosen(h.rig);
                           c.put(h.rig, c.absent + thresholds.parameter.probe * c.typical, shape);
                         },
                         thresholds.parameter.probe * c.typical, true});
      drawn_.push_back({&c, shape, Eigen::VectorXd::Zero(residuals_.size())});
    }
  }
  if (changes.empty()) return;
  const auto slopes = experiment_.slopes(at_.rig, changes, runs_);
  const auto parts = experiment_.parts(runs_);
  for (std::size_t c = 0; c < changes.size(); ++c)
    for (std::size_t i = 0; i < parts.size(); ++i)
      drawn_[c].column.segment(begin(i), rows(i)) =
          experiment_.floor().judged * weight_ *
          slopes.columns.col(static_cast<Eigen::Index>(c)).segment(parts[i].begin, parts[i].rows);
}

/// What one effect of the catalogue takes off the misfit at best; all of nothing if there is none.
double Examination::most_gained(const Regression& alone) const {
  if (drawn_.empty()) return -infinite;
  double most = 0.0;
  for (const Drawn& effect : drawn_) {
    const auto [drop, amplitude] = alone.gain(effect.column, 0);
    if (effect.possible(amplitude)) most = std::max(most, drop);
  }
  return most;
}

namespace {

/// What a fit leaves, from products of its columns, then the residuals, then one more column with one
/// another: the sum of squares, and what the last column would explain of it.
std::pair<double, Regression::Gain> left_of(const Eigen::MatrixXd& products) {
  const Eigen::Index free = products.cols() - 2;
  const auto square = products.topLeftCorner(free, free);
  const auto across = products.topRightCorner(free, 2);
  const Eigen::Matrix2d left =
      products.bottomRightCorner(2, 2) - across.transpose() * square.ldlt().solve(across);
  if (left(1, 1) <= thresholds.fault.rounding * products(free + 1, free + 1)) return {left(0, 0), {}};
  return {left(0, 0), {left(0, 1) * left(0, 1) / left(1, 1), left(0, 1) / left(1, 1)}};
}

}  // namespace

/// Of the rig's columns, the residuals and one more column with one another; for each run, then the priors.
std::vector<Eigen::MatrixXd> Examination::products(const Eigen::VectorXd& column) const {
  Eigen::MatrixXd all(residuals_.size(), columns_.cols() + 2);
  all << columns_, residuals_, column;
  std::vector<Eigen::MatrixXd> list;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const auto own = all.middleRows(begin(i), rows(i));
    list.emplace_back(own.transpose() * own);
  }
  const auto priors = all.bottomRows(all.rows() - begins_.back());
  list.emplace_back(priors.transpose() * priors);
  return list;
}

/// As many runs as may be at fault are left out, each time the one without which least is left.
Examination::Suspected Examination::trimmed(const Drawn& effect) const {
  const auto of_runs = products(effect.column);
  Eigen::MatrixXd kept = std::accumulate(of_runs.begin() + 1, of_runs.end(), of_runs.front());
  const auto left = [&](const Eigen::MatrixXd& products) {
    const auto [cost, gain] = left_of(products);
    return std::pair{cost - (effect.possible(gain.amplitude) ? gain.drop : 0.0), gain.amplitude};
  };
  const auto [cost, amplitude] = left(kept);
  Suspected best{&effect, Kept(runs_.size(), true), cost, amplitude};
  for (std::size_t odd = 0; odd < runs_.size() / (thresholds.fault.sound_for_one + 1); ++odd) {
    std::size_t oddest = 0;
    best.cost = infinite;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (!best.kept[i]) continue;
      const auto [fewer_cost, fewer_amplitude] = left(kept - of_runs[i]);
      if (fewer_cost >= best.cost) continue;
      best.cost = fewer_cost;
      best.amplitude = fewer_amplitude;
      oddest = i;
    }
    best.kept[oddest] = false;
    kept -= of_runs[oddest];
  }
  return best;
}

namespace {

/// What all runs being early is told from by nothing: it would only be larger.
bool is_a_delay(const Candidate& candidate) {
  return candidate.effect == plant::CommandDelay::name || candidate.effect == plant::ReadingDelay::name;
}

}  // namespace

/// Each effect with all runs early by the same whole number of ticks.
std::vector<Examination::Suspected> Examination::beside_lateness(const Regression& alone) const {
  std::vector<Suspected> list;
  for (const Late& late : lates_) {
    Regression all = alone;
    all.add(late.column);
    for (const Drawn& effect : drawn_) {
      if (is_a_delay(*effect.candidate)) continue;
      Regression with = alone;
      with.add(effect.column);
      if (std::abs(with.gain(late.column, 0).amplitude - late.ticks) > thresholds.fault.whole_tick) continue;
      const auto [drop, amplitude] = all.gain(effect.column, 0);
      list.push_back({&effect, Kept(runs_.size(), true), all.cost() - drop, amplitude, late.ticks});
    }
  }
  return list;
}

/// Those that leave far less of a run than `at_best` any effect leaves; each effect in its best shape.
std::vector<Examination::Suspected> Examination::most_promising(std::vector<Suspected> list,
                                                                double at_best) const {
  const double limit = thresholds.fault.worth_suspecting * at_best / static_cast<double>(runs_.size());
  std::erase_if(list, [&](const Suspected& one) {
    return one.cost_of_a_run() > limit || !one.effect->possible(one.amplitude);
  });
  std::stable_sort(list.begin(), list.end(),
                   [](const Suspected& a, const Suspected& b) { return a.cost < b.cost; });
  std::set<const Candidate*> listed;
  std::erase_if(list, [&](const Suspected& one) { return !listed.insert(one.effect->candidate).second; });
  if (list.size() > thresholds.fault.most_suspected) list.resize(thresholds.fault.most_suspected);
  return list;
}

Suspicion Examination::told(const Suspected& one) const {
  const Candidate& c = *one.effect->candidate;
  Suspicion suspicion{
      .effect = {.candidate = c, .amplitude = c.absent + one.amplitude, .shape = one.effect->shape},
      .sound = {},
      .common = {}};
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (one.kept[i]) suspicion.sound.push_back(runs_[i]);
    if (one.late != 0)
      suspicion.common.push_back({runs_[i], FaultKind::late, static_cast<double>(one.late), 0, true});
  }
  return suspicion;
}

/// First what leaves least of a run.
std::vector<Suspicion> Examination::suspicions(const Regression& alone, double at_best) const {
  std::vector<Suspected> without_a_few;
  without_a_few.reserve(drawn_.size());
  for (const Drawn& effect : drawn_) without_a_few.push_back(trimmed(effect));
  auto list = most_promising(std::move(without_a_few), at_best);
  for (auto& late : most_promising(beside_lateness(alone), at_best)) list.push_back(std::move(late));
  std::stable_sort(list.begin(), list.end(), [](const Suspected& a, const Suspected& b) {
    return a.cost_of_a_run() < b.cost_of_a_run();
  });
  std::vector<Suspicion> best;
  best.reserve(list.size());
  for (const Suspected& one : list) best.push_back(told(one));
  return best;
}

/// Of a few runs: what is suspected is looked at again with the others.
std::vector<Suspicion> Examination::suspicions_of_a_few() const {
  const Runs few = asked(experiment_.data(), runs_);
  Examination of_few(*this, few);
  of_few.draw_effects();
  const Examination drawn(of_few, Brief{});
  const Regression numbers = drawn.regression(Kept(few.size(), true));
  auto list = drawn.suspicions(numbers, numbers.cost() - drawn.most_gained(numbers));
  for (Suspicion& suspicion : list) {
    if (suspicion.common.empty()) continue;
    Fault fault = suspicion.common.front();
    suspicion.common.clear();
    for (const std::size_t run : runs_) {
      fault.run = run;
      suspicion.common.push_back(fault);
    }
  }
  return list;
}

}  // namespace mckibben::diagnose
