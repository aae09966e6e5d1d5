// See the header.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/data/finding.hpp>
#include <sim/identify/gaps.hpp>
#include <sim/identify/held_out.hpp>
#include <sim/identify/identify.hpp>
#include <sim/identify/search.hpp>

namespace mckibben::identify {

using Eigen::Index;

namespace {

constexpr int rounds = 4;
constexpr int first_rounds = 4;      // of the parameters, before effects are looked for
constexpr double to_the_end = 0.05;  // nats that are promised: a third of a deviation

/// What a search does one after the other, as it is told where it was ended.
constexpr std::array stages{"the rig's parameters", "effects and bench faults",
                            "general terms, for what is outside the catalogue"};

}  // namespace

double Search::enter(Model& model, bool described) {
  const Names names = dictionary_.names(model.point);
  model.score = model.log_evidence + log_prior_of_set(names.size(), dictionary_.all_names) +
                (names.empty() || described ? std::log(0.5) : 0.0);
  for (const Added& added : model.point.effects)
    model.score -= std::log(static_cast<double>(dictionary_.laws_of(dictionary_.entries[added.entry].name)));
  if (const std::size_t few = model.point.members.size() / together(model.point.terms); few > 0)
    model.score +=
        log_prior_of_set(few, dictionary_.count_of_terms(model.point.terms) / together(model.point.terms));
  const Key key{described, names};
  const auto known = table_.find(key);
  if (known == table_.end())
    table_.emplace(key, model);
  else if (known->second.hopeless || (!model.hopeless && model.score > known->second.score))
    known->second = model;
  if (problem_.say) {
    say(fmt::format(
        "  {}: {:.1f}  model error {:.3f} of {:.3f}, {:.2f} s; wander {:.4f}; left {:.3f}; z'z {:.1f}; {} "
        "passes",
        described       ? "as described"
        : names.empty() ? "parameters"
                        : fmt::format("{}", fmt::join(names, " + ")),
        model.score, model.error.of_model() / rows_.unit, model.error.white() / rows_.unit,
        model.error.length_s(), model.error.wander_units(), model.left(), model.point.z.squaredNorm(),
        problem_.simulator.passes()));
  }
  return model.score;
}

double Search::best_score() const {
  double best = -std::numeric_limits<double>::infinity();
  for (const auto& [key, model] : table_) best = std::max(best, model.score);
  return best;
}

/// At the beginning of a descent. None depends on those before it.
Model Search::started(Point point, double term_N) const {
  const Names names = dictionary_.names(point);
  step(names.empty() ? "trying other numbers" : fmt::format("trying {}", fmt::join(names, " + ")));
  Model m(problem_, std::move(point), at_->error.begun(), term_N);
  m.look();
  return m;
}

Model Search::begun(Point point) const {
  Model m = started(std::move(point));
  m.settle({.rounds = 1});
  return m;
}

Model Search::refined(Model m) {
  m.settle({.beat = best_score() - clear});
  if (m.hopeless)
    m.log_evidence = m.here().evidence;
  else
    m.evidence();
  enter(m);
  return m;
}

Model Search::refined(Point point, double term_N) {
  return refined(started(std::move(point), term_N));
}

/// By straight lines from a model, its error as it is: as sets are compared.
double Search::gain_of_terms(const Model& base) const {
  const Eigen::VectorXd left = base.residual(), of_rig = base.variance();
  double best = 0.0;
  if (!dictionary_.forces_show) return best;
  for (const Terms terms : families) {
    const Eigen::MatrixXd columns = columns_of(base, terms);
    Eigen::MatrixXd both(left.size(), base.slopes.cols() + columns.cols());
    both << base.slopes, columns;
    const Grams grams = base.error.grams(left, both);
    const Eigen::MatrixXd gram = grams.sum();
    const Index n = base.slopes.cols();
    const double without =
        log_evidence(gram.topLeftCorner(n + 1, n + 1), grams.log_det(), left.size(), of_rig);
    for (const double scale_N : decisive.terms_N) {
      Eigen::VectorXd variance(gram.rows() - 1);
      variance << of_rig, Eigen::VectorXd::Constant(columns.cols(), scale_N * scale_N);
      best = std::max(best, log_evidence(gram, grams.log_det(), left.size(), variance) - without);
    }
  }
  return best;
}

/// Other laws of the effects found, from the points that each is tried at in the place of one found.
void Search::try_laws(const Instead& instead) {
  const Point found = here_->point;
  for (std::size_t i = 0; i < found.effects.size(); ++i) {
    const Entry& law = dictionary_.entries[found.effects[i].entry];
    for (std::size_t k = 0; law.effect && k < dictionary_.entries.size(); ++k)
      if (dictionary_.entries[k].effect && dictionary_.entries[k].name == law.name)
        for (Point& point : instead(found.effects[i], k, found.without(i))) take(refined(std::move(point)));
  }
}

/// A law of an effect that is not the rig's may explain all with numbers that the sheet forbids, where
/// another law of the same effect needs none: those from the rig as described, from every shape, as their
/// valleys are apart.
void Search::try_other_laws() {
  try_laws([&](const Added& found, std::size_t entry, Point rest) {
    std::vector<Point> points;
    const Entry& other = dictionary_.entries[entry];
    if (other.effect->variant == dictionary_.entries[found.entry].effect->variant) return points;
    rest.z.setZero();
    for (const auto& shapes : other.begin)
      points.push_back(rest.with(dictionary_.clipped({entry, 1.0, shapes})));
    return points;
  });
}

/// A law of two terms may have been found where one of them is enough, as its range of shapes is wide:
/// without the term, from where the law stands.
void Search::try_simpler_laws() {
  try_laws([&](const Added& found, std::size_t entry, const Point& rest) {
    std::vector<Point> points;
    const Entry &law = dictionary_.entries[found.entry], &other = dictionary_.entries[entry];
    if (other.effect->amplitude != law.effect->amplitude || other.shapes.size() >= law.shapes.size())
      return points;
    Added simpler{entry, found.size, std::vector<double>(other.shapes.size(), 0.0)};
    for (std::size_t s = 0; s < other.shapes.size(); ++s)
      for (std::size_t j = 0; j < law.shapes.size(); ++j)
        if (law.shapes[j].path == other.shapes[s].path)
          simpler.shapes[s] = other.shapes[s].z(law.shapes[j].value(found.shapes[j]));
    points.push_back(rest.with(dictionary_.clipped(std::move(simpler))));
    return points;
  });
}

/// Where the bench is wrong, the rig may be as described: effects, too, may make up for what the fit on the
/// way to a large fault left.
void Search::describe_bench() {
  Point point = here_->point;
  std::erase_if(point.effects,
                [&](const Added& one) { return dictionary_.entries[one.entry].bench == nullptr; });
  if (point.terms != Terms::none || dictionary_.names(point).empty()) return;
  point.z.resize(0);
  Model m(problem_, std::move(point), here_->error);
  m.look();
  m.settle({});
  m.evidence();
  enter(m, true);
}

/// Is it a law outside the catalogue? Of families of terms, as straight lines; then of the few of them that
/// promise most, descended.
void Search::try_terms() {
  if (!dictionary_.forces_show) return;
  std::vector<Model> bases{*at_, table_.at({false, {}})};
  if (!dictionary_.names(here_->point).empty()) bases.push_back(*here_);
  std::optional<Few> one, several;
  for (const Model& base : bases)
    for (const Terms terms : families) {
      step("trying general terms");
      const Eigen::MatrixXd columns = columns_of(base, terms);
      for (const double scale_N : decisive.terms_N) {
        Model m = base.with_terms(terms, columns, scale_N);
        enter(m);
        if (terms == Terms::rubs || !std::isfinite(m.score)) continue;  // no rig carries rubs
        for (const double few_N : decisive.few_N)
          for (Few& few : few_of(m, few_N))
            if (std::optional<Few>& best = few.is_one() ? one : several; !best || few.value > best->value)
              best = std::move(few);
      }
    }
  const auto descend = [&](const Few& few) {
    if (take(refined(few.point, few.term_N))) prune();  // names and bent parameters may have stood for it
  };
  if (one) descend(*one);
  if (several && several->value > one->value && !here_->error.explains()) descend(*several);
}

void Search::begin() {
  // rows
  step("simulating the rig as described");
  say(fmt::format(" {} rows, {:.4g} s apart, of {} runs; unit {:.3g}, count {:.3g}, noise {:.3g}",
                  rows_.size(), rows_.row_s, rows_.runs.size(), rows_.unit, rows_.count,
                  fmt::join(rows_.noise, " ")));
  const Wander wander = problem_.simulator.wander(dictionary_.setting(dictionary_.described()));
  at_.emplace(problem_, dictionary_.nominal(), Error(rows_, wander, settings_.threads));
  at_->look();
  // fit
  Model described(problem_, dictionary_.described(), at_->error);
  described.read = at_->read;
  described.slopes = Eigen::MatrixXd(rows_.size(), 0);
  described.fit_error({1.0, 0.5, 0.25});
  described.evidence();
  enter(described, true);
  at_->error = described.error;
}

void Search::go_on() {
  step("fitting the rig's parameters");
  Model parameters = *at_;
  parameters.settle({.rounds = first_rounds});
  parameters.evidence();
  if (!parameters.arrived && parameters.error.explains() && !bent(parameters)) {
    parameters.settle({});
    parameters.evidence();
  }
  enter(parameters);
  here_ = parameters;
  stage_ = 1;
  // screen and descend: as seen from the rig as described, whose parameters have not bent to imitate what is
  // missing (unless these explain all), or from where they were fitted; then from wherever the best stands,
  // and from its effects with the parameters as described where these had to bend.
  std::set<Names> looked;
  const bool near = parameters.error.explains();
  if (!near) {
    looked.insert(Names{});
    look_from(*at_, true, true);
  } else if (bent(parameters)) {
    look_from(parameters, false, true);
  }
  if (!parameters.arrived) {
    parameters.settle({.beat = best_score() - clear});
    parameters.hopeless = false;  // it is told whatever it is
    parameters.evidence();
    if (enter(parameters) > here_->score) here_ = parameters;
  }
  const bool contends = bent(parameters) && parameters.score > here_->score - clear;
  if (!near && (contends || !explained_) && !dictionary_.names(here_->point).empty())
    look_from(table_.at({false, {}}), false, true);
  for (int round = 0; round < rounds && !outside_; ++round) {
    const Names names = dictionary_.names(here_->point);
    if (bent(*here_) && looked.insert(names).second) {
      if (here_->off_sheet() > decisive.conflict) try_other_laws();
      Point q = here_->point;
      q.z.setZero();
      Model base(problem_, q, here_->error);
      base.look();
      if (!base.read.allFinite()) continue;
      if (here_->error.explains()) take(refined(std::move(q)));  // the same, on this side of the valley
      look_from(base, true, false);
    } else if (!look_from(*here_, false, names.empty())) {
      break;
    }
  }
  step("fitting what was found to the end");  // for intervals
  Model last(problem_, here_->point, here_->error);
  last.look();
  last.settle({.enough = to_the_end});
  last.evidence();
  enter(last);
  take(std::move(last));
  drop_what_may_be_nothing();
  try_simpler_laws();
  stage_ = 2;
  describe_bench();
  if (!here_->error.explains()) try_terms();
  stage_ = stages.size();
}

std::vector<std::string> Search::not_done() const {
  std::vector<std::string> list;
  for (std::size_t i = stage_; i < stages.size(); ++i) list.emplace_back(stages.at(i));
  for (const Names& names : untried_) list.push_back(fmt::format("trying {}", fmt::join(names, " + ")));
  return list;
}

Identified Search::found() && {
  Identified result;
  const auto groups = groups_of(rows_);
  // Wide intervals make the log density of a wild prediction a good one: general terms that miss unseen runs
  // by more than the catalogue's most probable model are no law.
  const auto missed = [&](const Model& m) { return rows_.rms(unpredicted(m, groups)); };
  const auto counts = [](const Model& m) { return std::isfinite(m.score) && !m.hopeless; };
  const auto is_general = [](const Model& m) { return m.point.terms != Terms::none; };
  // Nor does anything explain of whose misses the rig as described would close most: its error and wander do.
  const Model* named = nullptr;
  for (const auto& [key, m] : table_)
    if (counts(m) && !is_general(m) && (named == nullptr || m.score > named->score)) named = &m;
  const auto most = [&](const Model* m) {
    return m != nullptr && counts(*m) ? missed(*m) : std::numeric_limits<double>::infinity();
  };
  const auto described = table_.find({true, {}});
  const double most_of_terms = most(named),
               most_of_all = most(described != table_.end() ? &described->second : nullptr) /
                             std::sqrt(1.0 - diagnose::thresholds.tell.closed);
  const double noise = std::max(rows_.noise.front(), rows_.count / std::sqrt(12.0));
  for (auto& [key, m] : table_) {
    if (!counts(m)) continue;
    const double misses = missed(m);
    if ((is_general(m) && misses > most_of_terms) || misses > most_of_all) continue;
    result.table.push_back({.names = key.second,
                            .faults = dictionary_.faults_of_runs(m.point),
                            .described = key.first,
                            .general = is_general(m),
                            .score = m.score,
                            .held_out = held_out(m, groups),
                            .above_noise = std::max(0.0, misses * misses - noise * noise),
                            .off_sheet = m.off_sheet()});
    result.models.push_back(std::move(m));
  }
  if (result.table.empty()) throw data::UnfitData(rows_.data(), "no model of the rig goes through all runs");
  result.decision = decide(result.table);
  result.promised = std::move(promised_);
  result.passes = problem_.simulator.passes();
  return result;
}

Identified identify(domain::Dataset data, const Settings& settings) {
  diagnose::Search limit(settings.time_limit_s);
  auto study = std::make_shared<const Study>(std::move(data), settings);
  if (settings.known != nullptr) study->simulator.keep(*settings.known);
  Search search(study->problem, settings);
  search.begin();
  limit.part("", [&] { search.go_on(); });
  Simulated simulated = study->simulator.kept();
  const bool worked = search.is_out_of_work();
  std::vector<std::string> not_done = search.not_done();
  Identified found = std::move(search).found();
  found.study = std::move(study);
  found.ended = limit.ended();
  if (found.ended != Ended::no) {
    if (found.ended == Ended::by_time && worked) found.ended = Ended::by_work;
    found.not_done = std::move(not_done);
    found.simulated = std::move(simulated);
  }
  return found;
}

}  // namespace mckibben::identify
