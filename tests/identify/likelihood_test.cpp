// The likelihood against its formula, with matrices written out; runs held out against the same formula.
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <sim/identify/error.hpp>
#include <sim/identify/quadratic.hpp>

namespace mckibben::identify {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

/// Two runs of counts, one row of which nothing is known of.
struct Made {
  domain::Dataset data;
  std::vector<std::vector<bool>> masked;

  Made() {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    const double count =
        2.0 * std::numbers::pi * data.rig.joint.wheel_radius_m / 8000.0 / data.rig.muscle.rest_length_m;
    for (const std::size_t rows : {150, 40}) {
      domain::Run& run = data.runs.emplace_back();
      run.id = "r";
      run.read("contraction");
      run.load_kg = 11.0 + static_cast<double>(rows);
      for (std::size_t k = 0; k < rows; ++k) {
        const double ratio =
            0.1 + 0.02 * std::sin(0.1 * static_cast<double>(k)) + 0.1 * count * normal(random);
        run.current_mA.push_back(10.0);
        run.judged().values.push_back(count * std::floor(ratio / count));
      }
      masked.emplace_back(rows, false);
    }
    masked[0][20] = true;
  }
};

Wander wander_of(const Rows& rows) {
  Wander wander;
  wander.columns = MatrixXd::Random(rows.size(), 4) * 1e-2;
  wander.knots = {{-1.0, 0.0, 0.4, 0.8}, {-1.0, 0.0, 0.5}};
  for (Index i = rows.blocks[1].begin; i < rows.size(); ++i)
    wander.columns(i, 3) = 0.0;  // it has fewer knots
  wander.read = VectorXd::Random(rows.size());
  wander.label = VectorXd::Random(rows.size()) * 1e-3;
  wander.together = VectorXd::Ones(rows.size());
  return wander;
}

TEST(Likelihood, IsWhatItsFormulaSays) {
  const Made made;
  const Rows rows(made.data, made.masked, {0, 1});
  ASSERT_GT(rows.count, 0.0);
  const Wander wander = wander_of(rows);
  const Error error = Error(rows, wander).with({gains});
  const VectorXd residual = VectorXd::Random(rows.size()) * rows.count;
  const MatrixXd columns =
      MatrixXd::Random(rows.size(), 9) * rows.count;  // of several tiles, the last not full
  const Grams grams = error.grams(residual, columns);

  // As an error begins: jitter 0.1 counts, model error a count for 1 s, wander 0.03, a gain of hypot(1, 0.3).
  const double q = rows.count, jitter = 0.1 * q, gain = std::hypot(1.0, 0.3);
  double staying = 0.0;
  for (int k = 1; k <= 5; ++k)
    staying += q * q * std::exp(-std::pow(2.0 * std::numbers::pi * k * 0.1, 2)) /
               (2.0 * std::pow(std::numbers::pi * k, 2));
  for (std::size_t run = 0; run < 2; ++run) {
    const Block& block = rows.blocks[run];
    std::vector<Index> at;
    for (Index i = 0; i < block.rows; ++i)
      if (rows.known[static_cast<std::size_t>(block.begin + i)] != 0) at.push_back(block.begin + i);
    const Index n = std::ssize(at);
    EXPECT_EQ(n, run == 0 ? 149 : 40);
    MatrixXd sigma = MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j <= i; ++j) {
        double stays = 1.0;
        for (Index k = at[static_cast<std::size_t>(j)]; k < at[static_cast<std::size_t>(i)]; ++k)
          stays *= rows.stays[k];
        const double apart_s = rows.row_s * static_cast<double>(at[static_cast<std::size_t>(i)] -
                                                                at[static_cast<std::size_t>(j)]);
        sigma(i, j) = sigma(j, i) = q * q * gain * gain * std::exp(-apart_s / 1.0) + staying * stays +
                                    (i == j ? q * q / 12.0 + jitter * jitter - staying : 0.0);
      }
    const auto knots = std::ssize(wander.knots[run]);
    const MatrixXd moved = wander.columns(at, Eigen::seqN(0, knots)) * 0.03;
    MatrixXd alike(knots, knots);
    for (Index i = 0; i < knots; ++i)
      for (Index j = 0; j < knots; ++j)
        alike(i, j) = std::exp(-std::abs(wander.knots[run][static_cast<std::size_t>(i)] -
                                         wander.knots[run][static_cast<std::size_t>(j)]) /
                               2.0);
    const VectorXd of_gain = wander.read(at) * 0.03;
    sigma += moved * alike * moved.transpose() + of_gain * of_gain.transpose();
    MatrixXd all(n, 1 + columns.cols());
    all << residual(at), columns(at, Eigen::all);
    const Eigen::LLT<MatrixXd> factor(sigma);
    const MatrixXd expected = all.transpose() * factor.solve(all);
    EXPECT_LT((grams.of_runs[run] - expected).cwiseAbs().maxCoeff(), 1e-7 * expected.cwiseAbs().maxCoeff());
    EXPECT_NEAR(grams.log_dets[run], 2.0 * factor.matrixLLT().diagonal().array().log().sum(), 1e-6);
    // What differs, by the residual alone: the posterior of one number.
    const MatrixXd others = sigma - of_gain * of_gain.transpose();
    const VectorXd seen = others.llt().solve(of_gain);
    const double precision = 1.0 + of_gain.dot(seen);
    EXPECT_NEAR(grams.means[run][0], 0.03 * seen.dot(residual(at)) / precision, 1e-9);
    EXPECT_NEAR(grams.deviations[run][0], 0.03 / std::sqrt(precision), 1e-9);
  }
}

