// See the header.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <plant/instruments.hpp>
#include <sim/data/finding.hpp>
#include <sim/thesis/processing.hpp>

namespace mckibben::thesis {
namespace {

constexpr double steady_speed = 0.05;       // half periods of one run agree in speed within this
constexpr std::size_t fewest_samples = 20;  // in each direction
constexpr double overshoot = 0.05;  // above e_max by this share of it a swing may go, a right rig no further

/// The farthest current since the last turn, and the rows at which it stood.
struct Extreme {
  double value_mA;
  std::size_t first, last;

  void widen(double current_mA, std::size_t row, bool upwards) {
    constexpr double same_mA = 1e-9;
    const double beyond = upwards ? current_mA - value_mA : value_mA - current_mA;
    if (beyond > same_mA)
      *this = {current_mA, row, row};
    else if (beyond >= -same_mA)
      last = row;
  }
  double middle() const { return 0.5 * static_cast<double>(first + last); }
};

/// Mean over the half periods; the first and the last may be cut short and count only if there are no others.
double mean_speed_mA_per_s(const std::vector<HalfPeriod>& halves, double tick_s, plant::CommandUnit commands,
                           std::string& unusable) {
  const std::size_t cut = halves.size() > 2 ? 1 : 0;
  double sum = 0.0, slowest = 1e300, fastest = 0.0;
  for (std::size_t i = cut; i + cut < halves.size(); ++i) {
    const double speed = halves[i].speed_mA_per_s(tick_s);
    sum += speed;
    slowest = std::min(slowest, speed);
    fastest = std::max(fastest, speed);
  }
  const double mean = sum / static_cast<double>(halves.size() - 2 * cut);
  if (fastest - slowest > steady_speed * mean)
    unusable =
        in_unit(commands, fmt::format("its current has no single speed ({:.3g} to {:.3g} mA/s): use sines "
                                      "or triangles of constant period",
                                      slowest, fastest));
  return mean;
}

/// The largest step of a half period that is a staircase: most of its change is in rows that change several
/// times the mean, and by more than the digits of a slow ramp. 0 of one that is none.
double step_mA(const std::vector<double>& current_mA, const HalfPeriod& half) {
  constexpr double several = 4.0, share = 0.02, most = 0.5;
  const auto begin = static_cast<std::size_t>(half.begin),
             end = static_cast<std::size_t>(std::ceil(half.end));
  const double change_mA = std::abs(half.change_mA), mean_mA = change_mA / (half.end - half.begin);
  double largest_mA = 0.0, in_steps_mA = 0.0;
  for (std::size_t k = begin + 1; k < std::min(end + 1, current_mA.size()); ++k) {
    const double now_mA = std::abs(current_mA[k] - current_mA[k - 1]);
    largest_mA = std::max(largest_mA, now_mA);
    if (now_mA > std::max(several * mean_mA, share * change_mA)) in_steps_mA += now_mA;
  }
  return in_steps_mA > most * change_mA ? largest_mA : 0.0;
}

class Processor {
 public:
  Processor(const domain::Run& run, const domain::Dataset& dataset, const ProcessingOptions& options)
      : run_(run),
        dataset_(dataset),
        rig_(dataset.rig),
        options_(options),
        braid_(rig_.muscle),
        tube_(tube_pull_of(rig_).value_or(controllers::TubePull{})),
        per_count_(plant::count_height_m(rig_) / rig_.muscle.rest_length_m) {}

  ProcessedRun operator()() {
    ProcessedRun result;
    result.id = run_.id;
    result.load_kg = run_.load_kg;
    count(result.wrong);
    if (!result.wrong.empty()) return result;
    const auto halves = half_periods(run_.current_mA);
    if (halves.empty()) {
      result.unusable = "its current hardly changes (" + moved() + ")";
      result.still = true;
      return result;
    }
    result.current_speed_mA_per_s =
        mean_speed_mA_per_s(halves, rig_.tick_s, rig_.command_unit(), result.unusable);
    for (const HalfPeriod& half : halves)
      if (const double step = step_mA(run_.current_mA, half); step > 0.0)
        result.unusable =
            in_unit(rig_.command_unit(),
                    fmt::format("its current goes in steps, of up to {:.3g} mA, which have no speed: "
                                "use sines or triangles of constant period",
                                step));
    if (!result.unusable.empty()) return result;
    for (const HalfPeriod& half : halves) take(half, result);
    result.dropped.first_rows = counts_.size() - taken_;
    for (const Direction direction : directions)
      if (const std::size_t n = result.of(direction).size(); n < fewest_samples) {
        result.unusable = fmt::format("only {} usable rows in {}: the muscle hardly moves ({})", n,
                                      name_of(direction), moved());
        result.still = true;
      }
    return result;
  }

