// Averages over neighbours, run by run; see the header.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <random>
#include <string_view>
#include <utility>

#include <sim/data/finding.hpp>
#include <sim/data/given_noise.hpp>
#include <sim/data/judged.hpp>
#include <sim/data/scatter.hpp>
#include <sim/data/series.hpp>

namespace mckibben::data {
namespace {

using domain::is_read, domain::MeasuredColumn, domain::Measurement, domain::Rows;

constexpr double even_row_s = 0.012;     // no load bends within half of it by what a sensor could show
constexpr double slack_share = 0.002;    // of a run's largest force: less is a slack cord,
constexpr double slack_noises = 3.0;     // or a load cell's noise
constexpr double enough_readings = 6.0;  // in a row, to be averaged
constexpr std::size_t quarters = 4;      // of a row, in which inputs are followed
constexpr double straight = 5e-3;        // of an input's range: it neither jumps nor bends by less
constexpr double outlying = 6.0;         // deviations
constexpr double apart = 1e-6;           // of a row: nearer instants are one, but for rounding

double median_gap_s(const Measurement& measured) {
  std::vector<double> stamps_s, gaps;
  for (std::size_t k = 0; k < measured.time_s.size(); ++k)
    if (measured.has_row(k)) stamps_s.push_back(measured.time_s[k]);
  for (std::size_t k = 1; k < stamps_s.size(); ++k) gaps.push_back(stamps_s[k] - stamps_s[k - 1]);
  return gaps.empty() ? even_row_s : upper_median(std::move(gaps));
}

bool is_fast(const Measurement& measured, double gap_s, double row_s) {
  return row_s / gap_s >= enough_readings && !measured.counted;
}

/// Rows of fast readings: their number and how many of them are skipped.
struct EvenRows {
  std::size_t all, skipped;

  EvenRows(const Measurement& measured, double row_s)
      : all(static_cast<std::size_t>(std::floor((measured.time_s.back() - measured.time_s.front()) / row_s))),
        skipped(static_cast<std::size_t>(std::ceil(measured.recorded.skip_s / row_s - 1e-9))) {}
};

/// One run: its rows, and the stamps that drive it.
class Judging {
 public:
  Judging(domain::Run& run, bool angle, double row_s, std::size_t seed)
      : run_(run), raw_(*run.measured), angle_(angle), row_s_(row_s), random_(seed) {}

  void operator()() {
    if (raw_.gives_length()) leave_out_slack();
    if (raw_.recorded.start == domain::Start::moving) raw_.first = first_state(raw_);
    raw_.filled_Pa = first_pressure_Pa(raw_);
    gap_s_ = median_gap_s(raw_);
    fast_ = is_fast(raw_, gap_s_, row_s_);
    for (const MeasuredColumn& column : raw_.columns)
      noise_.push_back(noise_of_given(raw_, column, fast_ ? row_s_ : 0.0));
    Measurement driving = fast_ ? thinned() : as_recorded();
    judge(driving);
    shake(driving);
    run_.measured = std::move(driving);
  }

  std::size_t slack = 0;  ///< rows without a force
  /// Of single readings, a value for each row: of what is judged, of other signals by their keys.
  std::vector<double> squares{};
  std::map<std::string_view, std::vector<double>> squares_beside{};
  double gain_sum = 0.0, readings_sum = 0.0, given_noise_Pa = 0.0, step = 0.0;
  bool fast() const { return fast_; }

 private:
  double begin_s() const { return raw_.time_s.front(); }

  /// Without what is only read; what is given has no values yet.
  Measurement bare() const {
    Measurement bare;
    bare.recorded = raw_.recorded;
    bare.first = raw_.first;
    bare.filled_Pa = raw_.filled_Pa;
    bare.counted = raw_.counted;
    bare.point_s = raw_.point_s;
    for (const MeasuredColumn& column : raw_.columns)
      if (column.given) bare.columns.push_back({column.channel, true});
    return bare;
  }

  /// A cord without force is slack: how far the muscle is from pulling, no load cell reads. Single readings
  /// are smoothed first: of those near the limit, noise would choose which count.
  void leave_out_slack() {
    std::vector<double>& read_N = raw_.take("force");
    const std::vector<double> recorded_N = read_N;
    const double noise_N = raw_.point_s > 0.0 ? 0.0 : slow_noise(raw_.time_s, recorded_N);
    double most_N = 0.0;
    for (const double force_N : recorded_N)
      if (force_N > most_N) most_N = force_N;
    const Column column(raw_.time_s, recorded_N);
    const double least_N = std::max(slack_share * most_N, slack_noises * noise_N),
                 near_s = 2.0 * median_gap_s(raw_);
    for (std::size_t k = 0; k < read_N.size(); ++k) {
      if (!(column.smooth(raw_.time_s[k], near_s, noise_N) <= least_N)) continue;
      read_N[k] = std::nan("");
      ++slack;
    }
  }

