// To the most probable numbers of a model, those of its runs included; see model.hpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <sim/identify/decisive.hpp>
#include <sim/identify/model.hpp>

namespace mckibben::identify {

using Eigen::Index;

namespace {

constexpr std::array lengths{1.0, 0.3, 0.1};  // of steps that are tried, of the longest
constexpr int chords = 3;                     // steps by the same slopes
constexpr double shortest = 0.003;            // step that is worth a simulation, in deviations of the priors

}  // namespace

void Model::descend(const Effort& effort) {
  const Dictionary& dictionary = problem->dictionary;
  double reach = 3.0;
  constexpr double again = 5.0;  // times as much as in the last round
  double evidence_before = -std::numeric_limits<double>::infinity();
  arrived = hopeless = false;
  if (!read.allFinite()) return;
  if (slopes.cols() == 0) {  // nothing to move
    arrived = true;
    return;
  }
  if (far) error = error.forgetting();
  for (int round = 0; round < effort.rounds; ++round) {
    fit_error(round == 0 ? std::vector{1.0, 0.5} : std::vector{0.5},
              far ? std::vector<std::size_t>{Error::model_sd} : std::vector<std::size_t>{});
    Quadratic quadratic = this->quadratic(error.grams(residual(), slopes).sum());
    const double promised = quadratic.promised(), before = cost(read, point);
    if (far && promised < 1.0) {
      far = false;
      error = error.fitted_anew(residual(), slopes, variance());
      continue;
    }
    if (promised < effort.enough) {
      arrived = true;
      return;
    }
    if (std::isfinite(effort.beat) && !far) {  // by another error evidence may sink on the way
      const Here stands = this->here();
      hopeless = !stands.explains &&
                 stands.evidence + again * std::max(stands.evidence - evidence_before, 0.0) < effort.beat;
      if (hopeless) return;
      evidence_before = stands.evidence;
    }
    // Steps by the same slopes, as long as they serve.
    double here = before;
    for (int chord = 0; chord < chords; ++chord) {
      const Eigen::VectorXd v = dictionary.vector(point);
      const double wanted = quadratic.promised();
      reach = std::min(reach, quadratic.longest());
      std::vector<Point> tried;
      std::vector<Setting> settings{dictionary.setting(point)};
      for (const double length : lengths) {
        tried.push_back(dictionary.moved(point, v + quadratic.step(length * reach)));
        settings.push_back(dictionary.setting(tried.back()));
      }
      Eigen::MatrixXd reads = problem->simulator.differences(settings).rightCols(std::ssize(lengths));
      reads.colwise() += read;
      std::size_t best = 0;
      std::array<double, lengths.size()> costs{};
      for (std::size_t i = 0; i < tried.size(); ++i) {
        costs[i] = cost(reads.col(static_cast<Index>(i)), tried[i]);
        if (costs[i] < costs[best]) best = i;
      }
      if (problem->say)
        problem->say(
            fmt::format("    round {}.{}: cost {:.1f} promised {:.1f} -> {:.1f} {:.1f} {:.1f} reach {:.2f} "
                        "error {:.3f}, {:.2f} s",
                        round, chord, here, wanted, costs[0], costs[1], costs[2], reach,
                        error.of_model() / problem->rows.unit, error.length_s()));
      const double gained = here - costs[best];
      if (!(gained > 0.01)) {
        if (chord == 0) reach *= 0.3 * lengths.back();
        break;
      }
      const Eigen::VectorXd moved = dictionary.vector(tried[best]) - v;
      const Eigen::VectorXd missed =
          (reads.col(static_cast<Index>(best)) - read - slopes * moved) / moved.squaredNorm();
      point = tried[best];
      read = reads.col(static_cast<Index>(best));
      here = costs[best];
      slopes.noalias() += missed * moved.transpose();  // Broyden
      if (best > 0)
        reach = moved.norm();
      else if (gained > 0.5 * wanted || quadratic.longest() > 1.01 * reach)
        reach = 3.0 * std::max(moved.norm(), 0.3 * reach);
      if (gained < 0.3 * wanted) break;
      quadratic = this->quadratic(error.grams(residual(), slopes).sum());
      if (quadratic.promised() < effort.enough) break;
    }
    if (before - here < effort.enough) {
      if (reach > shortest) continue;
      arrived = true;  // kinks promise what no step finds
      return;
    }
    open_ = quadratic.open();
    look();
  }
}

bool Model::place() {
  std::vector<std::size_t> placed;
  for (std::size_t i = 0; i < point.differ.size(); ++i)
    if (is_simulated(point.differ[i])) placed.push_back(i);
  if ((placed.empty() && error.starts() == 0) || point.terms != Terms::none || !read.allFinite())
    return false;
  constexpr double matters = 0.02, of_start = 0.1;  // of what is typical, of a deviation
  bool moved = false;
  for (int pass = 0; pass < 3; ++pass) {
    std::vector<std::size_t> scales{Error::model_sd};
    for (const std::size_t i : placed) scales.push_back(error.scale_of_differing(i));
    fit_error({1.0, 0.5}, scales);
    const Eigen::VectorXd weight = variance().cwiseInverse(), v = problem->dictionary.vector(point);
    const Index k = v.size();
    const Eigen::MatrixXd gram = error.grams(residual(), slopes).sum();
    Eigen::VectorXd still = residual();
    if (k > 0)
      still -=
          slopes *
          curvature(gram, weight).llt().solve(Eigen::VectorXd(gram.col(0).tail(k) - weight.cwiseProduct(v)));
    const Grams left = error.grams(still, Eigen::MatrixXd(read.size(), 0));
    Point there = point;
    for (const std::size_t i : placed) there.of_runs[static_cast<std::size_t>(point.differ[i])].clear();
    there.starts.clear();
    double furthest = 0.0;  // of what matters
    for (std::size_t run = 0; run < left.means.size(); ++run) {
      const Eigen::VectorXd& mean = left.means[run];
      for (const std::size_t i : placed) {
        const auto which = static_cast<std::size_t>(point.differ[i]);
        const auto& before = point.of_runs[which];
        there.of_runs[which].push_back(mean[static_cast<Index>(i)]);
        const double by = there.of_runs[which].back() - (before.empty() ? 0.0 : before[run]);
        furthest = std::max(furthest, std::abs(by) / (matters * differing[which].typical));
      }
      if (error.starts() > 0) {
        there.starts.emplace_back(mean.tail(static_cast<Index>(error.starts())));
        const Eigen::VectorXd before = point.starts.empty()
                                           ? Eigen::VectorXd::Zero(there.starts.back().size()).eval()
                                           : point.starts[run];
        furthest = std::max(furthest, (there.starts.back() - before).cwiseAbs().maxCoeff() / of_start);
      }
    }
    if (furthest < 1.0) break;
    Eigen::VectorXd would_read = problem->simulator.read(problem->dictionary.setting(there));
    if (!would_read.allFinite()) break;
    point = std::move(there);
    read = std::move(would_read);
    look_at_wander();
    moved = true;
  }
  return moved;
}

void Model::share_common_load() {
  const Dictionary& dictionary = problem->dictionary;
  const auto offset = std::ranges::find(dictionary.parameters, "joint.load_offset", &Dictionary::Free::path);
  std::vector<double>& loads_kg = point.of_runs[loads];
  if (!point.lets_differ(loads) || loads_kg.empty() || point.z.size() == 0 ||
      offset == dictionary.parameters.end())
    return;
  const auto place = static_cast<std::size_t>(std::ranges::find(point.differ, loads) - point.differ.begin());
  const double of_runs = std::pow(error.scale(place), -2.0), unit_kg = offset->scale;
  double& z = point.z[offset - dictionary.parameters.begin()];
  for (int pass = 0; pass < 50; ++pass) {  // normals that touch Student's t
    const double weight = (decisive.tails + 1.0) / (decisive.tails + z * z);
    double sum_kg = 0.0;
    for (const double load_kg : loads_kg) sum_kg += load_kg;
    const double runs = static_cast<double>(loads_kg.size());
    const double to_runs_kg =
        (weight * z / unit_kg - of_runs * sum_kg) / (weight / (unit_kg * unit_kg) + runs * of_runs);
    z -= to_runs_kg / unit_kg;
    for (double& load_kg : loads_kg) load_kg += to_runs_kg;
  }
}

void Model::settle(const Effort& effort) {
  place();
  for (int pass = 0; pass < 3; ++pass) {
    descend(effort);
    share_common_load();
    if (hopeless || !place()) break;
  }
}

}  // namespace mckibben::identify
