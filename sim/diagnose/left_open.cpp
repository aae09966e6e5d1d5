// Eigenvectors of the whole matrix mix all numbers: directions of few are looked for first, and each that is
// found is closed by holding one of its numbers.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/diagnose/left_open.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const LeftOpenThresholds& of_open = thresholds.left_open;

using Numbers = std::vector<Eigen::Index>;  ///< by their place among the free parameters

/// A way in which these numbers may move, in their scales; all others stand.
struct Direction {
  Numbers numbers;
  Eigen::VectorXd way;
  double information;  ///< along it
};

Direction least_known(const Eigen::MatrixXd& information, const Numbers& numbers) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(Eigen::MatrixXd(information(numbers, numbers)));
  return {numbers, solved.eigenvectors().col(0), solved.eigenvalues()[0]};
}

/// Calls `visit` with each choice of `size` of these numbers.
template <class Visit>
void each_choice(const Numbers& from, std::size_t size, const Visit& visit) {
  std::vector<bool> taken(from.size(), false);
  std::fill(taken.begin(), taken.begin() + static_cast<std::ptrdiff_t>(size), true);
  do {
    Numbers choice;
    for (std::size_t i = 0; i < from.size(); ++i)
      if (taken[i]) choice.push_back(from[i]);
    visit(choice);
  } while (std::prev_permutation(taken.begin(), taken.end()));
}

/// Without numbers that hardly take part.
Direction told_apart(const Direction& direction) {
  const double most = direction.way.cwiseAbs().maxCoeff();
  Direction clear{{}, {}, direction.information};
  std::vector<double> way;
  for (std::size_t i = 0; i < direction.numbers.size(); ++i) {
    const double part = direction.way[static_cast<Eigen::Index>(i)];
    if (std::abs(part) < of_open.takes_part * most) continue;
    clear.numbers.push_back(direction.numbers[i]);
    way.push_back(part);
  }
  clear.way = Eigen::Map<Eigen::VectorXd>(way.data(), static_cast<Eigen::Index>(way.size()));
  return clear;
}

/// The direction of fewest numbers, of those the least known; none if all are known.
std::optional<Direction> next_open(const Eigen::MatrixXd& information, const Numbers& left) {
  std::optional<Direction> least;
  const auto look = [&](const Numbers& numbers) {
    Direction found = least_known(information, numbers);
    if (found.information < of_open.says_nothing && (!least || found.information < least->information))
      least = std::move(found);
  };
  for (std::size_t size = 1; size <= std::min(of_open.few, left.size()); ++size) {
    each_choice(left, size, look);
    if (least) return least;
  }
  if (!left.empty()) look(left);
  if (least) least = told_apart(*least);
  return least;
}

std::vector<Direction> open_directions(const Eigen::MatrixXd& information) {
  Numbers left(static_cast<std::size_t>(information.cols()));
  std::iota(left.begin(), left.end(), 0);
  std::vector<Direction> list;
  while (auto direction = next_open(information, left)) {
    Eigen::Index held = 0;
    direction->way.cwiseAbs().maxCoeff(&held);
    std::erase(left, direction->numbers[static_cast<std::size_t>(held)]);
    list.push_back(std::move(*direction));
  }
  return list;
}

/// Directions that have numbers in common.
struct Group {
  Numbers numbers;
  std::vector<Direction> directions;
};

std::vector<Group> grouped(const std::vector<Direction>& directions) {
  std::vector<Group> groups;
  for (const Direction& direction : directions) {
    Group merged{direction.numbers, {direction}};
    std::erase_if(groups, [&](const Group& other) {
      const bool common = std::any_of(other.numbers.begin(), other.numbers.end(), [&](Eigen::Index number) {
        return std::find(merged.numbers.begin(), merged.numbers.end(), number) != merged.numbers.end();
      });
      if (!common) return false;
      merged.numbers.insert(merged.numbers.end(), other.numbers.begin(), other.numbers.end());
      merged.directions.insert(merged.directions.end(), other.directions.begin(), other.directions.end());
      return true;
    });
    std::sort(merged.numbers.begin(), merged.numbers.end());
    merged.numbers.erase(std::unique(merged.numbers.begin(), merged.numbers.end()), merged.numbers.end());
    groups.push_back(std::move(merged));
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.numbers.front() < b.numbers.front(); });
  return groups;
}

