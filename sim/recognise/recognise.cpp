// Tables alike share a map; clock, loads and rig follow; see the header.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>

#include <sim/domain/measurement.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/thinned.hpp>
#include <sim/recognise/columns.hpp>
#include <sim/recognise/headings.hpp>

namespace mckibben::recognise {

namespace {

constexpr double even_s = 1e-6, even_ratio = 2e-7;  // as readers have it of ticks

/// Understands tables that have been read.
class Recogniser {
 public:
  Recogniser(Recognised& all, bool rig_is_known, const KnownRig& known)
      : all_(all), rig_is_known_(rig_is_known), known_(known) {}

  void operator()() {
    const bool rig_is_known = rig_is_known_;
    maps(rig_is_known);
    runs();
    compare_zeros(all_);
    clocks();
    gaps();
    start();
    if (!rig_is_known)
      rig();
    else if (is_commanded_otherwise())
      valve();
  }

 private:
  const MapGuess& map_of_run(std::size_t run) const { return all_.maps[all_.runs[run].map]; }
  const MapGuess& first_map() const { return all_.maps.front(); }

  void maps(bool rig_is_known) {
    std::map<std::string, std::size_t> known;
    std::vector<std::vector<const UnknownTable*>> groups;
    for (const UnknownTable& table : all_.tables) {
      std::string names;
      for (const UnknownColumn& column : table.columns)
        names += fmt::format("{}\n{}\n{}\n", column.name, column.unit, column.is_date);
      const auto [place, is_new] = known.try_emplace(names, groups.size());
      if (is_new) groups.emplace_back();
      groups[place->second].push_back(&table);
      all_.runs.push_back({"", place->second, {}});
    }
    for (const auto& group : groups) all_.maps.push_back(map_of(group, rig_is_known, known_));
  }

  /// Of several sheets each has its own.
  std::string called(const UnknownTable& table) const {
    const std::string file = table.path.stem().string();
    const auto is_here = [&](const UnknownTable& one) { return one.path == table.path; };
    if (std::ranges::none_of(
            all_.tables, [&](const UnknownTable& one) { return is_here(one) && one.sheet != table.sheet; }))
      return file;
    return std::ranges::all_of(all_.tables, is_here) ? table.sheet : file + "_" + table.sheet;
  }

  void runs() {
    std::map<std::string, int> used;
    bool any = false;
    for (std::size_t i = 0; i < all_.runs.size(); ++i) {
      const std::string name = input::made_file_safe(called(all_.tables[i]));
      const int earlier = used[name]++;
      all_.runs[i].id = earlier == 0 ? name : fmt::format("{}_{}", name, earlier + 1);
      if (const auto load = load_of(all_.tables[i])) all_.runs[i].load = Told{load->quantity, load->reason};
      any = any || all_.runs[i].load.has_value();
    }
    const ColumnGuess* contraction = first_map().find("contraction");
    const bool given = contraction == nullptr || contraction->input.has_value();
    held_ = !any && first_map().find("force") != nullptr &&
            (rig_is_known_ ? known_.holds_a_length || (given && contraction != nullptr) : true);
    if (held_) return;
    for (RunGuess& run : all_.runs)
      if (!run.load)
        run.load = left_open("neither file, folder nor the lines above its headings name a mass");
  }

  /// Stamps of a run in seconds; empty where they are not known.
  Values time_s(std::size_t run, std::string* done = nullptr) const {
    const ColumnGuess* time = map_of_run(run).find("time");
    if (time == nullptr || time->unit.open()) return {};
    return seconds_of(all_.tables[run], *time, done);
  }

  /// Whether a row lacks what is read; a row each tick lacks nothing.
  bool lacks_cells() const {
    for (std::size_t i = 0; i < all_.runs.size(); ++i)
      for (const ColumnGuess& guess : map_of_run(i).columns)
        if (const Values* values = column_of(all_.tables[i], guess.column.value);
            values != nullptr && guess.where.empty() && !guess.time &&
            std::ranges::any_of(*values, [](double value) { return std::isnan(value); }))
          return true;
    return false;
  }

  void remark(std::size_t run, const std::string& what) {
    constexpr std::size_t most = 12;
    std::vector<std::string>& remarks = all_.maps[all_.runs[run].map].remarks;
    if (remarks.size() < most) remarks.push_back(fmt::format("{}: {}", all_.runs[run].id, what));
  }

