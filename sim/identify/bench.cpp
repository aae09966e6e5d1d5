// See the header.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/data/amount.hpp>
#include <sim/data/given_noise.hpp>
#include <sim/data/plausible.hpp>
#include <sim/data/ranges.hpp>
#include <sim/data/series.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/domain/fill_in.hpp>
#include <sim/domain/number.hpp>
#include <sim/identify/bench.hpp>
#include <sim/identify/each_run.hpp>

namespace mckibben::identify {

using diagnose::BenchFault, diagnose::FittedNumber;

namespace {

constexpr double of_95 = diagnose::thresholds.tell.normal;
constexpr double stands_out = 3.0;  // deviations of a run's own value: it is reported,
constexpr double matters = 0.1;     // and of the largest of all

/// In so many digits that the last is smaller than the deviation.
double rounded(double value, double deviation) {
  if (!(deviation > 0.0) || value == 0.0) return domain::significant(value, 4);
  const double digits = std::floor(std::log10(std::abs(value))) - std::floor(std::log10(deviation)) + 1.0;
  return domain::significant(value, std::clamp(static_cast<int>(digits), 2, 6));
}
std::string number_of(double value, double deviation) {
  return domain::write_number(rounded(value, deviation));
}

std::string more_or_less(double value, const char* more = "more", const char* less = "less") {
  return value < 0.0 ? less : more;
}

class FaultReport {
 public:
  FaultReport(const Model& model, const Estimates& estimates)
      : model_(model),
        estimates_(estimates),
        rows_(model.problem->rows),
        data_(rows_.data()),
        shared_(model.problem->dictionary.setting(model.point.alike_in(loads)).bench) {}

  std::vector<BenchFault> operator()() {
    for (std::size_t i = 0; i < model_.point.differ.size(); ++i) differing_runs(i);
    std::size_t at = 0;
    for (const Added& added : model_.point.effects) {
      const Entry& entry = model_.problem->dictionary.entries[added.entry];
      if (entry.bench != nullptr) common(entry, estimates_.bench[at++]);
    }
    return std::move(list_);
  }

 private:
  const domain::Run& run(std::size_t place) const { return data_.runs[rows_.runs[place]]; }

  /// A run's load with what is off in all.
  double shared_load_kg(std::size_t place) const { return shared_.load_kg(run(place).load_kg, place); }

  /// A run of which that was reported with all that is off.
  bool has_its_own(int which, std::size_t place) const {
    return std::ranges::any_of(list_, [&](const BenchFault& fault) {
      return (which == loads ? fault.of_loads()
                             : fault.name == differing.at(static_cast<std::size_t>(which)).name) &&
             std::ranges::find(fault.runs, run(place).id) != fault.runs.end();
    });
  }

  /// Of what is judged and what was read with it, changed.
  std::string lines_of_readings(const domain::Run& of, const auto& change) const {
    std::vector<std::string> lines;
    for (const plant::Channel& kind : rows_.kinds) {
      const std::string key = kind.key_in_dataset();
      lines.push_back(domain::line_of(key, change(place_of(of, key))));
    }
    return fmt::format("{}", fmt::join(lines, ", "));
  }

