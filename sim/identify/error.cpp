// See the header.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

#include <sim/identify/decisive.hpp>
#include <sim/identify/error.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::identify {

using Eigen::Index;

Eigen::MatrixXd Grams::sum() const {
  Eigen::MatrixXd all = of_runs.front();
  for (std::size_t run = 1; run < of_runs.size(); ++run) all += of_runs[run];
  return all;
}
double Grams::log_det() const {
  double all = 0.0;
  for (const double one : log_dets) all += one;
  return all;
}

namespace {

/// A model that errs at a point errs at its neighbours, however far apart in time.
double usual_length_s(const Rows& rows) {
  return std::max(decisive.error_length_s, rows.row_s);
}

}  // namespace

Error::Error(const Rows& rows, const Wander& wander, unsigned threads) : rows_(&rows), threads_(threads) {
  logs_ = {std::log(rows.count > 0.0 ? 0.1 * rows.count : rows.noise.front()), std::log(rows.unit),
           std::log(usual_length_s(rows))};
  for (std::size_t kind = 1; kind < rows.kinds.size(); ++kind)
    logs_.insert(logs_.end(), {std::log(rows.noise[kind]), std::log(rows.noise[kind])});
  logs_.insert(logs_.end(), {std::log(0.03), std::log(0.3)});  // where a wander of none has no slope
  start_ = logs_;
  // Kept from here on: how compliant the rig was when it was first looked at.
  Eigen::VectorXd compliance = wander.together.cwiseAbs();
  double square = 0.0, count = 0.0;
  for (const Block& block : rows.blocks)
    if (rows.is_judged(block)) {
      square += compliance.segment(block.begin, block.rows).squaredNorm();
      count += static_cast<double>(block.rows);
    }
  const double rms = std::sqrt(square / count);
  if (rms > 0.0)
    compliance /= rms;
  else
    compliance.setOnes();
  for (const Block& block : rows.blocks)
    if (!rows.is_judged(block)) compliance.segment(block.begin, block.rows).setOnes();
  compliance_ = std::make_shared<const Eigen::VectorXd>(std::move(compliance));
  take(wander);
}

void Error::take(const Wander& wander) {
  const auto fixed = static_cast<Index>(differing.size());
  RowMajor random(rows_->size(), fixed + wander.columns.cols());
  random.setZero();
  for (const Block& block : rows_->blocks) {
    const auto read = wander.read.segment(block.begin, block.rows);
    for (Index i = 0; i < block.rows; ++i) {  // one recorder has all readings of a run
      const Index before = std::max<Index>(i - 1, 0), after = std::min(i + 1, block.rows - 1);
      if (after > before)
        random(block.begin + i, delays) =
            (read[before] - read[after]) / (static_cast<double>(after - before) * rows_->row_s);
    }
    if (!rows_->is_judged(block)) continue;
    random.col(zeros).segment(block.begin, block.rows).setOnes();
    random.col(gains).segment(block.begin, block.rows) = read;
    random.col(label_of(rows_->data())).segment(block.begin, block.rows) =
        wander.label.segment(block.begin, block.rows);
    random.col(drifts).segment(block.begin, block.rows) =
        Eigen::VectorXd::LinSpaced(block.rows, 0.0, static_cast<double>(block.rows - 1) * rows_->row_s);
  }
  random.rightCols(wander.columns.cols()) = wander.columns;
  std::vector<Eigen::MatrixXd> roots;
  for (const auto& knots : wander.knots) {
    const auto k = static_cast<Index>(knots.size());
    Eigen::MatrixXd alike(k, k);
    for (Index i = 0; i < k; ++i)
      for (Index j = 0; j < k; ++j)
        alike(i, j) =
            std::exp(-std::abs(knots[static_cast<std::size_t>(i)] - knots[static_cast<std::size_t>(j)]) /
                     decisive.wander_s);
    roots.push_back(alike.llt().matrixL());
  }
  starts_ = wander.starts;
  random_ = std::make_shared<const RowMajor>(std::move(random));
  roots_ = std::make_shared<const std::vector<Eigen::MatrixXd>>(std::move(roots));
}

Eigen::VectorXd Error::started(const Block& block, const Eigen::VectorXd& start) const {
  const Index first = std::ssize(differing) + (*roots_)[block.run].rows();
  return random_->block(block.begin, first, block.rows, start.size()) * start;
}

