// Estimates of noise; see the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <span>
#include <variant>

#include <plant/instruments.hpp>
#include <plant/plant.hpp>
#include <sim/data/amount.hpp>
#include <sim/data/series.hpp>
#include <sim/diagnose/noise.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

using Runs = std::vector<std::size_t>;

constexpr const NoiseThresholds& assumed = thresholds.noise;

/// The last decimal that any reading has, for files rounded to a few: 0 if there are more than seven.
double last_decimal(const domain::Dataset& data, const Runs& runs) {
  double unit = assumed.first_decimal;
  for (const std::size_t run : runs) {
    for (const double ratio : data.runs[run].judged()) {
      while (std::abs(ratio / unit - std::round(ratio / unit)) > assumed.decimal_error) {
        unit /= 10.0;
        if (unit < assumed.last_decimal) return 0.0;
      }
    }
  }
  return unit;
}

/// Whether the readings are whole counts to the last decimal, but for a few that something else has spoilt.
bool counted(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked, const Runs& runs,
             double count, double decimal) {
  const double tolerance = assumed.whole_count + 0.5 * decimal / count;
  if (tolerance > assumed.telling_count) return false;  // everything would be whole
  std::size_t whole = 0, all = 0;
  for (const std::size_t i : runs) {
    for (std::size_t k = 0; k < data.runs[i].judged().size(); ++k) {
      if (masked[i][k]) continue;
      const double counts = data.runs[i].judged()[k] / count;
      ++all;
      whole += std::abs(counts - std::round(counts)) <= tolerance ? 1 : 0;
    }
  }
  return static_cast<double>(whole) >= assumed.counted_share * static_cast<double>(all);
}

/// Noise of what was read beside from the second differences: what changes so fast is not the gas. 0 if
/// nothing was.
double noise_beside(const domain::Dataset& data, const Runs& runs, std::span<const domain::Beside> which_of) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const std::size_t index : runs) {
    for (const domain::Beside which : which_of) {
      const auto* read = data.runs[index].beside(which);
      if (read == nullptr) continue;
      const auto& p = *read;
      std::vector<double> second;
      for (std::size_t k = 2; k < p.size(); ++k) second.push_back(std::abs(p[k] - 2.0 * p[k - 1] + p[k - 2]));
      if (second.empty()) continue;
      // The median is blind to the few ticks at which the gas itself turns.
      const double deviation = data::upper_median(std::move(second)) / assumed.normal_median / std::sqrt(6.0);
      squares += deviation * deviation;
      ++count;
    }
  }
  return count == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(count));
}

/// White noise of the contraction ratio, from its fourth differences: no load moves so fast, and the median
/// is blind to single jumps.
double scatter(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked, const Runs& runs) {
  std::vector<double> fourth;
  for (const std::size_t i : runs) {
    const auto& e = data.runs[i].judged();
    for (std::size_t k = 4; k < e.size(); ++k)
      if (std::none_of(masked[i].begin() + static_cast<std::ptrdiff_t>(k - 4),
                       masked[i].begin() + static_cast<std::ptrdiff_t>(k + 1), std::identity{}))
        fourth.push_back(std::abs(e[k] - 4.0 * e[k - 1] + 6.0 * e[k - 2] - 4.0 * e[k - 3] + e[k - 4]));
  }
  if (fourth.empty()) return 0.0;
  return data::upper_median(std::move(fourth)) / assumed.normal_median / std::sqrt(70.0);
}

/// Whether the same drove both, over as many rows; of sealed muscles, from the same pressure.
bool driven_alike(const domain::Run& one, const domain::Run& other, bool sealed) {
  if (sealed && one.measured && other.measured && one.measured->filled_Pa != other.measured->filled_Pa)
    return false;
  if (one.load_kg != other.load_kg || one.current_mA != other.current_mA || one.shaken) return false;
  if (one.judged().size() != other.judged().size()) return false;
  if (!one.measured || !other.measured) return one.measured.has_value() == other.measured.has_value();
  const auto given = [](const domain::Run& run) {
    auto columns = run.measured->columns;
    std::erase_if(columns, [](const domain::MeasuredColumn& column) { return !column.given; });
    return columns;
  };
  return std::ranges::equal(given(one), given(other), [](const auto& a, const auto& b) {
    return a.is(b.channel.signal->in_dataset, b.channel.muscle) && a.values == b.values;
  });
}