TEST(Likelihood, EvidenceIsThatOfALinearModel) {
  const Index n = 30;
  const MatrixXd x = MatrixXd::Random(n, 3);
  const VectorXd y = VectorXd::Random(n), variance = VectorXd::LinSpaced(3, 0.5, 2.0);
  MatrixXd all(n, 4);
  all << y, x;
  const MatrixXd sigma = MatrixXd::Identity(n, n) + x * variance.asDiagonal() * x.transpose();
  const Eigen::LLT<MatrixXd> factor(sigma);
  const double expected =
      -0.5 * (static_cast<double>(n) * std::log(2.0 * std::numbers::pi) +
              2.0 * factor.matrixLLT().diagonal().array().log().sum() + y.dot(factor.solve(y)));
  EXPECT_NEAR(log_evidence(all.transpose() * all, 0.0, n, variance), expected, 1e-9);
}

TEST(Likelihood, AFitOfTheErrorFindsWhatMadeIt) {
  const Made made;
  const Rows rows(made.data, made.masked, {0, 1});
  const Error begun(rows, wander_of(rows));
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  VectorXd residual(rows.size());
  for (double& one : residual) one = 3.0 * rows.count * normal(random);  // white, three counts
  const auto [error, value] = begun.fitted(residual, MatrixXd(rows.size(), 0), VectorXd(0), {1.0, 0.5, 0.25});
  EXPECT_NEAR(error.white() / rows.count, 3.0, 0.8);
  EXPECT_LT(error.of_model(), error.white());
  EXPECT_GT(value, log_evidence(begun.grams(residual, MatrixXd(rows.size(), 0)).sum(),
                                begun.grams(residual, MatrixXd(rows.size(), 0)).log_det(), rows.size(),
                                VectorXd(0)));
}

TEST(Rows, KnowTheStepInWhichReadingsWereWritten) {
  Made made;
  const double count = Rows(made.data, made.masked, {0, 1}).count;
  for (domain::Run& run : made.data.runs)
    for (std::size_t k = 0; k < run.rows(); ++k)
      run.judged().values[k] =
          3e-3 * std::floor((0.1 + 0.05 * std::sin(0.2 * static_cast<double>(k))) / 3e-3);
  const Rows coarse(made.data, made.masked, {0, 1});
  EXPECT_LT(count, 1e-3);
  EXPECT_NEAR(coarse.count, 3e-3, 1e-6);
}

TEST(Quadratic, HoldsAtTheEndOfItsRangeWhatWouldLeaveIt) {
  const VectorXd at = VectorXd::Zero(2), weight = VectorXd::Constant(2, 1.0);
  const Ends below{VectorXd::Constant(2, -9.0), VectorXd::Constant(2, 9.0)},
      at_end{Eigen::Vector2d(0.0, -9.0), VectorXd::Constant(2, 9.0)};
  for (const double pull : {-10.0, 0.1}) {  // the slope drives it out; only the step would
    MatrixXd gram(3, 3);
    gram << 0.0, pull, 1.0, pull, 3.0, 3.0, 1.0, 3.0, 3.0;
    EXPECT_LT(Quadratic(gram, weight, at, below).step(100.0)[0], 0.0);
    const Quadratic held(gram, weight, at, at_end);
    EXPECT_TRUE(held.step(100.0).isApprox(Eigen::Vector2d(0.0, 0.25), 1e-12)) << held.step(100.0);
    EXPECT_NEAR(held.promised(), 0.125, 1e-12);
  }
}

}  // namespace
}  // namespace mckibben::identify