namespace {

double typical_log(int which, const domain::Dataset& data) {
  // A gauge is off by 20 mbar and a load cell by a newton as easily as an encoder by a millimetre.
  const double of_a_metre = data.judged() == domain::Judged::pressure ? 2e6
                            : data.judged() == domain::Judged::force  ? 1e3
                                                                      : 1.0 / data.rig.muscle.rest_length_m;
  const Differing& one = differing.at(static_cast<std::size_t>(which));
  return std::log(which == zeros || which == drifts ? one.typical * of_a_metre : one.typical);
}

}  // namespace

Error Error::with(const std::vector<int>& differ) const {
  if (differ == differ_) return *this;
  Error other = *this;
  other.logs_.resize(base());
  other.start_.resize(base());
  for (const int which : differ) {
    const auto known = std::ranges::find(differ_, which);
    other.start_.push_back(typical_log(which, rows_->data()));
    other.logs_.push_back(known == differ_.end()
                              ? other.start_.back()
                              : logs_[base() + static_cast<std::size_t>(known - differ_.begin())]);
  }
  other.differ_ = differ;
  return other;
}

Error Error::forgetting() const {
  Error other = *this;
  other.logs_[2] = std::log(0.05);
  return other;
}
Error Error::begun() const {
  Error other = *this;
  other.logs_ = start_;
  return other;
}

double Error::white() const {
  const double jitter = std::exp(logs_[0]);
  return std::sqrt(rows_->count * rows_->count / 12.0 + jitter * jitter);
}
double Error::length_s() const {
  return std::exp(logs_[2]);
}
double Error::wander_units() const {
  return std::exp(logs_[wander_at()]);
}
double Error::gain(Index row) const {
  const double of_rig = (*compliance_)[row], constant = std::exp(logs_[constant_at()]);
  return std::sqrt(of_rig * of_rig + constant * constant);
}
double Error::of_model() const {
  double square = 0.0, count = 0.0;
  for (const Block& block : rows_->blocks)
    if (rows_->is_judged(block))
      for (Index i = block.begin; i < block.begin + block.rows; ++i) {
        square += gain(i) * gain(i);
        count += 1.0;
      }
  return std::exp(logs_[1]) * std::sqrt(square / count);
}

RowMajor Error::rows_of(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns) const {
  RowMajor all(residual.size(), 1 + columns.cols());
  all.col(0) = residual;
  all.rightCols(columns.cols()) = columns;
  return all;
}

/// Of a block: of given columns, then of what differs, then of its run's wander and start.
Whitened Error::whitened(const Block& block, const RowMajor& columns) const {
  const bool judged = rows_->is_judged(block);
  const std::size_t other = 3 + 2 * (block.kind - 1);
  const double jitter = std::exp(logs_[0]), q = rows_->count;
  // Of what counting adds, what jitter does not wash out stays (Widrow & Kollar 2008).
  double stays_square = 0.0;
  if (judged && q > 0.0)
    for (int k = 1; k <= 5; ++k) {
      const double turns = 2.0 * std::numbers::pi * k * jitter / q;
      stays_square += q * q * std::exp(-turns * turns) / (2.0 * std::numbers::pi * std::numbers::pi * k * k);
    }
  const auto begin = static_cast<std::size_t>(block.begin);
  RowErrors errors{
      .white_square = judged ? white() * white() - std::min(stays_square, white() * white())
                             : std::exp(2.0 * logs_[other]),
      .model_square = std::exp(2.0 * (judged ? logs_[model_sd] : logs_[other + 1])),
      .counting_square = stays_square,
      .alike = std::exp(-rows_->row_s / length_s()),
      .gain = std::vector<double>(static_cast<std::size_t>(block.rows), 1.0),
      .known = rows_->known.data() + begin,
      .stays = rows_->stays.data() + begin,
  };
  if (judged)
    for (Index i = 0; i < block.rows; ++i) errors.gain[static_cast<std::size_t>(i)] = gain(block.begin + i);
  const Index p = columns.cols(), more = std::ssize(differ_);
  const Index wanders = (*roots_)[block.run].rows() + static_cast<Index>(starts_);
  return identify::whitened(errors, p + more + wanders, [&](Index i, double* row) {
    const double* random = random_->row(block.begin + i).data();
    row = std::copy_n(columns.row(block.begin + i).data(), p, row);
    for (const int which : differ_) *row++ = random[which];
    std::copy_n(random + differing.size(), wanders, row);
  });
}

