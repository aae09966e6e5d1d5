// A search among sets of effects and bench faults: what it has found, and where it has looked.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <sim/data/parts.hpp>
#include <sim/identify/decide.hpp>
#include <sim/identify/decisive.hpp>
#include <sim/identify/identify.hpp>
#include <sim/identify/screen.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::identify {

// How far the search goes.
inline constexpr std::size_t tries = 6;           // that are begun, of a look
inline constexpr std::size_t most_rivals = 3;     // of a name
inline constexpr double worth = decisive.strong;  // nats, of another try
inline constexpr double clear = 20.0;             // nats behind: hopeless
inline constexpr double far_off = 3.0;  // deviations of a parameter: something may stand in its place
inline constexpr double alike = 0.9;    // squared cosine of what both change

inline constexpr std::array families{Terms::smooth, Terms::waves, Terms::rubs};

using Names = std::vector<std::string>;

/// The budget is used up.
struct OutOfWork : run::Interrupted {};

class Search {
 public:
  Search(const Problem& problem, const Settings& settings)
      : problem_(problem),
        settings_(settings),
        dictionary_(problem.dictionary),
        rows_(problem.rows),
        unlike_(data::are_branches(problem.rows.data()) || data::have_own_lengths(problem.rows.data())) {}

  /// The rig as described: there is a result from here on.
  void begin();
  /// Until nothing gains any more. Throws run::Interrupted; what was found by then stands.
  void go_on();

  bool is_out_of_work() const { return problem_.simulator.passes() > settings_.most_passes; }
  /// What `go_on` has not done to its end.
  std::vector<std::string> not_done() const;
  /// Decides on the table.
  Identified found() &&;

 private:
  using Key = std::pair<bool, Names>;  // described; names

  void say(const std::string& what) const {
    if (problem_.say) problem_.say(what);
  }
  /// Begins something that takes a while.
  void step(const std::string& what) const {
    if (settings_.trying) settings_.trying(what);
    if (is_out_of_work()) throw OutOfWork();
  }
  double enter(Model& model, bool described = false);
  double best_score() const;
  /// Goes on from a model if it is better; whether it is.
  bool take(Model model) {
    if (!(model.score > here_->score)) return false;
    here_ = std::move(model);
    return true;
  }
  Model started(Point point, double term_N = 1.0) const;
  /// After one round of the descent to the most probable numbers.
  Model begun(Point point) const;
  Model refined(Model started);
  Model refined(Point point, double term_N = 1.0);
  /// By more than chance; where all is explained, a parameter by itself.
  static bool bent(const Model& model) {
    const Eigen::VectorXd& z = model.point.z;
    return z.size() > 0 &&
           (z.cwiseAbs().maxCoeff() > far_off ||
            (!model.error.explains() &&
             z.squaredNorm() > chi_square(decisive.bent, static_cast<std::size_t>(z.size()))));
  }
  std::vector<Start> starts_from(const Model& base, const Eigen::MatrixXd& columns,
                                 const std::vector<Probe>& probes, const Point& point,
                                 const Eigen::VectorXd& residual, const Eigen::MatrixXd& slopes,
                                 bool far) const;
  /// What a part of a model changes, and the rest.
  struct Part {
    Point rest;
    Eigen::VectorXd change;
    double log_prior;                  ///< of its size
    std::optional<std::size_t> place;  ///< among the model's effects; none: it differs from run to run
  };
  std::vector<Part> parts_of(const Model& base) const;
  std::vector<Start> alike_to(const Model& base, const Part& part, const Eigen::MatrixXd& columns,
                              const std::vector<Probe>& probes, double least = alike) const;
  std::pair<Point, double> resized(const Model& base, Point point, const Point& rest) const;
  std::vector<Start> twins(const Model& base, const Eigen::MatrixXd& columns,
                           const std::vector<Probe>& probes) const;
  std::vector<Start> around(const Model& base, const Eigen::MatrixXd& columns,
                            const std::vector<Probe>& probes, const std::vector<Part>& parts, bool far) const;
  std::vector<Probe> still_worth(const Model& base, const std::vector<Part>& parts) const;
  bool look_from(Model base, bool far, bool first);
  void prune();
  void drop_what_may_be_nothing();
  std::vector<Start> of_other_sides(const Model& base, const Part& part) const;
  void try_rivals(const Model& base, const std::vector<Start>& starts, const Part& part);
  using Instead = std::function<std::vector<Point>(const Added& found, std::size_t entry, Point rest)>;
  void try_laws(const Instead& instead);
  void try_other_laws();
  void try_simpler_laws();
  void describe_bench();
  double gain_of_terms(const Model& base) const;
  void try_terms();

  const Problem& problem_;
  const Settings& settings_;
  const Dictionary& dictionary_;
  const Rows& rows_;
  const bool unlike_;  ///< no run's label, zero or gain can be told from hysteresis, or from its length
  std::map<Key, Model> table_;
  std::optional<Model> here_, at_;
  /// What the last look saw of all candidates.
  struct {
    std::vector<Probe> list;
    Eigen::MatrixXd columns;
  } seen_;
  std::set<std::pair<Names, std::vector<double>>> begun_;
  std::set<Names> hills_;
  std::size_t stage_ = 0;
  std::vector<Names> untried_;                ///< of the look that is under way
  std::map<std::string, double> promised_{};  ///< nats that a look saw in a name alone, the most of them
  bool explained_ = false;                    ///< all, by what was begun last
  bool outside_ = false;                      ///< general terms explain more than any set of the catalogue
};

}  // namespace mckibben::identify
