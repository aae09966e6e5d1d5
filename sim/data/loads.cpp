// Labels against what runs seem to carry; see columns.hpp. With each effect of the catalogue and with muscles
// a third stronger or weaker, that is off by a factor common to all, and by less than half of the difference
// of their loads.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/data/columns.hpp>
#include <sim/data/gains.hpp>
#include <sim/data/series.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/data/weighed.hpp>
#include <sim/domain/number.hpp>
#include <sim/domain/rig_number.hpp>

namespace mckibben::data {
namespace {

using Series = std::vector<double>;

constexpr const LoadThresholds& of_loads = thresholds.load;

Finding doubt(std::vector<std::size_t> runs, std::string message) {
  return {"load", std::move(runs), std::move(message), Severity::doubtful};
}

std::vector<std::size_t> runs_of(const std::vector<Weighed>& list) {
  std::vector<std::size_t> runs;
  runs.reserve(list.size());
  for (const Weighed& one : list) runs.push_back(one.run);
  return runs;
}

/// How well labels explain what runs seem to weigh.
struct Fit {
  double scale = 1.0;   ///< common to all: another muscle, an effect
  double spread = 0.0;  ///< largest logarithm of what else is left

  double misfit() const { return spread + std::abs(std::log(scale)); }
};

Fit fit_of(const std::vector<Weighed>& list) {
  Fit fit{.scale = common_ratio(list)};
  for (const Weighed& one : list) fit.spread = std::max(fit.spread, far_off(one, fit.scale));
  return fit;
}

/// A load that is written in another unit: what is carried over what is written.
struct LoadUnit {
  double ratio, near, sure;  ///< `near`, `sure`: factors
  const char* says;
  double agree = std::numeric_limits<double>::infinity();  ///< of two loads or more: a factor as well
};

std::optional<Finding> other_unit(const std::vector<Weighed>& list) {
  constexpr LoadUnit units[] = {
      {1e3, of_loads.near_grams, of_loads.near_grams, "kg that are written in g: write kg"},
      {1.0 / plant::gravity_m_per_s2, of_loads.near_newtons, of_loads.near_newtons,
       "N, not kg: write the mass, N / 9.81"},
      {domain::pound_kg, of_loads.near_pounds, of_loads.sure_pounds, "pounds, not kg: write lb"},
      {1.0 / domain::pound_kg, of_loads.near_kg_as_pounds, 1.0, "kg that are written in lb: write kg",
       of_loads.agree_on_pounds},
      {10.0, of_loads.near_grams, of_loads.sure_tenth,
       "a tenth of what hung (a digit missing, a point misplaced)"}};
  const double ratio = common_ratio(list);
  const auto seems_none = [](const Weighed& one) { return one.seems_kg <= 0.0; };
  if (ratio <= 0.0 || std::ranges::any_of(list, seems_none)) return std::nullopt;
  const double spread = fit_of(list).spread;
  const bool several =
      std::ranges::any_of(list, [&](const Weighed& one) { return one.label_kg != list.front().label_kg; });
  for (const LoadUnit& unit : units) {
    if (std::isfinite(unit.agree) && !(several && spread < std::log(unit.agree))) continue;
    const double off = std::abs(std::log(ratio / unit.ratio));
    if (off > std::log(unit.near)) continue;
    return Finding{
        "load", runs_of(list),
        fmt::format(
            "load = {} kg, but it moves like {:.3g} kg, and all loads are off by about that factor, but "
            "for {:.0f} %; these look like {}, here load: {:.6g} kg; or the rig is another muscle: are "
            "base, rest_radius, rest_length and braid_angle right?",
            domain::write_kg(list.front().label_kg), list.front().seems_kg, 100.0 * std::expm1(spread),
            unit.says, unit.ratio * list.front().label_kg),
        off < std::log(unit.sure) ? Severity::refused : Severity::doubtful};
  }
  constexpr double another = 1.6, alike = 1.1;  // a muscle; what all loads are off by
  if (!several || spread > std::log(alike) || std::abs(std::log(ratio)) < std::log(another))
    return std::nullopt;
  return Finding{
      .message = fmt::format("all loads move like {:.3g} times what is written, but for {:.0f} %: is the rig "
                             "this muscle? rest_radius times {:.3g} would fit; base, rest_length and "
                             "braid_angle decide, too",
                             ratio, 100.0 * std::expm1(spread), 1.0 / std::sqrt(ratio)),
      .severity = Severity::doubtful};  // of no load: a diagnosis would estimate them all
}

/// Single loads that are a tenth or a thousandth of what hung, or ten or a thousand times that.
std::optional<Finding> misplaced_points(const domain::Dataset& data, const std::vector<Weighed>& list) {
  Finding found = doubt({}, "");
  for (const auto& [one, factor] : misplaced_points_in(list)) {
    if (all_are_off(list, one))
      return doubt(
          runs_of(list),
          fmt::format("{} ({} kg) moves like {:.3g} kg, and the loads of all other runs seem {} than "
                      "written, too: is the zero of contraction what it reads at rest length, and "
                      "is it this muscle?",
                      data.runs[one.run].id, domain::write_kg(one.label_kg), one.seems_kg,
                      one.seems_kg > one.label_kg ? "heavier" : "lighter"));
    found.runs.push_back(one.run);
    found.message +=
        fmt::format("{}{} ({} kg) moves like {:.3g} kg: write load: {:.6g} kg",
                    found.message.empty() ? "is a point misplaced? " : "; ", data.runs[one.run].id,
                    domain::write_kg(one.label_kg), one.seems_kg, factor * one.label_kg);
  }
  if (found.runs.empty()) return std::nullopt;
  return found;
}

/// How much nearer the labels of two runs come to what they seem to weigh if they are exchanged; 0 if they
/// contradict the order of the loads too little.
double gain(const Weighed& a, const Weighed& b) {
  const double difference_kg = b.label_kg - a.label_kg;
  if (difference_kg < 0.0) return gain(b, a);
  const double least_kg = of_loads.least_difference * b.label_kg;
  const double reversed_kg = a.seems_kg - b.seems_kg;
  if (difference_kg < least_kg || reversed_kg < std::max(of_loads.reversed * difference_kg, least_kg))
    return 0.0;
  return reversed_kg * difference_kg;
}

/// The labels exchanged in pairs, the worst first, until heavier ones contract less.
std::vector<Weighed> in_order(std::vector<Weighed> list) {
  for (std::size_t swaps = 0; swaps < list.size(); ++swaps) {
    double most = 0.0;
    std::pair<std::size_t, std::size_t> worst;
    for (std::size_t a = 0; a < list.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (const double better = gain(list[a], list[b]); better > most) {
          most = better;
          worst = {a, b};
        }
    if (most == 0.0) break;
    std::swap(list[worst.first].label_kg, list[worst.second].label_kg);
  }
  return list;
}

bool same_labels(const std::vector<Weighed>& a, const std::vector<Weighed>& b) {
  return std::ranges::equal(a, b, {}, &Weighed::label_kg, &Weighed::label_kg);
}

/// What runs seem to weigh as a line over their labels, by their relative errors: an effect or another muscle
/// adds a factor and an offset. A factor alone where all labels are the same.
struct LoadLine {
  double factor = 1.0, offset_kg = 0.0;

  double load_kg(double seems_kg) const { return (seems_kg - offset_kg) / factor; }
  double off(const Weighed& one) const { return log_ratio(load_kg(one.seems_kg), one.label_kg); }

  /// Infinite where one is no load.
  static double log_ratio(double kg, double label_kg) {
    return kg > 0.0 ? std::log(kg / label_kg) : std::numeric_limits<double>::infinity();
  }
};

LoadLine line_through(const std::vector<Weighed>& list) {
  constexpr double same = 1e-6;
  double sum = 0.0, of_label = 0.0, of_seems = 0.0, of_products = 0.0;  // weighted by 1 / label^2
  for (const Weighed& one : list) {
    sum += 1.0 / (one.label_kg * one.label_kg);
    of_label += 1.0 / one.label_kg;
    of_seems += one.seems_kg / (one.label_kg * one.label_kg);
    of_products += one.seems_kg / one.label_kg;
  }
  const double of_squares = static_cast<double>(list.size());
  const double spread = sum * of_squares - of_label * of_label;
  if (spread < same * sum * of_squares) return {of_seems / of_label, 0.0};
  const double factor = (sum * of_products - of_label * of_seems) / spread;
  return {factor, (of_seems - factor * of_label) / sum};
}

/// Whether a label contradicts those of three others or more, which agree: both by the factor that they have
/// in common, and by the line through them.
bool contradicts(const Weighed& one, const std::vector<Weighed>& others, double scale) {
  if (others.size() < of_loads.least_others) return false;
  const LoadLine line = line_through(others);
  if (!(line.factor > 0.0)) return false;
  // Below the lightest one: near the end of the stroke a small error of the contraction looks like many kg.
  const double lightest_kg = std::ranges::min(others, {}, &Weighed::label_kg).label_kg;
  if (std::min(one.label_kg, one.seems_kg / scale) < lightest_kg) return false;
  Series labels_kg;
  double left = 0.0;
  for (const Weighed& other : others) {
    labels_kg.push_back(other.label_kg);
    left = std::max(left, std::abs(line.off(other)));
  }
  const double least_kg = of_loads.contradicts_kg * upper_median(std::move(labels_kg));
  const double least = std::max(std::log(of_loads.contradicts), of_loads.apart_of_line * left);
  const double a_kg = one.seems_kg / scale, b_kg = line.load_kg(one.seems_kg);
  const auto off = [&](double kg, double way) {
    return way * (kg - one.label_kg) > least_kg && way * LoadLine::log_ratio(kg, one.label_kg) > least;
  };
  return (off(a_kg, 1.0) && off(b_kg, 1.0)) || (off(a_kg, -1.0) && off(b_kg, -1.0));
}

/// A label that alone contradicts the others, which agree.
struct Alone {
  Weighed run;
  Fit others;
};

/// `exchangeable`: an exchange of labels would bring them into order.
std::optional<Alone> alone(const std::vector<Weighed>& list, bool exchangeable) {
  std::optional<Alone> best;
  for (std::size_t i = 0; i < list.size() && list.size() > 1; ++i) {
    std::vector<Weighed> others = list;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Fit fit = fit_of(others);
    const double off = far_off(list[i], fit.scale);
    const double left = others.size() > 1 ? fit.spread : fit.misfit();
    if (list[i].seems_kg <= 0.0 || !(left < std::log(of_loads.others_agree)) ||
        !same_labels(in_order(others), others))
      continue;
    const LoadLine line = others.size() < of_loads.least_others ? LoadLine{fit.scale} : line_through(others);
    const bool far = others.size() > 1 && off >= of_loads.apart * left &&
                     std::min(off, std::abs(line.off(list[i]))) >= std::log(of_loads.alone);
    if (!exchangeable && !far && !contradicts(list[i], others, fit.scale)) continue;
    if (!best || fit.misfit() < best->others.misfit()) best = Alone{list[i], fit};
  }
  return best;
}

Finding wrong_label(const domain::Dataset& data, const Alone& found) {
  const auto& [run, label_kg, seems_kg] = found.run;
  return doubt(
      {run}, fmt::format("{0} ({1} kg) moves like {2:.3g} kg, compared with the other runs, which agree with "
                         "their labels. Is this label wrong? Then load: {2:.3g} kg, roughly, as the rig may "
                         "lack an effect (`mckibben diagnose` weighs both). Or is its reading's zero "
                         "elsewhere?",
                         data.runs[run].id, domain::write_kg(label_kg), seems_kg / found.others.scale));
}

/// Whether each run that got another label seems to weigh it.
bool agree(const std::vector<Weighed>& list, const std::vector<Weighed>& ordered) {
  const double scale = common_ratio(ordered);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const double label_kg = list[i].label_kg, other_kg = ordered[i].label_kg;
    if (label_kg != other_kg && !(std::abs(list[i].seems_kg - scale * other_kg) <
                                  of_loads.agrees * std::abs(label_kg - other_kg) * scale))
      return false;
  }
  return true;
}

/// Labels that contradict the order of the loads: one that is wrong, some that were exchanged, or a question.
std::optional<Finding> wrong_labels(const domain::Dataset& data, const std::vector<Weighed>& list) {
  const std::vector<Weighed> ordered = in_order(list);
  const bool exchangeable = !same_labels(list, ordered);
  const bool all_agree = agree(list, ordered);
  if (const auto one = alone(list, exchangeable);
      one && (!exchangeable || !all_agree || one->others.misfit() < fit_of(ordered).misfit()))
    return wrong_label(data, *one);
  if (!exchangeable) return std::nullopt;
  Finding found = doubt({}, "");
  const double scale = all_agree ? common_ratio(ordered) : 1.0;
  std::string written, seems;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const double label_kg = list[i].label_kg, other_kg = ordered[i].label_kg;
    if (label_kg == other_kg) continue;
    found.runs.push_back(list[i].run);
    if (all_agree) found.exchanged.push_back({list[i].run, other_kg});
    const std::string& id = data.runs[list[i].run].id;
    const char* const comma = written.empty() ? "" : ", ";
    written += fmt::format("{}load: {} kg for {}", comma, domain::write_kg(other_kg), id);
    seems += fmt::format("{}{} ({} kg) like {:.1f} kg", comma, id, domain::write_kg(label_kg),
                         list[i].seems_kg / scale);
  }
  found.message =
      fmt::format("at equal pressure a heavier load contracts less, but {}: {}", seems,
                  all_agree ? "these labels look exchanged; write " + written
                            : "are the labels right, and is the zero of each reading at the same place?");
  return found;
}

/// Runs without a load that move as if one hung there.
std::optional<Finding> unloaded(const domain::Dataset& data, const std::vector<Weighed>& list,
                                const std::vector<Weighed>& others) {
  const LoadLine line = others.empty() ? LoadLine{} : line_through(others);
  const double least_kg = of_loads.visible * domain::usual_load_kg(data.rig);
  std::vector<std::size_t> runs;
  std::string seems;
  for (const Weighed& one : list) {
    const double kg = line.load_kg(one.seems_kg);
    if (!(line.factor > 0.0) || !(kg > least_kg)) continue;
    runs.push_back(one.run);
    seems += fmt::format("{}{} moves like {:.3g} kg", seems.empty() ? "" : ", ", data.runs[one.run].id, kg);
  }
  if (runs.empty()) return std::nullopt;
  return doubt(std::move(runs), fmt::format("load = 0 kg, but {}: write the load that it carried", seems));
}

}  // namespace

void check_loads(const domain::Dataset& data, const std::vector<Expected>& expected,
                 std::vector<Finding>& findings) {
  const std::vector<Weighed> list = weigh(data, expected, true);
  if (auto found = unloaded(data, weigh(data, expected, false), list)) findings.push_back(std::move(*found));
  if (list.empty()) return;
  auto found = other_unit(list);
  if (!found) found = misplaced_points(data, list);
  if (!found) found = beyond_the_rig(data, expected);  // what weighs less than nothing has no order
  if (!found) found = wrong_labels(data, list);
  if (found) findings.push_back(std::move(*found));
}

}  // namespace mckibben::data