/// The one combination of a group's numbers that is known: the weights of their changes, the largest 1.
/// `relative`: changes over the numbers themselves.
Eigen::VectorXd known_combination(const Group& group, const std::vector<FittedOne>& all, bool relative) {
  const auto count = static_cast<Eigen::Index>(group.numbers.size());
  Eigen::MatrixXd open = Eigen::MatrixXd::Zero(count, count);
  Eigen::Index row = 0;
  for (const Direction& direction : group.directions) {
    for (std::size_t i = 0; i < direction.numbers.size(); ++i) {
      const auto place = std::find(group.numbers.begin(), group.numbers.end(), direction.numbers[i]);
      const FittedOne& number = all[static_cast<std::size_t>(direction.numbers[i])];
      open(row, place - group.numbers.begin()) =
          direction.way[static_cast<Eigen::Index>(i)] * number.scale / (relative ? number.value : 1.0);
    }
    open.row(row++).normalize();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(Eigen::MatrixXd(open.transpose() * open));
  const Eigen::VectorXd weights = solved.eigenvectors().col(0);  // at right angles to all that are open
  Eigen::Index largest = 0;
  weights.cwiseAbs().maxCoeff(&largest);
  return weights / weights[largest];
}

/// Whether each weight is 1 or -1, and how many are -1.
std::optional<Eigen::Index> opposed(const Eigen::VectorXd& weights) {
  if ((weights.cwiseAbs().array() - 1.0).abs().maxCoeff() > of_open.equal) return std::nullopt;
  return (weights.array() < 0.0).count();
}

/// What is known of a group, where it is one combination: product, ratio, sum, difference; empty if no such
/// word fits.
std::string known_of(const Group& group, const std::vector<FittedOne>& all) {
  const auto of = [&](auto&& holds) {
    return std::all_of(group.numbers.begin(), group.numbers.end(),
                       [&](Eigen::Index number) { return holds(all[static_cast<std::size_t>(number)]); });
  };
  const bool pair = group.numbers.size() == 2;
  if (of([](const FittedOne& number) { return number.value != 0.0; }))
    if (const auto against = opposed(known_combination(group, all, true))) {
      if (*against == 0) return "product";
      if (pair) return "ratio";
    }
  const std::string& unit = all[static_cast<std::size_t>(group.numbers.front())].unit;
  if (of([&](const FittedOne& number) { return number.unit == unit; }))
    if (const auto against = opposed(known_combination(group, all, false))) {
      if (*against == 0) return "sum";
      if (pair) return "difference";
    }
  return {};
}

LeftOpen told(const Group& group, const std::vector<FittedOne>& all) {
  LeftOpen open;
  for (const Eigen::Index number : group.numbers)
    open.parameters.push_back(all[static_cast<std::size_t>(number)].path);
  const std::string names = listed(open.parameters);
  const std::size_t known = group.numbers.size() - group.directions.size();
  if (known == 0) {
    open.known = "nothing";
    open.words = fmt::format("{} {} not determined", names, open.parameters.size() == 1 ? "is" : "are");
    return open;
  }
  if (known == 1) open.known = known_of(group, all);
  if (!open.known.empty()) {
    open.words = fmt::format("only the {} of {} is known", open.known, names);
    return open;
  }
  open.known = "combination";
  open.words = known == 1 ? fmt::format("{} are known together only: one combination of them", names)
                          : fmt::format("of {} only {} combinations are known", names, known);
  return open;
}

}  // namespace

std::vector<LeftOpen> left_open(const Eigen::MatrixXd& information, const std::vector<FittedOne>& numbers) {
  std::vector<LeftOpen> list;
  for (const Group& group : grouped(open_directions(information))) list.push_back(told(group, numbers));
  return list;
}

}  // namespace mckibben::diagnose
