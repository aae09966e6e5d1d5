// Estimates of noise; see the header.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
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
    for (const double ratio : data.runs[run].judged().values) {
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
    for (std::size_t k = 0; k < data.runs[i].rows(); ++k) {
      if (masked[i][k]) continue;
      const double counts = data.runs[i].judged().values[k] / count;
      ++all;
      whole += std::abs(counts - std::round(counts)) <= tolerance ? 1 : 0;
    }
  }
  return static_cast<double>(whole) >= assumed.counted_share * static_cast<double>(all);
}

/// Noise of what was read beside from the second differences: what changes so fast is not the gas. 0 if
/// nothing was.
double noise_beside(const domain::Dataset& data, const Runs& runs, const plant::Signal& signal) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const std::size_t index : runs) {
    for (const domain::Reading& read : data.runs[index].beside()) {
      if (read.channel.signal != &signal) continue;
      const std::vector<double>& v = read.values;
      std::vector<double> second;
      for (std::size_t k = 2; k < v.size(); ++k) second.push_back(std::abs(v[k] - 2.0 * v[k - 1] + v[k - 2]));
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
    const auto& e = data.runs[i].judged().values;
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
  if (one.rows() != other.rows()) return false;
  if (!one.measured || !other.measured) return one.measured.has_value() == other.measured.has_value();
  const auto given = [](const domain::Run& run) {
    auto columns = run.measured->columns;
    std::erase_if(columns, [](const domain::MeasuredColumn& column) { return !column.given; });
    return columns;
  };
  return std::ranges::equal(given(one), given(other), [](const auto& a, const auto& b) {
    return a.channel == b.channel && a.values == b.values;
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
      for (std::size_t k = 0; k < one.rows(); ++k) {
        if (masked[*a][k] || masked[*b][k]) continue;
        const double difference = one.judged().values[k] - other.judged().values[k];
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
    const auto& e = data.runs[i].judged().values;
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
      return predict(run, {&hanging, 1}, data.rig.integrator.method).front().judged();
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
      for (std::size_t k = 0; k < readings[rig].judged().size(); ++k)
        squares += std::pow(readings[rig].judged()[k] - readings[0].judged()[k], 2);
    count += static_cast<double>(readings[0].judged().size());
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

/// What a data sheet says of a reading, in its unit; 0 where there is none.
struct Sheet {
  double step = 0.0, noise = 0.0, accuracy = 0.0;
};
Sheet sheet_of(const plant::Rig& rig, const plant::Signal& signal) {
  const std::string_view key = signal.in_dataset;
  if (key == "contraction" || key == "angle") {
    const plant::Sensor& sensor = rig.sensors.position();
    const double radius_m = rig.joint.wheel_radius_m;
    const double reading = sensor.rise_m(radius_m) / (key == "angle" ? radius_m : rig.muscle.rest_length_m);
    return {sensor.resolution * reading, sensor.noise * reading, sensor.accuracy * reading};
  }
  const auto sensed = plant::named<plant::Sensed>(key);
  const plant::Sensor* sensor = sensed ? rig.sensors.of(*sensed) : nullptr;
  return sensor != nullptr ? Sheet{sensor->resolution, sensor->noise, sensor->accuracy} : Sheet{};
}

/// The largest that was read of it, either way.
double largest(const domain::Dataset& data, const plant::Signal& signal) {
  double most = 0.0;
  for (const domain::Run& run : data.runs)
    for (const domain::Reading& read : run.readings)
      if (read.channel.signal == &signal)
        for (const double value : read.values) most = std::max(most, std::abs(value));
  return most;
}

/// What a reading cannot be known better than: what the simulation does wrong, and the least that is believed
/// of any instrument.
struct Least {
  double simulated, believed;
};
Least least_of(const domain::Dataset& data, const plant::Signal& signal) {
  const double tolerance = thresholds.predict.tolerance;
  const std::string_view key = signal.in_dataset;
  if (key == "contraction") return {tolerance, assumed.least_ratio};
  if (key == "angle") {
    const double turn_rad = data.rig.muscle.rest_length_m / plant::plant_of(data.rig).arm_at_rest_m();
    return {tolerance * turn_rad, assumed.least_ratio * turn_rad};
  }
  if (key == "force") return {tolerance * largest(data, signal), assumed.least_force_N};
  return {tolerance * data.rig.valve.span_pressure_Pa, assumed.least_pressure_Pa};
}

/// Of rows that were made of stamps: what their readings scattered by is known.
void floor_of_rows(const domain::Dataset& data, const Runs& trusted, const plant::Signal& judged,
                   NoiseFloor& floor) {
  const domain::Rows& rows = *data.rows_of_stamps;
  const Sheet sheet = sheet_of(data.rig, judged);
  floor.jitter = rows.noise > 0.0 ? rows.noise : sheet.noise;
  floor.given = of_given_pressure(data, trusted);
  const double step = std::max(rows.step, sheet.step);
  const double instruments = std::hypot(step / std::sqrt(12.0), floor.jitter, floor.given);
  const auto [simulated, believed] = least_of(data, judged);
  floor.judged = std::max({floor.repeats, floor.with_sheets(std::hypot(instruments, simulated)), believed});
}

/// Of what was read beside the reading that is judged, by what it scatters; of both muscles of a pair.
double floor_beside(const domain::Dataset& data, const Runs& trusted, const plant::Signal& signal) {
  const auto& rows = data.rows_of_stamps;
  const double noise = rows && rows->noise_beside.contains(signal.key) ? rows->noise_beside.at(signal.key)
                                                                       : noise_beside(data, trusted, signal);
  const auto [simulated, believed] = least_of(data, signal);
  return std::max({std::hypot(noise, sheet_of(data.rig, signal).accuracy), simulated, believed});
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
  for (const std::size_t run : trusted)
    for (const domain::Reading& read : data.runs[run].beside())
      if (const plant::Signal& signal = *read.channel.signal; !floor.of_signal.contains(signal.key))
        floor.of_signal[signal.key] = floor_beside(data, trusted, signal);
  const plant::Signal& judged = *data.runs[trusted.front()].judged().channel.signal;
  floor.command = of_command(data, trusted);
  floor.accuracy = sheet_of(data.rig, judged).accuracy;
  const bool encoder = std::any_of(data.runs.begin(), data.runs.end(), [](const domain::Run& run) {
    return run.measured && run.measured->counted && !run.length_is_given();
  });
  if (data.rows_of_stamps && !encoder) {
    floor_of_rows(data, trusted, judged, floor);
    return floor;
  }
  const double decimal = last_decimal(data, trusted);
  if (counted(data, masked, trusted, count, decimal)) floor.count = count;
  const double rounding = std::hypot(floor.count, decimal) / std::sqrt(12.0);
  const double noise = scatter(data, masked, trusted);
  floor.jitter = std::sqrt(std::max(0.0, noise * noise - rounding * rounding));
  floor.noisy = floor.jitter > std::max(count, assumed.sheet_noise * sheet_of(data.rig, judged).noise);
  if (floor.count > 0.0 && !floor.noisy) floor.jitter = count * dither(data, masked, trusted, count);
  const auto [simulated, believed] = least_of(data, judged);
  floor.middle = floor.count * plant::middle_of_count(data.rig.sensors.position());
  floor.judged =
      std::max({floor.repeats, floor.with_sheets(std::hypot(rounding, floor.jitter, simulated)), believed});
  return floor;
}

}  // namespace mckibben::diagnose