void Error::whiten(const RowMajor& columns, const std::vector<Whitened*>& blocks) const {
  constexpr Index worth_a_thread = 1'000'000;  // products: what it takes to begin one
  std::vector<std::size_t> missing;
  Index products = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (blocks[b]->gram.size() == 0) {
      missing.push_back(b);
      products += rows_->blocks[b].rows * columns.cols() * columns.cols();
    }
  std::atomic<std::size_t> next{0};
  const auto most = std::min(missing.size(), 1 + static_cast<std::size_t>(products / worth_a_thread));
  run::side_by_side(threads_, most, [&] {
    for (std::size_t i = next++; i < missing.size(); i = next++)
      *blocks[missing[i]] = whitened(rows_->blocks[missing[i]], columns);
  });
}

Grams Error::integrated(const std::vector<Whitened*>& blocks, Index p) const {
  const std::size_t runs = rows_->runs.size();
  std::vector<Eigen::MatrixXd> grams(runs);
  Grams result;
  result.log_dets.assign(runs, 0.0);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t run = rows_->blocks[b].run;
    if (grams[run].size() == 0)
      grams[run] = blocks[b]->gram;
    else
      grams[run] += blocks[b]->gram;
    result.log_dets[run] += blocks[b]->log_det;
  }
  const Index more = std::ssize(differ_);
  for (std::size_t run = 0; run < runs; ++run) {
    const Eigen::MatrixXd& gram = grams[run];
    const Index k = gram.rows() - p;
    Eigen::MatrixXd root = Eigen::MatrixXd::Zero(k, k);
    for (Index j = 0; j < more; ++j) root(j, j) = std::exp(logs_[base() + static_cast<std::size_t>(j)]);
    const Index knots = (*roots_)[run].rows();
    root.block(more, more, knots, knots) = (*roots_)[run] * wander_units();
    root.bottomRightCorner(k - more - knots, k - more - knots).setIdentity();
    const Eigen::MatrixXd inner =
        Eigen::MatrixXd::Identity(k, k) + root.transpose() * gram.bottomRightCorner(k, k) * root;
    const Eigen::LLT<Eigen::MatrixXd> low(inner);
    const Eigen::MatrixXd half = low.matrixL().solve(root.transpose() * gram.bottomLeftCorner(k, p));
    result.of_runs.emplace_back(gram.topLeftCorner(p, p) - half.transpose() * half);
    result.log_dets[run] += 2.0 * low.matrixLLT().diagonal().array().log().sum();
    const auto starts = static_cast<Index>(starts_);
    if (more + starts > 0) {
      const Eigen::MatrixXd whole = low.matrixL().solve(Eigen::MatrixXd(root.transpose()));
      Eigen::MatrixXd back(k, more + starts);
      back << whole.leftCols(more), whole.rightCols(starts);
      result.means.emplace_back(back.transpose() * half.col(0));
      result.deviations.emplace_back(back.colwise().norm().transpose());
    }
  }
  return result;
}

Grams Error::grams(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns) const {
  const RowMajor all = rows_of(residual, columns);
  std::vector<Whitened> made(rows_->blocks.size());
  std::vector<Whitened*> blocks;
  for (Whitened& block : made) blocks.push_back(&block);
  whiten(all, blocks);
  return integrated(blocks, all.cols());
}

double log_evidence(const Eigen::MatrixXd& gram, double log_det, Index rows,
                    const Eigen::VectorXd& variance) {
  const Index k = gram.rows() - 1;
  double value = -0.5 * (static_cast<double>(rows) * std::log(2.0 * std::numbers::pi) + log_det + gram(0, 0));
  if (k == 0) return value;
  const Eigen::VectorXd s = variance.cwiseSqrt();
  const Eigen::MatrixXd inner =
      Eigen::MatrixXd::Identity(k, k) + s.asDiagonal() * gram.bottomRightCorner(k, k) * s.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> low(inner);
  const Eigen::VectorXd half = low.matrixL().solve(Eigen::VectorXd(s.cwiseProduct(gram.col(0).tail(k))));
  return value - low.matrixLLT().diagonal().array().log().sum() + 0.5 * half.squaredNorm();
}