  void clocks() {
    bool even = true;
    double first_s = 0.0;
    Range steps_s{1e300, -1e300};
    for (std::size_t i = 0; i < all_.runs.size(); ++i) {
      std::string done;
      const Values seconds = time_s(i, &done);
      if (seconds.size() < 2) continue;
      const Clock clock = clock_of(seconds);
      if (step_s_ == 0.0) step_s_ = clock.step_s;
      if (const auto fall = std::ranges::adjacent_find(seconds, std::greater<>()); fall != seconds.end())
        for (ColumnGuess& guess : all_.maps[all_.runs[i].map].columns)
          if (guess.quantity->key == "time")
            guess.unit =
                left_open(fmt::format("its stamps fall back at row {}, by {:.4g} s: is it the clock? Sort "
                                      "its rows, or take out those that are wrong",
                                      fall - seconds.begin() + 2, *fall - *(fall + 1)));
      if (!done.empty()) remark(i, done);
      if (!done.empty()) turns(i);
      even = even && done.empty() && !all_.tables[i].reordered;  // only stamps can be mended
      const double allowed_s = even_s + even_ratio * (seconds.back() - clock.begin_s);
      even = even && clock.begin_s == 0.0 && clock.jitter_s <= allowed_s &&
             std::abs(clock.step_s - step_s_) <= even_ratio * step_s_;
      steps_s = {std::min(steps_s.low, clock.shortest_s), std::max(steps_s.high, clock.longest_s)};
      first_s = clock.begin_s != 0.0 ? clock.begin_s : first_s;
    }
    const bool ticks =
        known_.tick_s == 0.0 || std::abs(step_s_ - known_.tick_s) <= even_ratio * known_.tick_s;
    even_ = even && ticks && step_s_ >= shortest_tick_s && step_s_ <= longest_tick_s;
    if (step_s_ == 0.0) return;
    clock_ = fmt::format("stamps {:.6g} ms apart", 1e3 * step_s_);
    if (steps_s.high - steps_s.low > even_s + even_ratio * step_s_)
      clock_ += fmt::format(" ({:.4g} to {:.4g} ms)", 1e3 * steps_s.low, 1e3 * steps_s.high);
    if (first_s != 0.0) clock_ += fmt::format(", begin at {:.6g} s and not at 0", first_s);
    if (even_) clock_ = fmt::format("all stamps are {:.6g} ms apart", 1e3 * step_s_);
  }

  /// Stamps that repeat because several records take turns are no coarse clock.
  void turns(std::size_t run) {
    const ColumnGuess* contraction = map_of_run(run).find("contraction");
    const Values* values =
        contraction == nullptr ? nullptr : column_of(all_.tables[run], contraction->column.value);
    const std::size_t records = values == nullptr ? 1 : taking_turns(*values);
    if (records == 1) return;
    all_.tables[run].part.push_back(fmt::format("where: {}", domain::fill_in));
    remark(run, fmt::format(
                    "{} records take turns from row to row: where: {{COLUMN: VALUE}} of the column that says "
                    "whose a row is, and a run for each; without one, put each into a file of its own",
                    records));
  }

  /// What drives the rig must be known from a run's first row to its last, but for short gaps.
  void gaps() {
    constexpr double slack = 1.01, longest_s = 1.0;
    double widest_s = 0.0;
    for (std::size_t i = 0; i < all_.runs.size(); ++i) {
      const ColumnGuess* drive = drive_of(map_of_run(i));
      const Values* values = drive == nullptr ? nullptr : column_of(all_.tables[i], drive->column.value);
      const Values seconds = time_s(i);
      if (values == nullptr || seconds.size() != values->size() || drive->time || !drive->where.empty())
        continue;
      const auto lacks = [](double value) { return std::isnan(value); };
      const auto first = std::ranges::find_if_not(*values, lacks);
      if (first == values->end()) continue;
      const auto last = std::find_if_not(values->rbegin(), values->rend(), lacks).base() - 1;
      const auto since = [&](auto at) {
        return seconds[static_cast<std::size_t>(at - values->begin())] - seconds[0];
      };
      const auto limit = [&](const char* key, double at_s) {
        all_.tables[i].part.push_back(fmt::format("{}: {:.9g} s", key, at_s));
      };
      if (first != values->begin()) limit("from", since(first));
      if (last + 1 != values->end()) limit("to", since(last));
      for (auto at = first; at < last; ++at)
        if (lacks(*at))
          widest_s = std::max(widest_s, since(std::find_if_not(at, last, lacks)) - since(at - 1));
    }
    if (widest_s <= domain::Recorded{}.bridge_s) return;
    const std::string why = fmt::format("rows lack what drives the rig for up to {:.4g} s", widest_s);
    all_.dataset.push_back(
        {"bridge", widest_s > longest_s
                       ? left_open(why + ": so long a gap may be bridged, or cut out by runs' from: and to:")
                       : Told{fmt::format("{:.3g} s", slack * widest_s), why}});
  }

