// A walk along each valley: lines from where it stands say where to look next. See the header.
#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Cholesky>

#include <sim/diagnose/profile.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/engine/failure.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const IntervalThresholds& profile_by = thresholds.interval;

/// Where the free parameters stand, in their scales, and what the runs say there.
struct Place {
  Eigen::VectorXd at, residuals;
  Eigen::MatrixXd columns;
};

/// The least that lines from a place promise, and where.
struct Promise {
  double cost = 0.0;
  Eigen::VectorXd at{};
};

class Valley {
 public:
  Valley(const Experiment& experiment, const Fitted& fitted, const Runs& runs, double inflation)
      : experiment_(experiment),
        fitted_(fitted),
        runs_(runs),
        inflation_(inflation),
        fit_{scaled_values(fitted.model), fitted.residuals, fitted.columns},
        priors_(Eigen::VectorXd::Zero(size())),
        lowest_(size()),
        highest_(size()) {
    for (Eigen::Index j = 0; j < size(); ++j) {
      const Parameter& p = parameter(j);
      priors_[j] = p.has_prior ? 1.0 : 0.0;
      lowest_[j] = p.scaled(p.lowest);
      highest_[j] = p.scaled(p.highest);
    }
    bottom_ = refitted(fit_, {});
  }

  void look_along(std::size_t number, Bounds& bounds) const {
    if (!std::isfinite(bounds.rise) || !(bounds.half > 0.0)) return;  // nothing is known of it
    const Along along{static_cast<Eigen::Index>(number), bounds.half, bounds.rise};
    const double bound = thresholds.screen.at_bound * (highest_ - lowest_)[along.number];
    if (room(along, -1.0) <= bound || room(along, 1.0) <= bound) return;
    if (!is_settled(along, fit_, bottom_.cost)) return;
    const auto down = first_look(along, -1.0), up = first_look(along, 1.0);
    if (is_parabola(along, down, up)) return;
    const Parameter& p = parameter(along.number);
    const auto lower = end(along, -1.0, down), upper = end(along, 1.0, up);
    if (!lower || !upper) return;
    const double low = p.unscaled(*lower), high = p.unscaled(*upper);
    bounds.quadratic = {bounds.low, bounds.high};
    bounds.low = std::min(low, high);
    bounds.high = std::max(low, high);
    bounds.determined = bounds.low > p.lowest || bounds.high < p.highest;
  }

 private:
  /// The number that is looked along, half of its quadratic interval, and the rise there.
  struct Along {
    Eigen::Index number;
    double half, rise;
  };
  struct Look {
    double way;                  ///< from the fit
    std::optional<Place> place;  ///< none: the rig cannot be simulated there
    double rise;
    double surplus;  ///< over the parabola's
  };

  Eigen::Index size() const { return static_cast<Eigen::Index>(fitted_.model.free.size()); }
  const Parameter& parameter(Eigen::Index j) const { return fitted_.model.free[static_cast<std::size_t>(j)]; }

  double cost(const Eigen::VectorXd& residuals, const Eigen::VectorXd& at) const {
    return residuals.squaredNorm() / inflation_ + priors_.dot(at.cwiseAbs2());
  }

  /// One Gauss-Newton step of all numbers but one that is held, along the slopes of a place. What would leave
  /// its bounds stays there, and the others make up for it.
  Promise refitted(const Place& place, std::optional<Eigen::Index> held) const {
    Eigen::MatrixXd normal = place.columns.transpose() * place.columns / inflation_;
    normal.diagonal() += priors_;
    const Eigen::VectorXd downhill =
        place.columns.transpose() * place.residuals / inflation_ - priors_.cwiseProduct(place.at);
    normal.diagonal().array() += thresholds.screen.ridge;
    Eigen::VectorXd step = Eigen::VectorXd::Zero(size());
    std::vector<Eigen::Index> moving;
    for (Eigen::Index j = 0; j < size(); ++j)
      if (j != held) moving.push_back(j);
    for (bool stopped = true; stopped && !moving.empty();) {
      step(moving).setZero();
      const Eigen::VectorXd free = (downhill - normal * step)(moving);
      const Eigen::VectorXd solved = Eigen::MatrixXd(normal(moving, moving)).ldlt().solve(free);
      step(moving) = solved;
      stopped = std::erase_if(moving, [&](Eigen::Index j) {
                  const double to = place.at[j] + step[j], within = std::clamp(to, lowest_[j], highest_[j]);
                  step[j] = within - place.at[j];
                  return within != to;
                }) > 0;
    }
    const Eigen::VectorXd at = place.at + step;
    return {cost(place.residuals - place.columns * step, at), at};
  }

  /// Where lines from a place put the others if the number goes so far from the fit.
  Eigen::VectorXd bed(const Along& along, const Place& place, double way) const {
    Place moved = place;
    const double step = fit_.at[along.number] + way - place.at[along.number];
    moved.at[along.number] += step;
    moved.residuals -= step * place.columns.col(along.number);
    return refitted(moved, along.number).at;
  }