 private:
  std::string moved() const {
    const auto [low_mA, high_mA] = std::minmax_element(run_.current_mA.begin(), run_.current_mA.end());
    const auto [low, high] = std::minmax_element(counts_.begin(), counts_.end());
    return in_unit(rig_.command_unit(),
                   fmt::format("by {:g} counts in all, with currents from {:.3g} to {:.3g} mA", *high - *low,
                               *low_mA, *high_mA));
  }

  void count(std::vector<data::Finding>& wrong) {
    const auto find = [&](const char* kind, std::string message) {
      wrong.push_back({.message = std::move(message), .kind = kind});
    };
    double off = 0.0, highest = 0.0;
    for (const double ratio : run_.judged().values) {
      const double counts = ratio / per_count_;
      counts_.push_back(std::round(counts));
      off += std::abs(counts - counts_.back());
      highest = std::max(highest, ratio);
    }
    if (highest >= (1.0 + overshoot) * braid_.largest_contraction_ratio())
      find("beyond",
           fmt::format("contraction ratio {:.4f} is beyond this rig's limit {:.4f} (T 2.10): wrong rig? Its "
                       "rest_length, braid_angle and end_correction decide",
                       highest, braid_.largest_contraction_ratio()));
    constexpr double clearly_off = 0.15;  // a wrong count would give 0.25, a rounded table less than 0.1
    counted_ =
        rig_.sensors.position().counts_pulses() && off <= clearly_off * static_cast<double>(counts_.size());
    if (!counted_ && has_other_sensor())
      take_as_read();
    else if (!counted_)
      find("uncounted",
           fmt::format("contraction ratios are no multiples of this rig's encoder count ({:.4e}): wrong rig? "
                       "Its encoder, wheel_radius and rest_length decide",
                       per_count_));
    if (options_.pressure == PressureSource::gauge && run_.find("muscle_pressure") == nullptr)
      find("gauge", "no column muscle_pressure_bar, which pressure from the gauge needs");
  }

  /// Whether the rig has another sensor, or the data set names a unit of contraction that no encoder has.
  bool has_other_sensor() const {
    if (!rig_.sensors.position().counts_pulses()) return true;
    const domain::ColumnPlace place = domain::merged(dataset_.columns, run_.columns)["contraction"];
    return !place.absent() && place.unit != "count" && place.unit != "1";
  }

  /// What another sensor reads is not rounded; in place of counts stand steps as large as the thesis's.
  void take_as_read() {
    constexpr double thesis_count = 4.363e-4;
    per_count_ = thesis_count;
    for (std::size_t k = 0; k < counts_.size(); ++k) counts_[k] = run_.judged().values[k] / per_count_;
  }

  void take(const HalfPeriod& half, ProcessedRun& result) {
    const auto begin = static_cast<std::size_t>(std::ceil(half.begin));
    const auto end = std::min(counts_.size(), static_cast<std::size_t>(std::ceil(half.end)));
    const auto window = static_cast<std::size_t>(options_.window_ticks);
    const double up = half.change_mA > 0.0 ? 1.0 : -1.0;
    for (std::size_t k = std::max<std::size_t>(begin, 2); k < end; ++k) {
      ++taken_;
      const std::size_t before = k > window ? k - window : 0,
                        after = std::min(k + window, counts_.size() - 1);
      const double current_mA = run_.current_mA[k];
      if (current_mA <= rig_.valve.zero_command || current_mA > rig_.valve.span_command)
        ++result.dropped.off_the_line;
      else if (counts_[k] < options_.lowest_counts)
        ++result.dropped.near_zero;
      else if (ratio(k) >= braid_.largest_contraction_ratio())
        ++result.dropped.beyond_limit;
      else if (up * (counts_[after] - counts_[before]) < options_.window_counts)
        ++result.dropped.not_following;
      else
        add(k, up, result);
    }
  }

  double ratio(std::size_t k) const {
    const double rounded_off = counted_ ? 0.5 : 0.0;  // counts are rounded down
    return (counts_[k] + rounded_off) * per_count_;
  }

  double pressure_Pa(std::size_t k) const {
    if (options_.pressure == PressureSource::gauge)
      return rig_.effects.true_Pa(run_.values("muscle_pressure")[k]);
    const plant::Valve& v = rig_.valve;
    return v.zero_pressure_Pa + (v.span_pressure_Pa - v.zero_pressure_Pa) *
                                    (run_.current_mA[k] - v.zero_command) / (v.span_command - v.zero_command);
  }