  void start() {
    if (held_) return;
    std::vector<std::string> moving;
    for (std::size_t i = 0; i < all_.runs.size(); ++i)
      for (const char* key : {"muscle_pressure", "contraction"}) {
        const ColumnGuess* guess = map_of_run(i).find(key);
        if (guess != nullptr && guess->quantity->key == "muscle_pressure" && !guess->input) continue;
        const Values* values = guess == nullptr ? nullptr : column_of(all_.tables[i], guess->column.value);
        if (values == nullptr || begins_still(*values, range_of(*values))) continue;
        moving.push_back(all_.runs[i].id);
        break;
      }
    const bool commanded = first_map().find("current") != nullptr;
    const bool lacks = lacks_cells();
    if (moving.empty() && even_ && commanded && !lacks) return;  // a row each tick, from rest
    if (moving.empty() && first_map().find("time") == nullptr && !lacks) return;
    all_.dataset.push_back(
        {"start",
         moving.empty()
             ? Told{"settled", "each run begins with nothing moving" + (clock_.empty() ? "" : "; " + clock_) +
                                   (lacks ? "; some rows lack cells" : "")}
             : Told{"moving", fmt::format("{} run{} on the way, such as {}{}{}", moving.size(),
                                          moving.size() == 1 ? " begins" : "s begin", moving.front(),
                                          clock_.empty() ? "" : "; ", clock_)}});
  }

  static Told resolution(double step, const std::string& unit) {
    return {fmt::format("{:.3g} {}", step, unit), "the readings come in steps of it"};
  }
  void set(const char* key, Told told) { all_.rig.push_back({key, std::move(told)}); }

  void rig() {
    set("muscle.rest_length",
        left_open("from end to end of the braid, without pressure and load: 180 mm ± 1 mm"));
    set("muscle.rest_radius", left_open("of the braid, without pressure: 6 mm ± 0.2 mm (of a Festo muscle "
                                        "delete it and the angle, and write base: "
                                        "festo_dmsp_10, _20 or _40)"));
    set("muscle.braid_angle", left_open("between threads and axis, without pressure: 23 deg ± 1 deg"));
    valve();
    const ColumnGuess* contraction = first_map().find("contraction");
    const std::string unit = contraction == nullptr ? "" : contraction->unit.value;
    if (unit == "count" || (!unit.empty() && input::unit_problem(unit, "rad").empty()))
      set("joint.wheel_radius", left_open("of the wheel on which the cord lies"));
    if (contraction != nullptr && contraction->zero)  // a length that is given has no sensor
      set(contraction->input ? "joint.length_offset" : "joint.reading_offset",
          {"0 mm ± 1 mm", "the zero of " + contraction->column.value +
                              " may be off, and diagnose may move it by so much; less, if you know it"});
    if (unit == "count") {
      set("sensors.contraction.kind", {"encoder", "counts were recorded"});
      set("sensors.contraction.pulses_per_turn", left_open("of the encoder's disk"));
      set("sensors.contraction.wheel_ratio", left_open("turns of the disk for one of the wheel"));
    }
    if (const double step = contraction == nullptr ? 0.0 : step_of(*contraction, "m", all_.tables);
        step > 0.0) {
      set("sensors.contraction.kind", {"laser",
                                       "lengths were read (or linear_encoder); noise, accuracy and "
                                       "highest of its data sheet help, too"});
      set("sensors.contraction.resolution", resolution(step, unit));
    }
    if (const ColumnGuess* pressure = first_map().find("muscle_pressure");
        pressure != nullptr && !pressure->input)
      set("sensors.muscle_pressure.kind", {"gauge", "a muscle pressure was recorded"});
    if (const ColumnGuess* force = first_map().find("force"); force != nullptr && !force->input) {
      set("sensors.force.kind", {"load_cell",
                                 "a force was recorded; noise, accuracy and highest of its data "
                                 "sheet help, too"});
      if (const double step = step_of(*force, "N", all_.tables); step > 0.0)
        set("sensors.force.resolution", resolution(step, force->unit.value));
    }
    if (held_ && contraction != nullptr && contraction->input)
      set("mechanics", {"{kind: held_length}", "a force was read, at lengths that stay"});
    else if (held_)
      set("mechanics",
          left_open(
              "no load is named, and a force was read: {kind: held_length}, and contraction with as: input; "
              "or leave this out, and give each run its load"));
    if (first_map().rows && first_map().rows->key == "rows_are_ticks")
      set("tick", said_tick());
    else if (step_s_ >= shortest_tick_s && step_s_ <= longest_tick_s)
      set("tick", {fmt::format("{:.6g} ms", 1e3 * step_s_), clock_});
  }