std::vector<double> Error::key(std::size_t b) const {
  const auto place = static_cast<double>(b);
  if (rows_->is_judged(rows_->blocks[b]))
    return {place, logs_[0], logs_[model_sd], logs_[2], logs_[constant_at()]};
  const std::size_t other = 3 + 2 * (rows_->blocks[b].kind - 1);
  return {place, logs_[other], logs_[other + 1], logs_[2]};
}

bool Error::allowed() const {
  return logs_[0] >= std::log(0.02 * rows_->unit) && logs_[1] >= std::log(1e-3 * rows_->unit) &&
         logs_[2] >= std::log(0.03) && logs_[2] <= std::log(std::max(20.0, rows_->longest_s)) &&
         std::abs(logs_[constant_at()]) <= std::log(30.0) && logs_[wander_at()] > -9.2 &&
         logs_[wander_at()] < 0.0;
}

double Error::log_prior() const {
  const double length = (logs_[2] - std::log(usual_length_s(*rows_))) / decisive.error_length_sd;
  double value = -0.5 * length * length;
  for (std::size_t j = base(); j < logs_.size(); ++j)
    value -= 0.5 * (logs_[j] - start_[j]) * (logs_[j] - start_[j]);
  return value;
}

double Error::log_scales() const {
  double value = 0.0;
  for (std::size_t j = base(); j < logs_.size(); ++j) {
    value -= 0.5 * (logs_[j] - start_[j]) * (logs_[j] - start_[j]);
    // So many values fix a logarithm to 1/sqrt(2 runs).
    value -= 0.5 * std::log(1.0 + 2.0 * static_cast<double>(rows_->runs.size()));
  }
  return value;
}

std::pair<Error, double> Error::fitted(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns,
                                       const Eigen::VectorXd& variance, std::vector<double> steps,
                                       std::vector<std::size_t> only) const {
  const RowMajor all = rows_of(residual, columns);
  std::map<std::vector<double>, Whitened> known;
  std::map<std::vector<double>, double> values;
  constexpr double impossible = -std::numeric_limits<double>::infinity();
  const auto value_of = [&](const std::vector<double>& logs) {
    if (const auto seen = values.find(logs); seen != values.end()) return seen->second;
    Error there = *this;
    there.logs_ = logs;
    double value = impossible;
    if (there.allowed()) {
      std::vector<Whitened*> blocks;
      for (std::size_t b = 0; b < rows_->blocks.size(); ++b) blocks.push_back(&known[there.key(b)]);
      there.whiten(all, blocks);
      const Grams grams = there.integrated(blocks, all.cols());
      value = log_evidence(grams.sum(), grams.log_det(), residual.size(), variance) + there.log_prior();
    }
    return values[logs] = value;
  };
  if (only.empty())
    for (std::size_t j = 0; j < logs_.size(); ++j) only.push_back(j);
  std::vector<double> here = logs_;
  double best = value_of(here);
  for (const double step : steps)
    for (bool gained = true; gained;) {
      gained = false;
      for (const std::size_t j : only)
        for (const double sign : {1.0, -1.0}) {
          std::vector<double> there = here;
          there[j] += sign * step;
          if (j == 2) there[model_sd] += 0.5 * sign * step;  // the error from row to row as it is
          if (const double value = value_of(there); value > best + 0.05) {
            here = std::move(there);
            best = value;
            gained = true;
            break;
          }
        }
    }
  Error result = *this;
  result.logs_ = std::move(here);
  return {std::move(result), best};
}

Error Error::fitted_anew(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns,
                         const Eigen::VectorXd& variance) const {
  auto best = fitted(residual, columns, variance, {0.5});
  const auto from = [&](const Error& start) {
    auto other = start.fitted(residual, columns, variance, {1.0, 0.5});
    if (other.second > best.second) best = std::move(other);
  };
  from(begun());
  Error white = best.first;
  white.logs_[0] = std::log(std::hypot(std::exp(white.logs_[0]), std::exp(white.logs_[model_sd])));
  white.logs_[model_sd] = white.logs_[0] - std::log(10.0);
  from(white);
  return best.first;
}

}  // namespace mckibben::identify
