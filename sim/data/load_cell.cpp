// A load cell on the cord of a hanging load: on average it reads the weight, whatever moves it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/data/gains.hpp>
#include <sim/data/plausible.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/data/weighed.hpp>
#include <sim/domain/number.hpp>

namespace mckibben::data {
namespace {

using domain::ColumnPlace, domain::line_of;

constexpr const ColumnThresholds& of_cells = thresholds.column;

/// What a cell reads: `zero_N` and `factor` times what hangs.
struct Cell {
  double zero_N = 0.0, factor = 1.0;

  double off_N(double hangs_N) const { return zero_N + (factor - 1.0) * hangs_N; }
};

/// What a load cell read in a run and what hung there, on average.
struct Cord {
  std::size_t run;
  double read_N, hangs_N;

  double off_N() const { return read_N - hangs_N; }
};

std::vector<Cord> cords_of(const std::vector<Compared>& runs) {
  std::vector<Cord> cords;
  for (const Compared& one : runs)
    if (one.runs.size() == 1 && !one.measured.empty() && mean(one.model) > 0.0)
      cords.push_back({one.runs.front(), mean(one.measured), mean(one.model)});
  return cords;
}

/// Less is friction, impacts and what the data sheet says of the cell.
double least_off_N(const std::vector<Cord>& cords, double accuracy_N) {
  return std::max(of_cells.zero_of_load_cell * std::ranges::max(cords, {}, &Cord::hangs_N).hangs_N,
                  of_cells.zero_accuracies * accuracy_N);
}

std::string off_in_words(const std::string& key, const Cord& cord) {
  return fmt::format("{} reads {:.3g} N {} than hangs there", key, std::abs(cord.off_N()),
                     cord.off_N() > 0.0 ? "more" : "less");
}

domain::ColumnMap map_of(const domain::Dataset& data, std::size_t run) {
  return with_our_names(domain::merged(data.columns, data.runs[run].columns), data.rig.command_unit());
}

/// What a run's motion, beside that of a run whose cell agrees, is off by if its label is right, and if its
/// load cell is; as logarithms, infinite where nothing says so.
struct Motion {
  double by_label = std::numeric_limits<double>::infinity(), by_cell = by_label;
  double scatter = 0.0;  ///< of runs whose cells agree: friction does that

  bool only_label() const { return speaks_for(by_label, by_cell); }
  bool only_cell() const { return speaks_for(by_cell, by_label); }