  Measurement as_recorded() const {
    Measurement same = bare();
    same.time_s = raw_.time_s;
    for (std::size_t at = 0; const Input& input : inputs())
      for (MeasuredColumn& column = same.columns[at++]; const double at_s : raw_.time_s)
        column.values.push_back(smooth(input, at_s));
    const bool each = !raw_.counted || raw_.gives_length();
    const double least_s = row_s_ - 0.5 * gap_s_;
    double last_s = begin_s() + raw_.recorded.skip_s - row_s_;
    for (std::size_t k = 0; k < raw_.time_s.size(); ++k) {
      const bool counts_each = each || raw_.time_s[k] - last_s >= least_s;
      if (raw_.time_s[k] - begin_s() < raw_.recorded.skip_s || !counts_each || !raw_.has_row(k)) continue;
      last_s = raw_.time_s[k];
      same.rows.push_back(k);
    }
    return same;
  }

  /// What drives the rig, as it was recorded.
  struct Input {
    const MeasuredColumn& of;
    Column column;
    double range;  ///< of its values
    double noise;  ///< of a reading
  };

  std::vector<Input> inputs() const {
    std::vector<Input> list;
    for (std::size_t i = 0; i < raw_.columns.size(); ++i)
      if (const MeasuredColumn& column = raw_.columns[i]; column.given)
        list.push_back({column, Column(raw_.time_s, column.values), range_of(column.values), noise_[i]});
    return list;
  }

  Measurement thinned() {
    Measurement thin = bare();
    if (std::ranges::any_of(thin.columns, &MeasuredColumn::is_command))
      thin.recorded.hold = domain::Hold::usual;  // means are held
    const std::vector<Input> inputs = this->inputs();
    const double quarter_s = row_s_ / static_cast<double>(quarters);
    const auto [rows, skipped] = EvenRows(raw_, row_s_);
    for (std::size_t j = 0; j <= rows * quarters; ++j) {
      const double now_s = begin_s() + static_cast<double>(j) * quarter_s;
      if (j % quarters == quarters / 2 && j / quarters >= skipped) thin.rows.push_back(thin.time_s.size());
      follow(thin, inputs, now_s, now_s + quarter_s);
    }
    return thin;
  }

  /// Adds the inputs of a quarter, at every stamp where one of them jumps or bends.
  void follow(Measurement& thin, const std::vector<Input>& inputs, double from_s, double to_s) const {
    std::vector<bool> uneven;
    for (const Input& input : inputs)
      uneven.push_back(!is_length(input.of) &&
                       (input.of.is_command() ? bends(input, from_s, to_s) : jumps(input, from_s)));
    const auto put = [&](double a_s, double b_s) {
      thin.time_s.push_back(a_s);
      for (std::size_t i = 0; i < inputs.size(); ++i) {
        const Input& input = inputs[i];
        const bool linear = raw_.recorded.hold == domain::Hold::linear;
        thin.columns[i].values.push_back(!input.of.is_command() ? smooth(input, a_s)
                                         : input.noise > 0.0 && !uneven[i]
                                             ? smooth(input, 0.5 * (a_s + b_s - (linear ? 0.0 : gap_s_)))
                                             : input.column.mean(a_s, b_s, linear));
      }
    };
    double at_s = from_s;
    if (std::ranges::find(uneven, true) != uneven.end())
      for (const double stamp_s : inputs.front().column.stamps(from_s, to_s))
        if (stamp_s - at_s > apart * row_s_ && to_s - stamp_s > apart * row_s_)
          put(std::exchange(at_s, stamp_s), stamp_s);
    put(at_s, to_s);
  }

  static bool bends(const Input& of, double from_s, double to_s) {
    const Column& column = of.column;
    const std::size_t first = column.last_before(from_s), last = column.last_before(to_s);
    double bend = 0.0;
    for (std::size_t k = first; k <= last; ++k) {
      const double share =
          last > first ? static_cast<double>(k - first) / static_cast<double>(last - first) : 0.0;
      bend = std::max(bend, std::abs(column[k] - std::lerp(column[first], column[last], share)));
      if (k > first) bend = std::max(bend, 0.5 * std::abs(column[k] - column[k - 1]));
    }
    return bend > std::max(straight * of.range, outlying * of.noise);
  }