  /// Slopes of nominal parameters, which hardly move, are those at the fit.
  std::optional<Place> look_at(const Along& along, Eigen::VectorXd at) const {
    std::vector<Parameter> fresh;
    std::vector<Eigen::Index> places;
    for (Eigen::Index j = 0; j < size(); ++j)
      if (!parameter(j).has_prior || j == along.number) {
        fresh.push_back(parameter(j));
        places.push_back(j);
      }
    try {
      auto told = experiment_.fine_slopes(rig_at(fitted_.model, at.data()), fresh, runs_);
      Place place{std::move(at), std::move(told.residuals), fit_.columns};
      place.columns(Eigen::all, places) = told.columns;
      return place;
    } catch (const engine::NumericalFailure&) {
      return std::nullopt;
    }
  }

  double rise(const Along& along, const Place& place) const {
    return refitted(place, along.number).cost - bottom_.cost;
  }
  /// Whether a place keeps what lines from it promise: where loads stick it may not.
  bool is_settled(const Along& along, const Place& place, double promised) const {
    return cost(place.residuals, place.at) - promised < profile_by.tolerance * along.rise;
  }
  /// How far it is to a bound.
  double room(const Along& along, double sign) const {
    const double at = fit_.at[along.number];
    return std::max(0.0, sign > 0.0 ? highest_[along.number] - at : at - lowest_[along.number]);
  }

  Look first_look(const Along& along, double sign) const {
    const double way = std::min(along.half, room(along, sign));
    const double from_bottom = sign * way - (bottom_.at - fit_.at)[along.number];
    auto place = look_at(along, bed(along, fit_, sign * way));
    if (!place) return {way, {}, 0.0, 0.0};
    const double risen = rise(along, *place);
    return {way, std::move(place), risen, risen - along.rise * std::pow(from_bottom / along.half, 2)};
  }

  /// By both looks together, how wide the interval is, and where its middle lies.
  static bool is_parabola(const Along& along, const Look& down, const Look& up) {
    if (!down.place || !up.place) return false;
    const double wider = 0.5 * (up.surplus + down.surplus), beside = 0.5 * (up.surplus - down.surplus);
    return std::max(std::abs(wider), std::abs(beside)) <= profile_by.trusted * along.rise;
  }

  /// Where the cost has risen so far, or the bound; nothing if the walk does not arrive.
  std::optional<double> end(const Along& along, double sign, Look look) const {
    double inner = 0.0, outer = room(along, sign);
    Place from = fit_;    // the last that could be simulated
    bool walled = false;  // `outer` is too far, and not just as far as is allowed
    for (int round = 0; round < profile_by.rounds; ++round) {
      double next = 0.5 * (inner + look.way);
      if (look.place) {
        const bool far = look.rise > along.rise;
        const bool arrived = std::abs(look.rise / along.rise - 1.0) < profile_by.tolerance ||
                             (!far && look.way >= room(along, sign));
        if (arrived && is_settled(along, *look.place, bottom_.cost + look.rise))
          return fit_.at[along.number] + sign * look.way;
        (far ? outer : inner) = look.way;
        walled = walled || far;
        from = *std::move(look.place);
        next =
            look.way *
            std::sqrt(along.rise / std::max(look.rise, along.rise / (profile_by.stride * profile_by.stride)));
        if (walled && (next <= inner || next >= outer)) next = 0.5 * (inner + outer);
        next = std::min(next, outer);
      } else {
        outer = look.way;
        walled = true;
      }
      look.way = next;
      look.place = look_at(along, bed(along, from, sign * next));
      look.rise = look.place ? rise(along, *look.place) : 0.0;
    }
    return std::nullopt;
  }

  const Experiment& experiment_;
  const Fitted& fitted_;
  const Runs& runs_;
  double inflation_;
  Place fit_;
  Eigen::VectorXd priors_, lowest_, highest_;
  Promise bottom_;  ///< of all
};

}  // namespace

std::vector<std::size_t> worth_a_profile(const Model& model) {
  std::vector<std::size_t> list;
  for (std::size_t j = 0; j < model.free.size(); ++j) {
    const Parameter& p = model.free[j];
    const bool far =
        p.has_prior && std::abs(p.deviations(value_of(model.rig, p.path))) > thresholds.parameter.notable;
    if (far || std::ranges::any_of(model.effects, [&](const Candidate& c) { return c.moves(p.path); }))
      list.push_back(j);
  }
  return list;
}

void trust_or_profile(const Experiment& experiment, const Fitted& fitted, const Runs& runs, double inflation,
                      const std::vector<std::size_t>& which, std::vector<Bounds>& bounds) {
  if (which.empty()) return;
  const Valley valley(experiment, fitted, runs, inflation);
  for (const std::size_t number : which) valley.look_along(number, bounds[number]);
}

}  // namespace mckibben::diagnose