/// Scatter of what is judged between runs that the same drove; 0 if there are none.
double repeatability(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked,
                     const Runs& trusted) {
  double squares = 0.0, count = 0.0;
  for (auto a = trusted.begin(); a != trusted.end(); ++a) {
    for (auto b = std::next(a); b != trusted.end(); ++b) {
      const domain::Run &one = data.runs[*a], &other = data.runs[*b];
      if (!driven_alike(one, other, data.rig.valve.seals())) continue;
      for (std::size_t k = 0; k < one.judged().size(); ++k) {
        if (masked[*a][k] || masked[*b][k]) continue;
        const double difference = one.judged()[k] - other.judged()[k];
        squares += 0.5 * difference * difference;
        count += 1.0;
      }
    }
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

/// Mean of -d(k) d(k+1) for counts passed at `speed` with `jitter`, both in counts.
double back_and_forth(double speed, double jitter) {
  double mean = jitter * jitter - speed * speed + 1.0 / 12.0;
  for (int k = 1; k <= assumed.waves; ++k) {
    const double wave = 2.0 * std::numbers::pi * k, fading = std::exp(-wave * wave * jitter * jitter);
    mean -= fading * (std::cos(wave * speed) - 0.5 * std::cos(2.0 * wave * speed)) / (0.25 * wave * wave);
  }
  return mean;
}

/// Whether the load goes straight on within `reach` ticks each way: else its speed is not what the ends say.
bool straight(const std::vector<double>& e, std::size_t k, std::size_t reach, double count) {
  const auto near = [&](std::size_t at) { return (e[at - 1] + e[at] + e[at + 1]) / (3.0 * count); };
  return std::abs(near(k + reach - 1) - 2.0 * near(k) + near(k - reach + 1)) < assumed.straight_counts;
}

/// Jitter before counting, in counts.
double dither(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked, const Runs& runs,
              double count) {
  constexpr std::size_t reach = assumed.steady_ticks, bins = assumed.speed_bins;
  constexpr double fastest = assumed.fastest;
  double squares = 0.0;
  for (std::size_t j = 1; j <= reach; ++j) squares += 2.0 * static_cast<double>(j * j);
  std::array<double, bins> rows{};
  double sum = 0.0;
  for (const std::size_t i : runs) {
    const auto& e = data.runs[i].judged();
    for (std::size_t k = reach; k + reach < e.size(); ++k) {
      const auto first = masked[i].begin() + static_cast<std::ptrdiff_t>(k - reach);
      if (std::any_of(first, first + 2 * reach + 1, std::identity{}) || !straight(e, k, reach, count))
        continue;
      double slope = 0.0;
      for (std::size_t j = 1; j <= reach; ++j)
        slope += static_cast<double>(j) * (e[k + j] - e[k - j]) / count;
      const double speed = std::abs(slope / squares);
      const double before = (e[k] - e[k - 1]) / count, after = (e[k + 1] - e[k]) / count;
      if (speed >= fastest || std::max(std::abs(before), std::abs(after)) > assumed.largest) continue;
      rows[static_cast<std::size_t>(speed / fastest * bins)] += 1.0;
      sum -= before * after;
    }
  }
  const auto expected = [&](double jitter) {
    double total = 0.0;
    for (std::size_t bin = 0; bin < bins; ++bin)
      if (rows[bin] > 0.0)
        total += rows[bin] * back_and_forth((static_cast<double>(bin) + 0.5) / bins * fastest, jitter);
    return total;
  };
  double low = 0.0, high = assumed.most_jitter;
  if (sum <= expected(low)) return 0.0;
  while (high - low > assumed.jitter_error)
    (expected(0.5 * (low + high)) < sum ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

/// What the noise of a given pressure does to the motion: of a second helping, by simulation.
double of_given_pressure(const domain::Dataset& data, const Runs& runs) {
  double squares = 0.0, count = 0.0;
  for (const std::size_t i : runs) {
    domain::Run run = data.runs[i];
    if (!run.shaken) continue;
    const Loaded hanging{data.rig, run.load_kg};
    const auto readings = [&] {
      return predict(run, {&hanging, 1}, data.rig.integrator.method).front().judged;
    };
    const auto calm = readings();
    run.measured = run.shaken;
    const auto shaken = readings();
    for (std::size_t k = 0; k < calm.size(); ++k) squares += (shaken[k] - calm[k]) * (shaken[k] - calm[k]);
    count += static_cast<double>(calm.size());
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

/// What the reading does where a regulator answers the same command with another pressure, within what its
/// data sheet says it repeats; of a pair, each side's apart.
double of_command(const domain::Dataset& data, const Runs& runs) {
  double squares = 0.0, count = 0.0;
  for (const std::size_t i : runs) {
    const domain::Run& run = data.runs[i];
    std::vector<Loaded> rigs{{data.rig, run.load_kg}};
    const auto off_by = [&](std::size_t side, auto valve_of) {
      const double off_Pa = valve_of(rigs.front().rig).repeatability_Pa;
      if (off_Pa == 0.0 || (run.measured && run.measured->gives("muscle_pressure", side + 1))) return;
      rigs.push_back({data.rig, run.load_kg});
      plant::Valve& valve = valve_of(rigs.back().rig);
      valve.zero_pressure_Pa += off_Pa;
      valve.span_pressure_Pa += off_Pa;
    };
    off_by(0, [](Rig& rig) -> plant::Valve& { return rig.valve; });
    if (data.rig.pair() != nullptr)
      off_by(1, [](Rig& rig) -> plant::Valve& { return rig.pair()->opposite.valve; });
    if (rigs.size() == 1) continue;
    const auto readings = predict(run, rigs, data.rig.integrator.method);
    for (std::size_t rig = 1; rig < readings.size(); ++rig)
      for (std::size_t k = 0; k < readings[rig].judged.size(); ++k)
        squares += std::pow(readings[rig].judged[k] - readings[0].judged[k], 2);
    count += static_cast<double>(readings[0].judged.size());
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

/// What a data sheet says of the reading that is judged, in its unit; 0 where there is none.
struct Sheet {
  double step = 0.0, noise = 0.0, accuracy = 0.0;
};
Sheet sheet_of(const domain::Dataset& data) {
  if (data.judged() == domain::Judged::pressure) {
    const bool valve = std::ranges::find(domain::valve_gauges, data.runs.front().judged_gauge()) !=
                       domain::valve_gauges.end();
    const plant::Sensor* gauge =
        data.rig.sensors.of(valve ? plant::Sensed::valve_pressure : plant::Sensed::muscle_pressure);
    return gauge != nullptr ? Sheet{gauge->resolution, gauge->noise, gauge->accuracy} : Sheet{};
  }
  if (data.judged() == domain::Judged::force) {
    const plant::Sensor* cell = data.rig.sensors.of(plant::Sensed::force);
    return cell != nullptr ? Sheet{cell->resolution, cell->noise, cell->accuracy} : Sheet{};
  }
  const plant::Sensor& sensor = data.rig.sensors.position();
  const double radius_m = data.rig.joint.wheel_radius_m;
  const double reading = sensor.rise_m(radius_m) /
                         (data.judged() == domain::Judged::angle ? radius_m : data.rig.muscle.rest_length_m);
  return {sensor.resolution * reading, sensor.noise * reading, sensor.accuracy * reading};
}

double largest_force_N(const domain::Dataset& data) {
  double most_N = 0.0;
  for (const domain::Run& run : data.runs)
    for (const double force_N : run.force_N) most_N = std::max(most_N, std::abs(force_N));
  return most_N;
}

/// What the reading that is judged cannot be known better than: what the simulation does wrong, and the least
/// that is believed of any instrument.
struct Least {
  double simulated, believed;
};
Least least_of(const domain::Dataset& data) {
  const double tolerance = thresholds.predict.tolerance;
  switch (data.judged()) {
    case domain::Judged::force:
      return {tolerance * largest_force_N(data), assumed.least_force_N};
    case domain::Judged::angle: {
      const double turn_rad = data.rig.muscle.rest_length_m / plant::plant_of(data.rig).arm_at_rest_m();
      return {tolerance * turn_rad, assumed.least_ratio * turn_rad};
    }
    case domain::Judged::pressure:
      return {tolerance * data.rig.valve.span_pressure_Pa, assumed.least_pressure_Pa};
    case domain::Judged::contraction:
      break;
  }
  return {tolerance, assumed.least_ratio};
}

bool is_read(const domain::Dataset& data, const Runs& runs, domain::Beside which) {
  return std::ranges::any_of(runs, [&](std::size_t run) { return data.runs[run].beside(which) != nullptr; });
}

/// Of rows that were made of stamps: what their readings scattered by is known.
void floor_of_rows(const domain::Dataset& data, const Runs& trusted, NoiseFloor& floor) {
  const domain::Rows& rows = *data.rows_of_stamps;
  const Sheet sheet = sheet_of(data);
  floor.jitter = rows.noise > 0.0 ? rows.noise : sheet.noise;
  floor.given = of_given_pressure(data, trusted);
  const double step = std::max(rows.step, sheet.step);
  const double instruments = std::hypot(step / std::sqrt(12.0), floor.jitter, floor.given);
  const auto [simulated, believed] = least_of(data);
  floor.judged = std::max({floor.repeats, floor.with_sheets(std::hypot(instruments, simulated)), believed});
  if (std::ranges::any_of(domain::gauges, [&](auto which) { return is_read(data, trusted, which); }))
    floor.pressure_Pa = std::max(rows.pressure_noise_Pa, assumed.least_pressure_Pa);
}

/// Of a load cell beside what is judged, by what its readings scatter.
double force_floor_N(const domain::Dataset& data, const Runs& trusted) {
  if (!is_read(data, trusted, domain::Beside::force)) return 0.0;
  constexpr std::array of_cell{domain::Beside::force};
  const double noise_N =
      data.rows_of_stamps ? data.rows_of_stamps->force_noise_N : noise_beside(data, trusted, of_cell);
  const plant::Sensor* cell = data.rig.sensors.of(plant::Sensed::force);
  return std::max({std::hypot(noise_N, cell != nullptr ? cell->accuracy : 0.0),
                   thresholds.predict.tolerance * largest_force_N(data), assumed.least_force_N});
}

/// Of gauges on valves, in the same way.
double valve_floor_Pa(const domain::Dataset& data, const Runs& trusted) {
  if (std::ranges::none_of(domain::valve_gauges, [&](auto which) { return is_read(data, trusted, which); }))
    return 0.0;
  const double noise_Pa = data.rows_of_stamps ? data.rows_of_stamps->valve_noise_Pa
                                              : noise_beside(data, trusted, domain::valve_gauges);
  const plant::Sensor* gauge = data.rig.sensors.of(plant::Sensed::valve_pressure);
  return std::max(std::hypot(noise_Pa, gauge != nullptr ? gauge->accuracy : 0.0), assumed.least_pressure_Pa);
}

}  // namespace

NoiseFloor noise_floor(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked,
                       std::vector<std::size_t> trusted) {
  NoiseFloor floor;
  const double count = data::reading_per_count(data.rig);
  floor.repeats = repeatability(data, masked, trusted);
  if (trusted.empty()) {
    trusted.resize(data.runs.size());
    std::iota(trusted.begin(), trusted.end(), std::size_t{0});
  }
  floor.force_N = force_floor_N(data, trusted);
  floor.valve_Pa = valve_floor_Pa(data, trusted);
  floor.command = of_command(data, trusted);
  floor.accuracy = sheet_of(data).accuracy;
  const bool encoder = std::any_of(data.runs.begin(), data.runs.end(), [](const domain::Run& run) {
    return run.measured && run.measured->counted && !run.length_is_given();
  });
  if (data.rows_of_stamps && !encoder) {
    floor_of_rows(data, trusted, floor);
    return floor;
  }
  const double decimal = last_decimal(data, trusted);
  if (counted(data, masked, trusted, count, decimal)) floor.count = count;
  const double rounding = std::hypot(floor.count, decimal) / std::sqrt(12.0);
  const double noise = scatter(data, masked, trusted);
  floor.jitter = std::sqrt(std::max(0.0, noise * noise - rounding * rounding));
  floor.noisy = floor.jitter > std::max(count, assumed.sheet_noise * sheet_of(data).noise);
  if (floor.count > 0.0 && !floor.noisy) floor.jitter = count * dither(data, masked, trusted, count);
  const auto [simulated, believed] = least_of(data);
  floor.middle = floor.count * plant::middle_of_count(data.rig.sensors.position());
  floor.judged =
      std::max({floor.repeats, floor.with_sheets(std::hypot(rounding, floor.jitter, simulated)), believed});
  if (std::ranges::any_of(domain::gauges, [&](auto which) { return is_read(data, trusted, which); }))
    floor.pressure_Pa = std::max(noise_beside(data, trusted, domain::gauges), assumed.least_pressure_Pa);
  return floor;
}

}  // namespace mckibben::diagnose