  bool jumps(const Input& of, double at_s) const {
    const Together here = of.column.near(at_s, 0.5 * row_s_);
    return here.worst > std::max(straight * of.range, outlying * std::sqrt(here.squares)) ||
           std::isnan(here.value);
  }

  double smooth(const Input& of, double at_s) const { return of.column.smooth(at_s, 2.0 * gap_s_, of.noise); }

  /// The reading that is judged, then what was read beside it, as they were recorded.
  std::vector<const MeasuredColumn*> columns() const {
    const bool only_pressures = raw_.reads_only_pressures();
    const std::string_view judged = only_pressures        ? "muscle_pressure"
                                    : angle_              ? "angle"
                                    : raw_.gives_length() ? "force"
                                                          : "contraction";
    std::vector<const MeasuredColumn*> list;
    for (const MeasuredColumn& column : raw_.columns) {
      const bool first = column.channel.is(judged);
      if (column.given || !(is_read(column.values) || (first && !only_pressures))) continue;
      list.insert(first ? list.begin() : list.end(), &column);
    }
    return list;
  }

  /// What the readings say at each row.
  void judge(const Measurement& driving) {
    const std::vector<const MeasuredColumn*> list = columns();
    for (const MeasuredColumn* column : list) {
      const bool judged = column == list.front();
      auto& left = judged ? squares : squares_beside[column->channel.signal->key];
      domain::Reading& reading = run_.readings.emplace_back(column->channel);
      const Column recorded(raw_.time_s, column->values);
      for (const std::size_t stamp : driving.rows) {
        const Together near = fast_ ? recorded.near(driving.time_s[stamp], 0.5 * row_s_)
                                    : Together{.value = recorded[stamp], .gain = 1.0, .readings = 1};
        const bool missing = std::isnan(near.value);
        if (fast_ && !missing) left.push_back(near.squares);
        reading.values.push_back(near.value);
        reading.missing.push_back(missing);
        if (!judged) continue;
        gain_sum += near.gain;
        readings_sum += static_cast<double>(near.readings);
      }
      fill(reading.values);
      if (!fast_) {
        const double noise = noise_of_slow(column->values);
        if (judged && noise > 0.0) left = {noise * noise};
        if (!judged) left.push_back(noise * noise);
      }
    }
    const std::vector<double>& current_mA = driving.given("command");
    for (const std::size_t stamp : driving.rows) {
      run_.time_s.push_back(driving.time_s[stamp] - begin_s());
      if (!current_mA.empty()) run_.current_mA.push_back(current_mA[stamp]);
    }
    // What points scatter by holds it; and steps of force that are even, as pressures are, look like one.
    if (raw_.point_s == 0.0) step = step_of(list.front()->values);
  }

  double noise_of_slow(const std::vector<double>& readings) const {
    if (raw_.point_s == 0.0) return slow_noise(readings);
    std::vector<std::vector<double>> inputs;
    for (const MeasuredColumn& column : raw_.columns)
      if (column.given && !column.values.empty())
        inputs.insert(is_length(column) ? inputs.end() : inputs.begin(), column.values);
    return readings.empty() ? 0.0 : points_noise(readings, inputs);
  }

  /// Straight over readings that are missing: nothing goes by them.
  static void fill(std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (!std::isnan(values[k])) continue;
      std::size_t next = k;
      while (next < values.size() && std::isnan(values[next])) ++next;
      const double before = k > 0 ? values[k - 1] : next < values.size() ? values[next] : 0.0;
      const double after = next < values.size() ? values[next] : before;
      for (std::size_t at = k; at < next; ++at)
        values[at] =
            std::lerp(before, after, static_cast<double>(at - k + 1) / static_cast<double>(next - k + 1));
    }
  }