  void common(const Entry& entry, const FittedNumber& size) {
    BenchFault fault{.name = entry.name, .runs = {}, .size = size, .write = {}, .words = {}};
    const double deviation = (size.high - size.low) / (2.0 * of_95);
    for (std::size_t i = 0; i < rows_.runs.size(); ++i) fault.runs.push_back(run(i).id);
    if (entry.bench->of == &Bench::ahead_s) {
      const std::string ms = number_of(1e3 * size.value, 1e3 * deviation);
      fault.words = fmt::format("the clock of the readings is {} ms ahead of that of the input", ms);
      fault.write = fmt::format("columns: {{{}}}", lines_of_readings(run(0), [&](domain::ColumnPlace place) {
                                  return later(std::move(place), -size.value, deviation);
                                }));
    } else if (entry.bench->of == &Bench::clock) {
      fault.words = fmt::format("the clock of the readings runs {} % {}",
                                number_of(100.0 * std::abs(size.value), 100.0 * deviation),
                                more_or_less(size.value, "slow", "fast"));
      fault.write = fmt::format("columns: {{{}}}, {} a column of the stamps times {}",
                                lines_of_readings(run(0),
                                                  [](domain::ColumnPlace place) {
                                                    place.time = domain::fill_in;
                                                    return place;
                                                  }),
                                domain::fill_in, number_of(1.0 + size.value, deviation));
    } else if (entry.bench->of == &Bench::zero) {
      tell(fault, run(0), zeros, "every run", deviation);
    } else {
      const bool factor = entry.bench->of == &Bench::load_factor;
      std::map<double, std::vector<std::string>> by_load;
      fault.runs.clear();
      for (std::size_t i = 0; i < rows_.runs.size(); ++i)
        if (!has_its_own(loads, i)) {
          by_load[run(i).load_kg].push_back(run(i).id);
          fault.runs.push_back(run(i).id);
          fault.loads_kg.push_back(shared_load_kg(i));
        }
      if (fault.runs.empty()) return;
      fault.words = fmt::format(
          "all {}loads are {} {} {} than written", fault.runs.size() < rows_.runs.size() ? "other " : "",
          number_of((factor ? 100.0 : 1.0) * std::abs(size.value), (factor ? 100.0 : 1.0) * deviation),
          factor ? "%" : "kg", more_or_less(size.value));
      std::vector<std::string> lines;
      for (const auto& [written, ids] : by_load) {
        const double is = factor ? written * (1.0 + size.value) : written + size.value;
        lines.push_back(fmt::format("{}: load: {} kg", fmt::join(ids, ", "),
                                    number_of(is, factor ? written * deviation : deviation)));
      }
      fault.write = fmt::format("{}", fmt::join(lines, "; "));
    }
    list_.push_back(std::move(fault));
  }

  /// Of loads: a wrong radius of the muscle is a factor of all of them, a wrong zero of its pressure an
  /// offset.
  Common common_of(int which, const std::vector<double>& values) const {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(std::ssize(values));
    Common offset(values, ones);
    if (which != loads) return offset;
    Eigen::VectorXd loads_kg = ones;
    for (std::size_t i = 0; i < values.size(); ++i)
      loads_kg[static_cast<Eigen::Index>(i)] = run(i).load_kg + values[i];
    if (!(loads_kg.minCoeff() > 0.0)) return offset;
    Common factor(values, loads_kg);
    return factor.spread(values) < offset.spread(values) ? factor : offset;
  }

  /// What runs have in common, where that is determined and more than any has by itself; and what is off in
  /// single runs.
  void differing_runs(std::size_t place) {
    const int which = model_.point.differ[place];
    const EachRun of = each_run(model_, place);
    if (of_time(which) && same_in_all(of))
      return report_common(which, data::median(of.values), data::median(of.deviations()));
    std::vector<double> own = of.values, deviations = of.deviations(), totals = of.values;
    std::optional<Common> shared;
    if (!of_time(which)) {
      const Common common = common_of(which, of.values);
      own = common.owns(of.values);
      for (std::size_t i = 0; i < own.size(); ++i)
        deviations[i] = of.deviation(common.own(static_cast<Eigen::Index>(i)));
      if (std::abs(common.value) > stands_out * of.deviation(common.weights) &&
          common.sizes.maxCoeff() * std::abs(common.value) > largest(own))
        shared = common;
      else
        totals = own;
    }
    if (which == loads)
      for (std::size_t i = 0; i < totals.size(); ++i) totals[i] += shared_load_kg(i) - run(i).load_kg;
    for (std::size_t i = 0; i < own.size(); ++i)
      if ((!shared && std::abs(own[i]) == largest(own)) ||
          (std::abs(own[i]) > stands_out * deviations[i] && std::abs(own[i]) > matters * largest(own)))
        report(which, i, totals[i], deviations[i], which == loads ? exchanged_with(i, totals) : std::nullopt);
    if (!shared) return;
    if (which == loads)
      report_common_loads(*shared, of);
    else
      report_common(which, shared->value, of.deviation(shared->weights));
  }

  static bool of_time(int which) { return which == delays || which == drifts; }

  static double largest(const std::vector<double>& values) {
    double most = 0.0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
  }

