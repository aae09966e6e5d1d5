// See the header.
#include <algorithm>
#include <functional>

#include <Eigen/Cholesky>

#include <sim/diagnose/subsets.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const SubsetThresholds& subsets_by = thresholds.subset;

/// What the members change, and how that lies along the gap.
struct Gram {
  Eigen::MatrixXd products;
  Eigen::VectorXd along;

  explicit Gram(const std::vector<const Score*>& scores) {
    const auto count = static_cast<Eigen::Index>(scores.size());
    products.resize(count, count);
    along.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Score& one = *scores[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j <= i; ++j)
        products(i, j) = products(j, i) = one.column.dot(scores[static_cast<std::size_t>(j)]->column);
      along[i] = (one.amplitude - one.candidate.absent) * products(i, i);
    }
  }
};

/// The least squares of some of them: sizes, and what they explain. Zero where two are alike to rounding.
struct Solved {
  Eigen::VectorXd sizes;
  double drop = 0.0;
};
Solved solve(const Gram& gram, const std::vector<Eigen::Index>& members) {
  Eigen::MatrixXd products = gram.products(members, members);
  const Eigen::VectorXd along = gram.along(members);
  // In units of each, so that "alike" means the same for all.
  const Eigen::VectorXd scale = products.diagonal().cwiseSqrt().cwiseInverse();
  products = scale.asDiagonal() * products * scale.asDiagonal();
  const Eigen::LDLT<Eigen::MatrixXd> factors(products);
  if (factors.vectorD().minCoeff() < subsets_by.apart) return {Eigen::VectorXd::Zero(along.size()), 0.0};
  const Eigen::VectorXd sizes = scale.asDiagonal() * factors.solve(scale.asDiagonal() * along);
  return {sizes, sizes.dot(along)};
}

bool allowed(const Candidate& candidate, double change) {
  return candidate.either_sign || (change > 0.0) == (candidate.typical > 0.0);
}

/// The same effect of the same muscle.
bool overlap(const Candidate& a, const Candidate& b) {
  return a.effect == b.effect && (a.side == b.side || a.side == Side::both || b.side == Side::both);
}

/// Each member explains something that the others do not.
bool all_needed(const Gram& gram, const std::vector<Eigen::Index>& members, double drop) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    auto others = members;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const double lost = drop - solve(gram, others).drop;
    if (lost < thresholds.near.clear || lost < subsets_by.needed * drop) return false;
  }
  return true;
}

}  // namespace

std::vector<Subset> best_subsets(const std::vector<Score>& scores) {
  std::vector<const Score*> pool;
  for (const Score& score : scores)
    if (score.column.size() > 0 && score.column.squaredNorm() > thresholds.screen.least_norm)
      pool.push_back(&score);
  const Gram gram(pool);
  std::vector<Subset> found;
  std::vector<Eigen::Index> members;
  const auto judge = [&] {
    const Solved solved = solve(gram, members);
    if (!(solved.drop > thresholds.near.clear)) return;
    for (std::size_t i = 0; i < members.size(); ++i)
      if (!allowed(pool[static_cast<std::size_t>(members[i])]->candidate,
                   solved.sizes[static_cast<Eigen::Index>(i)]))
        return;
    if (found.size() == subsets_by.kept && solved.drop <= found.back().drop) return;
    if (!all_needed(gram, members, solved.drop)) return;
    Subset subset{.members = {}, .drop = solved.drop};
    for (std::size_t i = 0; i < members.size(); ++i) {
      Score score = *pool[static_cast<std::size_t>(members[i])];
      score.amplitude = score.candidate.absent + solved.sizes[static_cast<Eigen::Index>(i)];
      subset.members.push_back(std::move(score));
    }
    const auto place = std::upper_bound(found.begin(), found.end(), subset,
                                        [](const Subset& a, const Subset& b) { return a.drop > b.drop; });
    found.insert(place, std::move(subset));
    if (found.size() > subsets_by.kept) found.pop_back();
  };
  const std::function<void(Eigen::Index)> grow = [&](Eigen::Index from) {
    if (members.size() >= 2) judge();
    if (members.size() == subsets_by.most_effects) return;
    for (Eigen::Index next = from; next < gram.along.size(); ++next) {
      const auto overlaps = [&](Eigen::Index member) {
        return overlap(pool[static_cast<std::size_t>(member)]->candidate,
                       pool[static_cast<std::size_t>(next)]->candidate);
      };
      if (std::ranges::any_of(members, overlaps)) continue;
      members.push_back(next);
      grow(next + 1);
      members.pop_back();
    }
  };
  grow(0);
  return found;
}

}  // namespace mckibben::diagnose
