// See the header.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <span>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/data/parts.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/identify/decisive.hpp>
#include <sim/identify/dictionary.hpp>

namespace mckibben::identify {
namespace {

constexpr std::array<BenchNumber, 4> of_loads_and_clocks{
    {{"load_label", "offset", "kg", &Bench::load_offset_kg, 1.0, -8.0, 12.0},
     {"load_label", "factor", "1", &Bench::load_factor, 0.05, -0.6, 1.0},
     {"reading_clock", "rate", "1", &Bench::clock, 0.01, -0.3, 0.3},
     {"reading_clock", "offset", "s", &Bench::ahead_s, 0.02, 0.0, 1.0}}};  // late readings are the rig's
/// What a load cell reads with nothing on it.
constexpr std::array<BenchNumber, 1> of_load_cells{
    {{"reading_zero", "offset", "N", &Bench::zero, 5.0, -100.0, 100.0}}};

/// A law with a term more, as one: the term's size is one of its shapes.
std::optional<diagnose::Candidate> whole(const diagnose::Candidate& c,
                                         const std::vector<diagnose::Candidate>& all) {
  const auto base = std::ranges::find_if(all, [&](const diagnose::Candidate& one) {
    return one.effect == c.effect && one.side == c.side && one.variant == c.adds_to;
  });
  if (base == all.end()) return std::nullopt;
  constexpr double most = 30.0;  // times what is typical of a term, and as little
  diagnose::Candidate law = *base;
  law.variant = c.variant;
  law.further = {{c.amplitude, c.typical, {c.typical}, c.typical / most, c.typical * most}};
  return law;
}

/// Of a law of several numbers: each further one alone, beside each value of the first.
void add_shapes(Entry& entry) {
  const diagnose::Candidate& c = *entry.effect;
  const auto add = [&](const std::string& path, double lowest, double highest) {
    const bool positive = lowest > 0.0;
    entry.shapes.push_back({.path = path,
                            .middle = positive ? std::sqrt(highest * lowest) : 0.5 * (lowest + highest),
                            .deviation = (positive ? std::log(highest / lowest) : highest - lowest) / 4.0,
                            .logarithmic = positive,
                            .furthest = c.own ? 2.0 : Shape{}.furthest});  // its file says how far
  };
  if (!c.shape.empty()) add(c.shape, c.shapes.front(), c.shapes.back());
  for (const diagnose::Further& one : c.further) add(one.path, one.lowest, one.highest);
  entry.begin.clear();
  const std::vector<diagnose::Candidate> variations = c.variations();
  for (const double first : c.shape.empty() ? std::vector{0.0} : c.shapes)
    for (const diagnose::Candidate& one : variations) {
      std::vector<double> values;
      if (!c.shape.empty()) values.push_back(first);
      for (const diagnose::Further& further : one.further) values.push_back(further.value);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = entry.shapes[i].z(values[i]);
      entry.begin.push_back(std::move(values));
    }
  if (!c.shape.empty())  // the typical one first
    std::rotate(entry.begin.begin(), entry.begin.begin() + std::ssize(variations), entry.begin.end());
}

Entry entry_of(const diagnose::Candidate& c, const plant::Rig& rig) {
  plant::Rig copy = c.chosen(rig);
  const diagnose::Found size = diagnose::find(copy, c.amplitude);
  Entry entry{.name = diagnose::full_name(c.effect, "", c.side),
              .effect = c,
              .absent = c.absent,
              .typical = c.typical,
              .either_sign = c.either_sign};
  const double one = (size.lowest - c.absent) / c.typical, other = (size.highest - c.absent) / c.typical;
  entry.lowest = std::min(one, other);
  entry.highest = std::max(one, other);
  if (!c.either_sign) entry.lowest = std::max(entry.lowest, decisive.least);
  if (!c.further.empty() || c.own) {
    add_shapes(entry);
  } else if (!c.shape.empty()) {
    entry.shapes = {
        {c.shape, c.shapes[c.shapes.size() / 2], std::log(c.shapes.back() / c.shapes.front()) / 4.0}};
    entry.begin = {{0.0}, {-2.0}, {2.0}};
  }
  return entry;
}

/// Whether a file with this rig is read, for these data.
bool is_read(const domain::Dataset& data, const plant::Rig& rig) {
  const auto hangs = [&](const domain::Run& run) {
    return !rig.lifts_a_load() || (run.measured && run.measured->gives_outer_force()) ||
           rig.can_hang(run.load_kg);
  };
  return domain::broken_rule(rig).empty() && std::ranges::all_of(data.runs, hangs);
}

/// Its range ends where no file would be read, all else as described.
void keep_readable(const domain::Dataset& data, diagnose::Parameter& p) {
  plant::Rig rig = data.rig;
  if (!is_read(data, rig)) return;
  const auto reads = [&](double value) {
    p.put(rig, value);
    return is_read(data, rig);
  };
  for (double* end : {&p.lowest, &p.highest}) {
    const double near_it = std::lerp(*end, p.origin, 0.01);  // 0 alone may say that there is none
    if (reads(*end) && reads(near_it)) continue;
    double inside = p.origin;
    for (int i = 0; i < 40; ++i) {
      const double middle = std::midpoint(inside, *end);
      (reads(middle) ? inside : *end) = middle;
    }
    *end = inside;
  }
}

constexpr std::size_t wave_pairs = 14, rub_places = 8;

/// What a coordinate of a point moves.
template <class P>
auto& at(P& point, const Coordinate& one) {
  const auto of = static_cast<Eigen::Index>(one.of);
  switch (one.kind) {
    case Kind::size:
      return point.effects[one.of].size;
    case Kind::shape:
      return point.effects[one.of].shapes[one.which];
    case Kind::term:
      return point.coefficients[of];
    case Kind::stretch:
      return point.stretches[of];
    case Kind::parameter:
      break;
  }
  return point.z[of];
}

}  // namespace

void Entry::put(plant::Rig& rig, double size, const std::vector<double>& with) const {
  const bool both = rig.pair() != nullptr && effect->side == diagnose::Side::both;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    diagnose::Parameter{.path = shapes[i].path, .both_sides = both}.put(rig, with[i]);
  effect->put(rig, size);
}

bool Point::has(std::size_t entry) const {
  return std::ranges::any_of(effects, [&](const Added& one) { return one.entry == entry; });
}
bool Point::lets_differ(int which) const {
  return std::ranges::find(differ, which) != differ.end();
}
Point Point::with(Added added) const {
  Point more = *this;
  more.effects.push_back(std::move(added));
  std::ranges::sort(more.effects, {}, &Added::entry);
  return more;
}
Point Point::without(std::size_t place) const {
  Point fewer = *this;
  fewer.effects.erase(fewer.effects.begin() + static_cast<std::ptrdiff_t>(place));
  return fewer;
}
Point Point::alike_in(int which) const {
  Point alike = *this;
  std::erase(alike.differ, which);
  alike.of_runs[static_cast<std::size_t>(which)].clear();
  return alike;
}

Dictionary::Dictionary(const domain::Dataset& data, double written_coarsely) : described_(data.rig) {
  for (diagnose::Parameter& p : diagnose::nominal_parameters(data.rig, data.rig.spreads)) {
    if (diagnose::out_of_sight(data, p)) continue;
    const diagnose::Found found = diagnose::find(described_, p.path);
    p.lowest = p.logarithmic ? std::max(found.lowest, p.unscaled(-Shape{}.furthest)) : found.lowest;
    p.highest = p.logarithmic ? std::min(found.highest, p.unscaled(Shape{}.furthest)) : found.highest;
    keep_readable(data, p);
    parameters.push_back({p});
  }
  for (std::size_t i = 0, shared = parameters.size(); i < shared; ++i) {
    Free p = parameters[i];
    if (!p.both_sides || p.path == "valve.supply_pressure") continue;
    if (p.logarithmic) {  // a factor
      p.highest /= p.origin;
      p.lowest = 1.0 / p.highest;
      p.origin = 1.0;
    } else {
      p.lowest = -p.highest;
      p.origin = 0.0;
    }
    p.difference = true;
    parameters.push_back(p);
  }
  if (written_coarsely > 0.0)
    parameters.push_back(
        {{.path = "bench.zero",
          .scale = 0.5 * written_coarsely,
          .lowest = -written_coarsely,
          .highest = written_coarsely}});  // further off its zero is wrong, and is said to be
  const std::vector<diagnose::Candidate> all = diagnose::catalogue(data);
  for (const diagnose::Candidate& c : all)
    if (c.fits(described_))
      entries.push_back(entry_of(c, described_));
    else if (const auto law = whole(c, all); law && law->fits(described_))
      entries.push_back(entry_of(*law, described_));
  const bool of_a_lever = data.judged() == domain::Judged::angle && data.rig.lifts_a_load();
  std::span<const BenchNumber> of_bench;
  if (data.judged() == domain::Judged::contraction || of_a_lever) of_bench = of_loads_and_clocks;
  if (data.judged() == domain::Judged::force) of_bench = of_load_cells;
  for (const BenchNumber& number : of_bench) {
    if (number.name == "reading_clock" && data::are_settled_points(data)) continue;  // read by no clock
    entries.push_back({.name = std::string(number.name),
                       .bench = &number,
                       .typical = number.typical,
                       .either_sign = number.lowest < 0.0,
                       .lowest = number.lowest < 0.0 ? number.lowest / number.typical : decisive.least,
                       .highest = number.highest / number.typical});
  }
  std::set<std::string> names;
  for (const Entry& entry : entries) names.insert(entry.name);
  all_names = names.size() + differing.size() - 1 + 3;  // of loads and lengths one is a label
  const double rest_length_m = described_.muscle.rest_length_m;
  double reach = 0.0;
  for (const domain::Run& run : data.runs)
    for (const double read : run.judged().values) reach = std::max(reach, std::abs(read));
  reach_m = reach * rest_length_m;
  if (data.judged() != domain::Judged::contraction) reach_m = 0.3 * rest_length_m;
  forces_show = data.judged() != domain::Judged::pressure;
}

std::size_t Dictionary::count_of_terms(Terms terms) const {
  if (terms == Terms::none) return 0;
  if (terms == Terms::smooth) return plant::names(plant::Basis{}).size() - 1;  // a sine is a wave
  return terms == Terms::waves ? 2 * wave_pairs : rub_places;
}

std::size_t Dictionary::laws_of(const std::string& name) const {
  return static_cast<std::size_t>(std::ranges::count(entries, name, &Entry::name));
}

std::vector<Coordinate> Dictionary::coordinates(const Point& point) const {
  std::vector<Coordinate> list;
  for (Eigen::Index j = 0; j < point.z.size(); ++j)
    list.push_back({Kind::parameter, static_cast<std::size_t>(j)});
  for (std::size_t i = 0; i < point.effects.size(); ++i) {
    list.push_back({Kind::size, i});
    for (std::size_t k = 0; k < point.effects[i].shapes.size(); ++k) list.push_back({Kind::shape, i, k});
  }
  for (Eigen::Index j = 0; j < point.coefficients.size(); ++j)
    list.push_back({Kind::term, static_cast<std::size_t>(j)});
  for (Eigen::Index j = 0; j < point.stretches.size(); ++j)
    list.push_back({Kind::stretch, static_cast<std::size_t>(j)});
  return list;
}

Eigen::VectorXd Dictionary::vector(const Point& point) const {
  const auto list = coordinates(point);
  Eigen::VectorXd v(static_cast<Eigen::Index>(list.size()));
  for (std::size_t j = 0; j < list.size(); ++j) v[static_cast<Eigen::Index>(j)] = at(point, list[j]);
  return v;
}

Added Dictionary::clipped(Added added) const {
  const Point alone{.effects = {std::move(added)}};
  return moved(alone, vector(alone)).effects.front();
}

Ends Dictionary::ends(const Point& point) const {
  const auto list = coordinates(point);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto count = static_cast<Eigen::Index>(list.size());
  Ends ends{Eigen::VectorXd::Constant(count, -infinity), Eigen::VectorXd::Constant(count, infinity)};
  for (Eigen::Index j = 0; j < count; ++j) {
    const Coordinate& one = list[static_cast<std::size_t>(j)];
    if (one.kind == Kind::parameter) {
      const Free& p = parameters[one.of];
      ends.lowest[j] = p.scaled(p.lowest);
      ends.highest[j] = p.scaled(p.highest);
    } else if (one.kind == Kind::size || one.kind == Kind::shape) {
      const Entry& entry = entries[point.effects[one.of].entry];
      const bool size = one.kind == Kind::size;
      ends.lowest[j] = size ? entry.lowest : -entry.shapes[one.which].furthest;
      ends.highest[j] = size ? entry.highest : entry.shapes[one.which].furthest;
    }
  }
  return ends;
}

Point Dictionary::moved(const Point& point, const Eigen::VectorXd& to) const {
  Point p = point;
  const auto list = coordinates(point);
  const Ends ranges = ends(point);
  const Eigen::VectorXd v = to.cwiseMax(ranges.lowest).cwiseMin(ranges.highest);
  for (std::size_t j = 0; j < list.size(); ++j) at(p, list[j]) = v[static_cast<Eigen::Index>(j)];
  return p;
}

Setting Dictionary::setting(const Point& point) const {
  Setting made{described_, {.of_runs = point.of_runs, .starts = point.starts}};
  for (Eigen::Index j = 0; j < point.z.size(); ++j) {
    const Free& p = parameters[static_cast<std::size_t>(j)];
    const double value = p.unscaled(point.z[j]);
    if (p.difference) {
      const diagnose::Found of_2 = diagnose::find(made.rig, std::string(diagnose::of_muscle_2) + p.path);
      const double own = p.logarithmic ? *of_2.value * value : *of_2.value + value;
      *of_2.value = std::clamp(own, of_2.lowest, of_2.highest);
      continue;
    }
    if (p.path == "bench.zero")
      made.bench.zero = value;
    else if (point.z[j] != 0.0)
      p.put(made.rig, std::clamp(value, p.lowest, p.highest));
  }
  for (const Added& added : point.effects) {
    const Entry& entry = entries[added.entry];
    const double size = entry.absent + entry.typical * added.size;
    if (entry.bench != nullptr) {
      made.bench.*(entry.bench->of) += size;
    } else {
      made.rig = entry.effect->chosen(std::move(made.rig));
      std::vector<double> with;
      for (std::size_t i = 0; i < added.shapes.size(); ++i)
        with.push_back(entry.shapes[i].value(added.shapes[i]));
      entry.put(made.rig, size, with);
    }
  }
  put_terms(point, made.rig);
  return made;
}

void Dictionary::put_terms(const Point& point, plant::Rig& rig) const {
  const auto add = [&](const plant::ForceTerm& term) {
    diagnose::each_side(
        rig, [&](plant::Effects& effects) { effects.get<plant::ResidualForce>().terms.push_back(term); });
  };
  for (Eigen::Index j = 0; j < point.coefficients.size(); ++j) {
    const double N = point.coefficients[j];
    const std::size_t member =
        point.members.empty() ? static_cast<std::size_t>(j) : point.members[static_cast<std::size_t>(j)];
    const double stretch = point.stretches.size() > 0 ? point.stretches[j / 2] : 0.0;
    if (point.terms == Terms::smooth)
      add({.of = static_cast<plant::Basis>(member), .coefficient_N = N});
    else if (point.terms == Terms::waves)
      add({.of = plant::Basis::sine,
           .coefficient_N = N,
           .wavelength_m =
               1.2 * reach_m / static_cast<double>(1 + member / 2) * std::exp(decisive.stretch_sd * stretch),
           .phase_rad = std::numbers::pi / 2.0 * static_cast<double>(member % 2)});
  }
}

std::vector<std::string> Dictionary::faults_of_runs(const Point& point) const {
  std::set<std::string> set;
  for (const int which : point.differ)
    set.insert(std::string(differing.at(static_cast<std::size_t>(which)).name));
  return {set.begin(), set.end()};
}

std::vector<std::string> Dictionary::names(const Point& point) const {
  const std::vector<std::string> of_runs = faults_of_runs(point);
  std::set<std::string> set(of_runs.begin(), of_runs.end());
  for (const Added& added : point.effects) set.insert(entries[added.entry].name);
  constexpr std::array<std::string_view, 4> families{"", "smooth", "waves", "rubs"};
  if (point.terms != Terms::none) {
    const std::string_view family = families.at(static_cast<std::size_t>(point.terms));
    set.insert(point.members.empty()
                   ? std::string(family)
                   : fmt::format("{} of {}", point.members.size() / together(point.terms), family));
  }
  return {set.begin(), set.end()};
}

}  // namespace mckibben::identify