  /// The run whose label this one seems to have, and whose seems to have this one's.
  std::optional<std::size_t> exchanged_with(std::size_t one, const std::vector<double>& off_kg) const {
    constexpr double near = 0.1;  // of the difference of the labels
    for (std::size_t other = 0; other < off_kg.size(); ++other) {
      const double from_one_kg = run(other).load_kg - run(one).load_kg;
      if (std::abs(off_kg[one] - from_one_kg) < near * std::abs(from_one_kg) &&
          std::abs(off_kg[other] + from_one_kg) < near * std::abs(from_one_kg))
        return other;
    }
    return std::nullopt;
  }

  static bool same_in_all(const EachRun& of) {
    const double middle = data::median(of.values);
    const std::vector<double> deviations = of.deviations();
    for (std::size_t i = 0; i < of.values.size(); ++i)
      if (std::abs(of.values[i] - middle) > std::max(stands_out * deviations[i], matters * std::abs(middle)))
        return false;
    return std::abs(middle) > stands_out * data::median(deviations);
  }

  BenchFault fault_of(int which, double value, double deviation) const {
    const std::string per = unit_of_reading() == "1" ? "1/s" : unit_of_reading() + "/s";
    return {.name = std::string(differing.at(static_cast<std::size_t>(which)).name),
            .size = {.name = "",
                     .unit = which == loads          ? "kg"
                             : which == held_lengths ? "m"
                             : which == zeros        ? unit_of_reading()
                             : which == delays       ? "s"
                             : which == drifts       ? per
                                                     : "1",
                     .value = value,
                     .low = value - of_95 * deviation,
                     .high = value + of_95 * deviation}};
  }

  /// What is wrong with the readings of a run or of all, and what mends them.
  void tell(BenchFault& fault, const domain::Run& of, int which, const std::string& whose,
            double deviation) const {
    const double value = fault.size.value;
    if (which == zeros) {
      fault.words = fmt::format("the zero of {} is {} too {}", whose,
                                data::amount_of(data_.judged(), std::abs(value), data_.rig),
                                more_or_less(value, "high", "low"));
      fault.write = column_line(of, of.judged().channel, value, 1.0, deviation);
    } else if (which == held_lengths) {
      fault.words = fmt::format("the length at which {} was held is {} mm {} than written", whose,
                                number_of(1e3 * std::abs(value), 1e3 * deviation),
                                more_or_less(value, "shorter", "longer"));
      const auto& columns = of.measured->columns;
      const auto given = std::ranges::find_if(columns, &data::is_length);
      fault.write =
          column_line(of, given->channel, -value / of.rest_length_m, 1.0, deviation / of.rest_length_m);
    } else if (which == gains) {
      fault.words = fmt::format("the readings of {} are {} % too {}", whose,
                                number_of(100.0 * std::abs(value), 100.0 * deviation),
                                more_or_less(value, "large", "small"));
      fault.write = column_line(of, of.judged().channel, 0.0, 1.0 / (1.0 + value), deviation);
    } else if (which == delays) {
      const std::string ms = number_of(1e3 * std::abs(value), 1e3 * deviation);
      fault.words =
          fmt::format("the readings of {} come {} ms {}", whose, ms, more_or_less(value, "late", "early"));
      fault.write = fmt::format("columns: {{{}}}", lines_of_readings(of, [&](domain::ColumnPlace place) {
                                  return later(std::move(place), value, deviation);
                                }));
    } else {
      const std::string rate = data::amount_of(data_.judged(), std::abs(value), data_.rig);
      fault.words = fmt::format("the readings of {} drift by {} {} a second", whose, rate,
                                more_or_less(value, "up", "down"));
      fault.write = "take the drift out of the column, or measure again";
    }
  }