  /// What commands a valve; null if nothing does.
  const ColumnGuess* command() const {
    const ColumnGuess* drive = drive_of(first_map());
    return drive != nullptr && drive->quantity->key != "muscle_pressure" ? drive : nullptr;
  }

  /// Whether the commands' unit is none of the known rig's valve.
  bool is_commanded_otherwise() const {
    const ColumnGuess* of = command();
    return of != nullptr && !of->unit.open() && known_.valve &&
           !input::unit_problem(of->unit.value, name_of(known_.valve->command_unit)).empty();
  }

  /// Time between rows that have no stamps.
  Told said_tick() const {
    const SaidStep said = said_step(all_.tables.front());
    if (said.step_s < shortest_tick_s || said.step_s > longest_tick_s)
      return left_open("time between two rows");
    return {fmt::format("{:.6g} ms", 1e3 * said.step_s), said.reason};
  }

  void valve() {
    const ColumnGuess* command = this->command();
    if (const auto said = valve_of_duties(first_map(), all_.tables.front()); !said.empty()) {
      all_.rig.insert(all_.rig.end(), said.begin(), said.end());
      return;
    }
    if (command == nullptr) return;
    Range range{1e300, -1e300};
    for (std::size_t i = 0; i < all_.runs.size(); ++i)
      if (const Values* values = column_of(all_.tables[i], command->column.value)) {
        const Range own = range_of(*values);
        range = {std::min(range.low, own.low), std::max(range.high, own.high)};
      }
    std::string unit = command->unit.open() ? "" : command->unit.value;
    for (const char* ours : {"mA", "V", "bar"})
      if (!unit.empty() && input::unit_problem(unit, ours).empty()) {
        Values ends{range.low, range.high};
        input::convert_units(ends, unit, ours);
        range = {ends[0], ends[1]};
        unit = ours;
        break;
      }
    const std::string recorded =
        unit.empty() ? "" : fmt::format("{:.4g} to {:.4g} {} were recorded", range.low, range.high, unit);
    constexpr double slack = 1.01;
    if (unit != "mA")
      set("valve.kind",
          left_open(std::string("regulator, which keeps its target pressure (then also time_constant), or "
                                "servo, whose opening follows the error") +
                    (unit.empty() ? ", or on_off, which is open or shut (then delete zero_pressure and "
                                    "span_pressure)"
                                  : "")));
    if (unit == "bar") {
      const std::string span = fmt::format("{} bar", std::ceil(range.high));
      command_range("0 bar", span, "a command in bar is the pressure itself; " + recorded);
      pressure_range({"0 bar", "as the command"}, {span, "as the command"});
      return;
    }
    if (unit == "mA" && range.high <= 20.0 * slack) {
      set("valve.zero_command", {"4 mA", "4 to 20 mA is usual; " + recorded});
      set("valve.span_command", {"20 mA", "4 to 20 mA is usual; " + recorded});
    } else if (unit == "V" && range.high > 5.0 * slack && range.high <= 10.0 * slack) {
      command_range("0 V", "10 V", "0 to 10 V is usual; " + recorded);
    } else {
      const std::string seen = recorded.empty() ? "" : "; " + recorded;
      set("valve.zero_command", left_open("command at zero_pressure" + seen));
      set("valve.span_command", left_open("command at span_pressure" + seen));
    }
    pressure_range(left_open("gauge pressure at the lower end of the commands"),
                   left_open("gauge pressure at their upper end"));
  }

  void command_range(const char* zero, const std::string& span, const std::string& reason) {
    set("valve.zero_command", {zero, reason});
    set("valve.span_command", {span, reason});
  }
  void pressure_range(Told zero, Told span) {
    set("valve.zero_pressure", std::move(zero));
    set("valve.span_pressure", std::move(span));
    set("valve.supply_pressure", left_open("gauge pressure of the supply"));
  }

  Recognised& all_;
  bool rig_is_known_;
  KnownRig known_;
  double step_s_ = 0.0;
  bool even_ = false, held_ = false;
  std::string clock_;
};

}  // namespace

Recognised recognise(const std::vector<std::filesystem::path>& files, bool rig_is_known,
                     const KnownRig& rig) {
  Recognised all;
  const std::uintmax_t together = input::bytes_of({files.begin(), files.end()});
  for (const auto& file : files)
    for (const UnknownTable& table : read_unknown(file, together))
      for (UnknownTable& run : runs_in(table)) all.tables.push_back(std::move(run));
  Recogniser{all, rig_is_known, rig}();
  return all;
}

}  // namespace mckibben::recognise