  double acceleration_m_per_s2(std::size_t k) const {
    if (options_.acceleration == Acceleration::neglected) return 0.0;
    return rig_.muscle.rest_length_m * (ratio(k) - 2.0 * ratio(k - 1) + ratio(k - 2)) /
           (rig_.tick_s * rig_.tick_s);
  }

  void add(std::size_t k, double up, ProcessedRun& result) const {
    const std::size_t direction = up > 0.0 ? 0 : 1;
    Samples& samples = result.samples[direction];
    result.rows[direction].push_back(k);
    const double e = ratio(k), pressure = pressure_Pa(k);
    const double generated_N = braid_.force_N(e, pressure) - tube_.pull_N(e, rig_.muscle.rest_length_m);
    const double friction_N =
        generated_N - run_.load_kg * (acceleration_m_per_s2(k) + plant::gravity_m_per_s2);
    samples.contraction_ratio.push_back(e);
    samples.pressure_Pa.push_back(pressure);
    samples.coefficient.push_back(up * friction_N / (braid_.contact_surface_m2(e) * pressure));
  }

  const domain::Run& run_;
  const domain::Dataset& dataset_;
  const plant::Rig& rig_;
  const ProcessingOptions& options_;
  plant::Braid braid_;
  controllers::TubePull tube_;
  double per_count_;
  bool counted_ = true;
  std::vector<double> counts_;
  std::size_t taken_ = 0;
};

}  // namespace

void Samples::append(const Samples& other) {
  const auto join = [](std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  join(contraction_ratio, other.contraction_ratio);
  join(pressure_Pa, other.pressure_Pa);
  join(coefficient, other.coefficient);
}

Dropped& Dropped::operator+=(const Dropped& other) {
  off_the_line += other.off_the_line;
  near_zero += other.near_zero;
  beyond_limit += other.beyond_limit;
  not_following += other.not_following;
  first_rows += other.first_rows;
  return *this;
}

double HalfPeriod::speed_mA_per_s(double tick_s) const {
  return std::abs(change_mA) / ((end - begin) * tick_s);
}

std::vector<HalfPeriod> half_periods(const std::vector<double>& current_mA) {
  std::vector<HalfPeriod> halves;
  if (current_mA.empty()) return halves;
  const auto [least, most] = std::minmax_element(current_mA.begin(), current_mA.end());
  const double turn_mA = 0.02 * (*most - *least);  // smaller wiggles are no turn
  constexpr double still_mA = 0.1;
  if (*most - *least < still_mA) return halves;

  Extreme high{current_mA[0], 0, 0}, low = high;
  double begin = 0.0, begin_mA = 0.0;
  int way = 0;
  for (std::size_t k = 1; k < current_mA.size(); ++k) {
    const double now = current_mA[k];
    if (way >= 0) high.widen(now, k, true);
    if (way <= 0) low.widen(now, k, false);
    if (way <= 0 && now - low.value_mA > turn_mA) {
      if (way < 0) halves.push_back({begin, low.middle(), low.value_mA - begin_mA});
      begin = way < 0 ? low.middle() : static_cast<double>(low.last);
      begin_mA = low.value_mA;
      high = {now, k, k};
      way = 1;
    } else if (way >= 0 && high.value_mA - now > turn_mA) {
      if (way > 0) halves.push_back({begin, high.middle(), high.value_mA - begin_mA});
      begin = way > 0 ? high.middle() : static_cast<double>(high.last);
      begin_mA = high.value_mA;
      low = {now, k, k};
      way = -1;
    }
  }
  const Extreme& last = way > 0 ? high : low;
  halves.push_back({begin, static_cast<double>(last.first), last.value_mA - begin_mA});
  return halves;
}

std::optional<controllers::TubePull> tube_pull_of(const plant::Rig& rig) {
  const auto& tube = rig.effects.get<plant::BladderElasticity>();
  if (tube.absent()) return std::nullopt;
  return controllers::TubePull{tube.spring_N_per_m(), tube.limit_N(), tube.ratio};
}

ProcessedRun process(const domain::Run& run, const domain::Dataset& dataset,
                     const ProcessingOptions& options) {
  return Processor(run, dataset, options)();
}

void refuse(const domain::Dataset& dataset, std::string message) {
  throw data::UnfitData(dataset, std::move(message));
}

}  // namespace mckibben::thesis