  /// As much noise as what is given has, once more on it.
  void shake(const Measurement& driving) {
    if (std::ranges::none_of(noise_, [](double noise) { return noise > 0.0; })) return;
    run_.shaken = driving;
    std::size_t at = 0;
    for (const Input& input : inputs()) {
      std::vector<double>& values = run_.shaken->columns[at++].values;
      if (!(input.noise > 0.0)) continue;
      if (input.of.channel.is_pressure()) given_noise_Pa = std::max(given_noise_Pa, input.noise);
      std::vector<double> readings = input.of.values;
      std::normal_distribution<double> noise(0.0, input.noise);
      for (double& reading : readings) reading += noise(random_);
      const Column shaken(raw_.time_s, readings);
      for (std::size_t k = 0; k < values.size(); ++k) {
        const double at_s = driving.time_s[k];
        values[k] +=
            shaken.smooth(at_s, 2.0 * gap_s_, std::numbers::sqrt2 * input.noise) - smooth(input, at_s);
      }
    }
  }

  domain::Run& run_;
  Measurement raw_;
  bool angle_;                   // is judged
  double row_s_, gap_s_ = 0.0;   ///< between rows; between stamps that are read
  std::vector<double> noise_{};  // of a reading of each column that is given
  std::mt19937_64 random_;
  bool fast_ = false;
};

/// Readings at the end of a load cell's range say no more than that. How many there are.
std::size_t leave_out_the_end(const plant::Sensor* cell, std::vector<double>& force_N) {
  if (cell == nullptr || !cell->highest) return 0;
  std::size_t count = 0;
  for (double& read_N : force_N) {
    if (!(read_N >= *cell->highest - 0.5 * cell->resolution)) continue;
    read_N = std::nan("");
    ++count;
  }
  return count;
}

}  // namespace

double row_s_of(const domain::Dataset& data) {
  double slowest_s = 0.0;
  for (const domain::Run& run : data.runs) slowest_s = std::max(slowest_s, median_gap_s(*run.measured));
  return slowest_s * enough_readings > even_row_s ? slowest_s : even_row_s;
}

std::vector<std::size_t> runs_without_rows(const domain::Dataset& data) {
  std::vector<std::size_t> list;
  if (!data.own_clock || data.rows_of_stamps) return list;
  const double row_s = row_s_of(data);
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const Measurement& measured = *data.runs[i].measured;
    bool any = false, reads = false;
    for (std::size_t k = 0; k < measured.time_s.size(); ++k) reads = reads || measured.has_row(k);
    if (is_fast(measured, median_gap_s(measured), row_s)) {
      const auto [rows, skipped] = EvenRows(measured, row_s);
      any = skipped < rows;
    } else {
      for (std::size_t k = 0; k < measured.time_s.size(); ++k)
        any = any || (measured.time_s[k] - measured.time_s.front() >= measured.recorded.skip_s &&
                      measured.has_row(k));
    }
    if (reads && !any) list.push_back(i);
  }
  return list;
}

domain::Dataset with_rows(domain::Dataset data) {
  if (!data.own_clock || data.rows_of_stamps) return data;
  if (auto runs = runs_without_rows(data); !runs.empty())
    throw UnfitData(data, {{.quantity = "time", .runs = std::move(runs), .message = "no row is left of it"}});
  Rows rows{.row_s = row_s_of(data), .readings = 0.0};
  std::vector<double> squares;
  std::map<std::string_view, std::vector<double>> squares_beside;
  double gain = 0.0;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    domain::Run& run = data.runs[i];
    rows.stamps += run.measured->time_s.size();
    for (MeasuredColumn& column : run.measured->columns)
      if (!column.given && column.channel.signal->key == "force")
        rows.at_the_end += leave_out_the_end(data.rig.sensors.of(plant::Sensed::force), column.values);
    Judging judging(run, data.rig.has_angle(), rows.row_s, i + 1);
    judging();
    rows.rows += run.rows();
    rows.inputs += run.measured->time_s.size();
    rows.readings += judging.readings_sum;
    rows.slack += judging.slack;
    gain += judging.gain_sum;
    const auto add = [](std::vector<double>& to, const std::vector<double>& more) {
      to.insert(to.end(), more.begin(), more.end());
    };
    add(squares, judging.squares);
    for (const auto& [signal, more] : judging.squares_beside) add(squares_beside[signal], more);
    rows.given_noise_Pa = std::max(rows.given_noise_Pa, judging.given_noise_Pa);
    rows.step = std::max(rows.step, judging.step);
  }
  const double all = static_cast<double>(std::max<std::size_t>(rows.rows, 1));
  rows.readings /= all;
  rows.noise = noise_of(squares) * std::sqrt(gain / all);
  for (const auto& [signal, of] : squares_beside)
    rows.noise_beside[signal] = noise_of(of) * std::sqrt(gain / all);
  data.rows_of_stamps = rows;
  return data;
}

}  // namespace mckibben::data
