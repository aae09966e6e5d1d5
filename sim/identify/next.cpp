// See the header.
#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include <sim/diagnose/plan.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/engine/batch.hpp>
#include <sim/identify/decisive.hpp>
#include <sim/identify/next.hpp>
#include <sim/identify/quadratic.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::identify {

using Eigen::Index;

namespace {

/// What a model reads in a run, and how that changes with its numbers.
struct Foreseen {
  Eigen::VectorXd read;
  Eigen::MatrixXd columns;
};

const std::vector<double>& judged(const diagnose::Readings& readings) {
  return readings.judged();
}
const std::vector<double>& pressure_Pa(const diagnose::Readings& readings) {
  return readings.pressure_Pa;
}

Foreseen foreseen(const Model& model, const domain::Run& run, decltype(judged)& reading = judged) {
  const Dictionary& dictionary = model.problem->dictionary;
  const Eigen::VectorXd v = dictionary.vector(model.point);
  std::vector<diagnose::Loaded> rigs;
  std::vector<double> steps;
  for (Index j = 0; j < v.size(); ++j) {
    Eigen::VectorXd there = v;
    there[j] += std::clamp(std::sqrt(model.covariance(j, j)), 0.01, 0.1);
    const Point moved = dictionary.moved(model.point, there);
    steps.push_back(dictionary.vector(moved)[j] - v[j]);
    rigs.push_back({dictionary.setting(moved).rig, run.load_kg});
  }
  const diagnose::Loaded base{dictionary.setting(model.point).rig, run.load_kg};
  constexpr std::size_t width = engine::Batch::width - 1;
  Foreseen result;
  for (std::size_t first = 0; first == 0 || first < rigs.size(); first += width) {
    std::vector<diagnose::Loaded> group{base};
    const std::size_t last = std::min(first + width, rigs.size());
    for (std::size_t i = first; i < last; ++i) group.push_back(rigs[i]);
    const auto readings = diagnose::predict(run, group, model.problem->rows.data().rig.integrator.method);
    const auto of = [&](std::size_t i) {
      const std::vector<double>& read = reading(readings[i]);
      return Eigen::Map<const Eigen::VectorXd>(read.data(), std::ssize(read));
    };
    if (first == 0) {
      result.read = of(0);
      result.columns = Eigen::MatrixXd::Zero(result.read.size(), v.size());
    }
    for (std::size_t i = first; i < last; ++i)
      if (steps[i] != 0.0) result.columns.col(static_cast<Index>(i)) = (of(i - first + 1) - of(0)) / steps[i];
  }
  return result;
}

/// Variance of the mean of many rows, a row: noise and what the model errs by for long.
double long_variance(const Model& model) {
  const double white = model.error.white(), of_model = model.error.of_model();
  return white * white + 2.0 * of_model * of_model * model.error.length_s() / model.problem->rows.row_s;
}

/// Probability that a model becomes less probable by so much where a run reads `truth`, with this variance.
double power(const Model& model, const Foreseen& by, const Eigen::VectorXd& truth, double variance) {
  const Eigen::VectorXd off = truth - by.read;
  double square = off.squaredNorm();
  if (by.columns.cols() > 0) {
    Eigen::MatrixXd known = Eigen::MatrixXd::Identity(by.columns.cols(), by.columns.cols());
    const Eigen::MatrixXd of_model = curvature(model.grams.sum(), model.variance().cwiseInverse());
    known.topLeftCorner(of_model.rows(), of_model.cols()) = of_model;
    known = variance * known + by.columns.transpose() * by.columns;
    const Eigen::VectorXd along = by.columns.transpose() * off;
    square -= along.dot(known.llt().solve(along));
  }
  const double growth = std::max(square / variance, 0.0);
  return growth > 0.0 ? 0.5 * std::erfc((decisive.strong - 0.5 * growth) / std::sqrt(2.0 * growth)) : 0.0;
}

plant::Rig rig_of(const Model& model) {
  return model.problem->dictionary.setting(model.point).rig;
}

}  // namespace

std::optional<diagnose::NextExperiment> next_measurement(const Model& one, const Model& other,
                                                         std::vector<std::string> names, unsigned threads) {
  return diagnose::plan(one.problem->rows.data(), threads, rig_of(one), rig_of(other), std::move(names),
                        [&](const domain::Run& run) {
                          const Foreseen by_one = foreseen(one, run), by_other = foreseen(other, run);
                          return std::min(power(other, by_other, by_one.read, long_variance(other)),
                                          power(one, by_one, by_other.read, long_variance(one)));
                        });
}

std::optional<diagnose::NextSensor> next_sensor(const Model& one, const Model& other,
                                                std::vector<std::string> names, unsigned threads) {
  const domain::Dataset& data = one.problem->rows.data();
  if (data.pressure_is_given() || data.rig.pair() != nullptr ||
      std::ranges::any_of(data.runs, [](const auto& run) { return run.find("muscle_pressure") != nullptr; }))
    return std::nullopt;
  const plant::Rig rigs[] = {rig_of(one), rig_of(other)};
  const std::vector<std::size_t>& runs = one.problem->rows.runs;
  std::vector<double> apart(runs.size(), 0.0);
  run::for_each_job(
      runs.size(), threads,
      [&](std::size_t i) {
        const domain::Run& run = data.runs[runs[i]];
        const diagnose::Loaded both[] = {{rigs[0], run.load_kg}, {rigs[1], run.load_kg}};
        const auto read = diagnose::predict(run, both, data.rig.integrator.method);
        for (std::size_t k = 0; k < read[0].pressure_Pa.size(); ++k)
          apart[i] += std::pow(read[0].pressure_Pa[k] - read[1].pressure_Pa[k], 2);
      },
      [](std::size_t) {});
  const auto best = static_cast<std::size_t>(std::ranges::max_element(apart) - apart.begin());
  const domain::Run& run = data.runs[runs[best]];
  const auto with_gauge = [&](const Model& model) {
    Foreseen by = foreseen(model, run, pressure_Pa);
    // A gauge has a zero and a gain of its own.
    const diagnose::PlanThresholds& usual = diagnose::thresholds.plan;
    by.columns.conservativeResize(by.read.size(), by.columns.cols() + 2);
    by.columns.rightCols(2) << Eigen::VectorXd::Constant(by.read.size(), usual.gauge_zero_Pa),
        usual.gauge_gain * by.read;
    return by;
  };
  const Foreseen by_one = with_gauge(one), by_other = with_gauge(other);
  // A model errs in pressure, too, for as long as in its other readings: as much as the gauge scatters.
  const double variance = 2.0 * std::pow(diagnose::thresholds.plan.gauge_Pa, 2) * decisive.error_length_s /
                          one.problem->rows.row_s;
  return diagnose::NextSensor{.separates = std::move(names),
                              .run = run.id,
                              .expected_power = std::min(power(other, by_other, by_one.read, variance),
                                                         power(one, by_one, by_other.read, variance))};
}

}  // namespace mckibben::identify