  /// Of the runs whose load was not reported.
  void report_common_loads(const Common& common, const EachRun& of) {
    BenchFault fault;
    std::vector<double> loads_kg;
    std::vector<std::string> ids, lines;
    double most_kg = 0.0;
    for (std::size_t i = 0; i < rows_.runs.size(); ++i) {
      if (has_its_own(loads, i)) continue;
      const double size = common.sizes[static_cast<Eigen::Index>(i)];
      const double deviation_kg = of.deviation(size * common.weights);
      ids.push_back(run(i).id);
      loads_kg.push_back(shared_load_kg(i) + size * common.value);
      const double off_kg = loads_kg.back() - run(i).load_kg;
      if (std::abs(off_kg) > most_kg) {
        most_kg = std::abs(off_kg);
        fault = fault_of(loads, off_kg, deviation_kg);
        fault.words = fmt::format(
            "{} than written, that of run {} by {} kg; so would another muscle move "
            "them, of another radius",
            more_or_less(off_kg), run(i).id, number_of(most_kg, deviation_kg));
      }
      lines.push_back(fmt::format("{}: load: {} kg", run(i).id, number_of(loads_kg.back(), deviation_kg)));
    }
    if (ids.empty()) return;
    fault.words = fmt::format("the loads of all {}runs are {}",
                              ids.size() < rows_.runs.size() ? "other " : "", fault.words);
    fault.loads_kg = std::move(loads_kg);
    fault.runs = std::move(ids);
    fault.write = fmt::format("{}", fmt::join(lines, "; "));
    list_.push_back(std::move(fault));
  }

  /// Of the runs of which it was not reported.
  void report_common(int which, double value, double deviation) {
    BenchFault fault = fault_of(which, value, deviation);
    for (std::size_t i = 0; i < rows_.runs.size(); ++i)
      if (!has_its_own(which, i)) fault.runs.push_back(run(i).id);
    if (fault.runs.empty()) return;
    tell(fault, run(0), which, fault.runs.size() < rows_.runs.size() ? "every other run" : "every run",
         deviation);
    list_.push_back(std::move(fault));
  }

  void report(int which, std::size_t place, double value, double deviation,
              std::optional<std::size_t> exchanged) {
    const domain::Run& of = run(place);
    BenchFault fault = fault_of(which, value, deviation);
    fault.runs = {of.id};
    if (which == loads) {
      fault.words = fmt::format("the load of run {} is {} kg {} than written", of.id,
                                number_of(std::abs(value), deviation), more_or_less(value));
      fault.loads_kg = {of.load_kg + value};
      fault.write = fmt::format("load: {} kg", number_of(fault.loads_kg.front(), deviation));
      if (exchanged) {
        fault.loads_kg = {run(*exchanged).load_kg};
        fault.words +=
            fmt::format(", as if its label were exchanged with that of run {}", run(*exchanged).id);
        fault.write = fmt::format("load: {} kg", domain::write_number(run(*exchanged).load_kg));
      }
    } else {
      tell(fault, of, which, "run " + of.id, deviation);
    }
    list_.push_back(std::move(fault));
  }

  std::string unit_of_reading() const {
    return std::string(data::si_unit(*data_.runs.front().judged().channel.signal));
  }

  domain::ColumnPlace place_of(const domain::Run& of, const std::string& key) const {
    return data::with_our_names(domain::merged(data_.columns, of.columns), data_.rig.command_unit())[key];
  }
  static domain::ColumnPlace later(domain::ColumnPlace place, double by_s, double deviation_s) {
    place.late_s = rounded(place.late_s + by_s, deviation_s);
    return place;
  }

  /// A run's own place for a column, with what is off taken out. Empty where its unit's size is not known
  /// here.
  std::string column_line(const domain::Run& of, const plant::Channel& channel, double zero, double factor,
                          double deviation) const {
    const std::string key = channel.key_in_dataset();
    domain::ColumnPlace place = place_of(of, key);
    const std::optional<double> size = data::size_in_ours(of, channel, place.unit);
    if (!size) return "";
    place.zero += zero / (place.factor * *size);
    place.factor *= factor;
    const double per = deviation / std::max(std::abs(place.factor * *size), 1e-300);
    place.zero = rounded(place.zero, zero == 0.0 ? 0.0 : per);
    if (place.factor != 1.0) place.factor = rounded(place.factor, 0.1 * std::abs(place.factor) * deviation);
    return fmt::format("columns: {{{}}}", domain::line_of(key, place));
  }

  const Model& model_;
  const Estimates& estimates_;
  const Rows& rows_;
  const domain::Dataset& data_;
  Bench shared_;  ///< without loads of single runs
  std::vector<BenchFault> list_;
};

}  // namespace

std::vector<BenchFault> bench_faults(const Model& model, const Estimates& estimates) {
  return FaultReport(model, estimates)();
}

}  // namespace mckibben::identify