 private:
  bool speaks_for(double one, double other) const {
    return one < of_cells.speaks_for * other && other - one > scatter;
  }
};

Motion motion_of(const domain::Dataset& data, const std::vector<Expected>& expected, const Cord& off,
                 const std::vector<Cord>& right) {
  const std::vector<Weighed> list = weigh(data, expected, true);
  const auto of = [&](std::size_t run) { return std::ranges::find(list, run, &Weighed::run); };
  const auto self = of(off.run);
  if (self == list.end() || self->seems_kg <= 0.0) return {};
  const auto beside = [&](double kg) {  // under a like load: what the rig lacks weighs alike there
    double nearest = std::numeric_limits<double>::infinity(), off_by = nearest;
    for (const Cord& one : right) {
      const auto other = of(one.run);
      if (other == list.end() || other->seems_kg <= 0.0) continue;
      const double distance = std::abs(std::log(other->label_kg / kg));
      if (distance >= nearest) continue;
      nearest = distance;
      off_by = std::abs(std::log(self->seems_kg / kg * other->label_kg / other->seems_kg));
    }
    return off_by;
  };
  std::vector<double> logs;
  for (const Cord& one : right)
    if (const auto other = of(one.run); other != list.end() && other->seems_kg > 0.0)
      logs.push_back(std::log(other->seems_kg / other->label_kg));
  return {beside(self->label_kg), beside(self->label_kg * off.read_N / off.hangs_N),
          logs.empty() ? 0.0 : range(logs)};
}

/// Where cell and labels agree but in a few runs, off by the same: the cell's zero there or the label, by the
/// motion.
std::optional<Finding> few_off(const domain::Dataset& data, const std::vector<Expected>& expected,
                               const std::string& key, const std::vector<Cord>& cords, double least_N) {
  const auto off_N = [](const Cord& one) { return std::abs(one.off_N()); };
  std::vector<Cord> off, right;
  for (const Cord& one : cords) (off_N(one) < least_N ? right : off).push_back(one);
  if (off.empty() || right.size() < std::max(off.size(), of_cells.least_labels - 1)) return std::nullopt;
  const Cord& first = off.front();
  const auto as_first = [&](const Cord& one) {
    return std::abs(one.off_N() / first.off_N() - 1.0) <= of_cells.same_zero;
  };
  if (!std::ranges::all_of(off, as_first) ||
      off_N(std::ranges::max(right, {}, off_N)) > of_cells.same_zero * off_N(first))
    return std::nullopt;
  const bool one_label = std::ranges::all_of(
      off, [&](const Cord& one) { return data.runs[one.run].load_kg == data.runs[first.run].load_kg; });
  const Motion motion = one_label ? motion_of(data, expected, first, right) : Motion{.by_label = 0.0};
  ColumnPlace place = map_of(data, first.run)[key];
  const std::vector<Unit> units = units_of_force();
  const bool hangs_elsewhere = std::ranges::any_of(
      right, [&](const Cord& one) { return std::abs(one.hangs_N - first.read_N) < least_N; });
  std::vector<std::string> asked;
  if (const Unit* unit = find_unit(units, place.unit); unit != nullptr && !motion.only_cell()) {
    place.zero = domain::significant(place.zero + first.off_N() / unit->size / place.factor, 3);
    asked.push_back(fmt::format(
        "is its zero there what the load cell reads with nothing on it? About columns: {{{}}} of {}",
        line_of(key, place), off.size() > 1 ? "these runs" : "this run"));
  }
  if (asked.empty() || !motion.only_label())
    asked.insert(hangs_elsewhere ? asked.begin() : asked.end(),
                 fmt::format("is load: {:.4g} kg meant?",
                             data.runs[first.run].load_kg * first.read_N / first.hangs_N));
  Finding found{.quantity = asked.front().starts_with("is load") ? "load" : key,
                .message = fmt::format("{}, in no other run so: {}", off_in_words(key, first),
                                       fmt::join(asked, "; or ")),
                .severity = Severity::doubtful};
  for (const Cord& one : off) found.runs.push_back(one.run);
  return found;
}

}  // namespace

std::optional<Finding> load_cell_off(const domain::Dataset& data, const std::vector<Expected>& expected,
                                     const std::vector<Compared>& runs, const std::string& key,
                                     domain::ColumnPlace place, double unit_N, double accuracy_N) {
  std::vector<double> read_N, hangs_N, offs_N, factors;
  Finding found{.quantity = key, .message = {}, .severity = Severity::doubtful};
  for (const Compared& run : runs) {
    if (run.measured.empty() || !(mean(run.model) > 0.0)) continue;
    found.runs.insert(found.runs.end(), run.runs.begin(), run.runs.end());
    hangs_N.push_back(mean(run.model));
    read_N.push_back(mean(run.measured));
    offs_N.push_back(read_N.back() - hangs_N.back());
    factors.push_back(read_N.back() / hangs_N.back());
  }
  if (offs_N.empty()) return std::nullopt;
  const auto [least_N, most_N] = std::ranges::minmax(hangs_N);
  const double sure_N = of_cells.zero_accuracies * accuracy_N;
  // What is left of a run may be a fourth of what it is off by; friction and impacts are in it.
  const auto worst = [&](const Cell& cell) {
    double most = 0.0;
    for (std::size_t k = 0; k < offs_N.size(); ++k)
      most = std::max(most, std::abs(offs_N[k] / cell.off_N(hangs_N[k]) - 1.0));
    return most;
  };
  const double least_zero_N = std::max(of_cells.zero_of_load_cell * most_N, sure_N);
  const auto is_zero = [&](const Cell& cell) { return std::abs(cell.zero_N) >= least_zero_N; };
  const auto is_factor = [&](const Cell& cell) {
    return std::abs(cell.factor - 1.0) >= std::max(of_cells.gain_of_load_cell, sure_N / least_N);
  };
  const bool several = most_N >= of_cells.other_load * least_N;
  const Cell zero{.zero_N = median(offs_N)}, factor{.factor = median(factors)};
  const Line line(read_N, hangs_N);
  const Cell both{mean(read_N) - line.slope * mean(hangs_N), line.slope};
  const bool by_zero = is_zero(zero) && worst(zero) <= of_cells.same_zero && several;
  const bool by_factor =
      is_factor(factor) && worst(factor) <= of_cells.same_zero && (!by_zero || worst(factor) < worst(zero));
  // Two loads are on a line whatever they are.
  std::vector<double> loads_N = hangs_N;
  std::ranges::sort(loads_N);
  const double middle_N = loads_N[loads_N.size() / 2];
  const bool three = middle_N > (1.0 + of_cells.zero_of_load_cell) * least_N &&
                     middle_N < (1.0 - of_cells.zero_of_load_cell) * most_N;
  const bool by_both = !by_zero && !by_factor && several && three && is_zero(both) && is_factor(both) &&
                       worst(both) <= of_cells.same_zero;
  if (!by_zero && !by_factor && !by_both) return few_off(data, expected, key, cords_of(runs), least_zero_N);
  const Cell& cell = by_factor ? factor : by_zero ? zero : both;
  place.zero = domain::significant(place.zero + cell.zero_N / unit_N / place.factor, 3);
  place.factor = domain::significant(place.factor / cell.factor, 3);
  const std::string meant = line_of(key, place);
  const double more = 100.0 * (cell.factor - 1.0);
  const auto in_unit = [&](double of_label) {
    return several && std::abs(cell.factor / of_label - 1.0) < of_cells.gain_of_load_cell;
  };
  const char* const unit = in_unit(domain::pound_kg)                ? "lb, not kg: write lb"
                           : in_unit(1.0 / domain::pound_kg)        ? "kg that are written in lb: write kg"
                           : in_unit(1.0 / plant::gravity_m_per_s2) ? "N, not kg: write the mass, N / 9.81"
                                                                    : nullptr;
  if (by_factor && unit != nullptr)
    found.message = fmt::format(
        "{} reads {:.3g} times what hangs there, under every load: all loads look like {}; or is a factor of "
        "the load cell left out? Then columns: {{{}}}",
        key, cell.factor, unit, meant);
  else if (by_factor)
    found.message = fmt::format(
        "{} reads {:.3g} times what hangs there{}: is a factor of the load cell left out? Then columns: "
        "{{{}}}; or {} {:.0f} % {} than written{}",
        key, cell.factor, several ? ", under every load" : "", meant,
        several ? "all loads are" : "the load is", std::abs(more), more > 0.0 ? "more" : "less",
        several ? "" : ", or its zero is another: one load does not separate them");
  else if (by_zero)
    found.message = fmt::format(
        "{} reads {:.3g} N {} than hangs there, whatever the load: is its zero what the load cell reads with "
        "nothing on it? About columns: {{{}}}",
        key, std::abs(cell.zero_N), cell.zero_N > 0.0 ? "more" : "less", meant);
  else
    found.message = fmt::format(
        "{} reads {:.3g} times what hangs there and {:.3g} N {}, under every load: are factor and zero of "
        "the load cell others? About columns: {{{}}}",
        key, cell.factor, std::abs(cell.zero_N), cell.zero_N > 0.0 ? "more" : "less", meant);
  return found;
}

std::vector<Finding> load_cell_read_otherwise(const domain::Dataset& data,
                                              const std::vector<Expected>& expected,
                                              const std::vector<Compared>& runs, const std::string& key,
                                              double accuracy_N) {
  std::vector<Finding> findings;
  const std::vector<Cord> cords = cords_of(runs);
  if (cords.empty()) return findings;
  const double least_N = least_off_N(cords, accuracy_N);
  std::vector<Cord> right;
  std::ranges::copy_if(cords, std::back_inserter(right),
                       [&](const Cord& one) { return std::abs(one.off_N()) < least_N; });
  if (right.empty()) return findings;
  const ColumnPlace theirs = map_of(data, right.front().run)[key];
  const std::vector<Unit> units = units_of_force();
  for (const Cord& cord : cords) {
    const ColumnPlace own = map_of(data, cord.run)[key];
    const Unit *const unit = find_unit(units, own.unit), *const their_unit = find_unit(units, theirs.unit);
    if (std::abs(cord.off_N()) < least_N || unit == nullptr || their_unit == nullptr) continue;
    const double number = cord.read_N / unit->size / own.factor + own.zero;
    const auto explains = [&](double read_N, double near_N) {
      return std::abs(read_N - cord.hangs_N) < near_N;
    };
    ColumnPlace meant = theirs;
    meant.column = own.column;
    std::string looks;
    auto severity = Severity::refused;
    if (explains((number - theirs.zero) * theirs.factor * their_unit->size, least_N)) {
      if (own.unit != theirs.unit) {
        looks = fmt::format("this looks like {}, not {}, as in these", theirs.unit, own.unit);
      } else {
        looks = fmt::format("with their {} it agrees, too", own.zero != theirs.zero ? "zero" : "factor");
        severity = Severity::doubtful;
      }
    } else {
      meant = own;
      for (const Unit& other : units)
        if (other.name != own.unit && explains(cord.read_N / unit->size * other.size,
                                               std::max(least_N, of_cells.gain_of_load_cell * cord.hangs_N)))
          meant.unit = other.name;
      if (meant.unit == own.unit) continue;
      const Motion motion = motion_of(data, expected, cord, right);
      if (motion.only_cell()) continue;  // a load that is written in another unit looks alike
      if (!motion.only_label()) severity = Severity::doubtful;
      looks = fmt::format("this looks like {}, not {}", meant.unit, own.unit);
    }
    add(findings, key, {cord.run}, off_in_words(key, cord),
        fmt::format(", where other runs agree; {}; write there columns: {{{}}}", looks,
                    line_in_unit(key, meant)),
        severity);
  }
  return findings;
}

std::vector<Finding> exchanged_with_a_load_cell(const domain::Dataset& data,
                                                const std::vector<Expected>& expected) {
  std::vector<Finding> findings;
  if (!data.rig.lifts_a_load() || data.judged() != domain::Judged::contraction) return findings;
  std::vector<Compared> runs;
  for (std::size_t i = 0; i < data.runs.size(); ++i)
    for (std::size_t reading = 0; reading < data.runs[i].readings.size(); ++reading)
      if (data.runs[i].readings[reading].channel.key_in_dataset() == "force")
        runs.emplace_back().add(i, data.runs[i], expected[i], reading);
  const std::vector<Cord> cords = cords_of(runs);
  if (cords.empty()) return findings;
  const double least_N = least_off_N(cords, 0.0);
  if (std::ranges::all_of(cords, [&](const Cord& one) { return std::abs(one.off_N()) >= least_N; }))
    return findings;  // nothing agrees: exchanged in all runs is told by a simulation
  for (const Cord& cord : cords) {
    if (std::abs(cord.off_N()) < least_N) continue;
    const domain::Run& run = data.runs[cord.run];
    const domain::ColumnMap map = map_of(data, cord.run);
    const domain::Reading& force = *run.find("force");
    double nearest_N = std::max(least_N, of_cells.gain_of_load_cell * cord.hangs_N);
    std::string key, lines;
    for (const domain::Reading& other : run.readings) {
      const std::string other_key = other.channel.key_in_dataset();
      ColumnPlace as_force = map["force"], as_other = map[other_key];
      const double of_force = as_force.factor * size_in_ours(run, force.channel, as_force.unit).value_or(0.0),
                   of_other = as_other.factor * size_in_ours(run, other.channel, as_other.unit).value_or(0.0);
      if (&other == &force || of_force == 0.0 || of_other == 0.0) continue;
      double sum_N = 0.0, most = -std::numeric_limits<double>::infinity();
      std::size_t count = 0;
      for (std::size_t k = 0; k < force.values.size(); ++k) {
        if (force.is_missing(k) || other.is_missing(k)) continue;
        sum_N += (other.values[k] / of_other + as_other.zero - as_force.zero) * of_force;
        most = std::max(most, (force.values[k] / of_force + as_force.zero - as_other.zero) * of_other);
        ++count;
      }
      const double off_N = std::abs(sum_N / static_cast<double>(count) - cord.hangs_N);
      const double limit = other.channel.is_pressure()
                               ? thresholds.plausible.beyond_supply * data.rig.valve.supply_pressure_Pa
                               : of_cells.beyond_reach;
      if (!(off_N < nearest_N) || !(most > 0.0) || most > limit) continue;
      nearest_N = off_N;
      std::swap(as_force.column, as_other.column);
      key = other_key;
      lines = fmt::format("{}, {}", line_in_unit("force", as_force), line_in_unit(key, as_other));
    }
    if (lines.empty()) continue;
    add(findings, "force", {cord.run}, off_in_words("force", cord),
        fmt::format(", where other runs agree, and {} would agree there: these two columns look exchanged; "
                    "write there columns: {{{}}}",
                    key, lines));
  }
  return findings;
}

}  // namespace mckibben::data
