// The rules; see the header.
#include <algorithm>
#include <string_view>

#include <sim/domain/combination.hpp>

namespace mckibben::domain {
namespace {

using plant::GivenPressure;

/// What the files say of a run, as rules ask for it.
struct Said {
  const Dataset& data;
  const Run& run;
  const plant::Rig& rig = data.rig;
  ColumnMap map = merged(data.columns, run.columns);
  std::size_t muscle = 1;  ///< that is asked about

  bool pair() const { return rig.pair() != nullptr; }
  /// `key` of the muscle that is asked about, where each has its own.
  std::string own(std::string_view key) const {
    const bool each = pair() && find_quantity(std::string(key) + "_1") != nullptr;
    if (each) return std::string(key) + (muscle == 2 ? "_2" : "_1");
    const bool old = key == command_key && map[command_key].absent() && !map["current"].absent();
    return old ? "current" : std::string(key);
  }
  bool gives(std::string_view key) const { return map.gives(own(key)); }
  bool has(std::string_view key) const { return !map[own(key)].absent() && !ignores(key); }
  bool ignores(std::string_view key) const {
    return !map[own(key)].absent() && map[own(key)].as == Role::ignored;
  }
  bool sealed() const { return rig.valve.seals(); }
  GivenPressure pressure() const {
    return sealed() ? GivenPressure::none : map.given_pressure(pair() ? muscle : 0);
  }
  bool reads_a_pressure() const {
    return (has("muscle_pressure") && !gives("muscle_pressure")) ||
           (has("valve_pressure") && !gives("valve_pressure"));
  }
  bool hangs() const { return rig.lifts_a_load() && !gives("contraction"); }
  bool has_load() const { return run.given_load_kg.has_value(); }
  bool points() const { return !map.settled.absent(); }
  bool any_late() const {
    return std::ranges::any_of(map.places, [](const ColumnPlace& place) { return place.late_s != 0.0; });
  }
};

struct Rule {
  std::string_view key;  ///< where it is shown; of either muscle, where each has its own
  bool (*broken)(const Said& said);
  std::string_view why;  ///< `{}`: the run
};

// What is given makes all that is upstream of it: nothing of that can be given or read beside it.
constexpr auto rules = std::to_array<Rule>({
    {"command", [](const Said& s) { return s.pressure() == GivenPressure::muscle && s.has("command"); },
     "the muscle's pressure is the input, so that there is no valve to be commanded; say as: ignored"},
    {"command", [](const Said& s) { return s.pressure() == GivenPressure::valve && s.has("command"); },
     "the valve's pressure is the input, so that nothing is commanded; say as: ignored"},
    {"command",
     [](const Said& s) { return s.pressure() == GivenPressure::none && s.ignores("command") && !s.sealed(); },
     "nothing else drives the muscle"},
    {"command", [](const Said& s) { return s.sealed() && s.has("command"); },
     "the rig's muscle is sealed (valve: {kind: none}), so that nothing is commanded; say as: ignored"},
    {"valve_pressure", [](const Said& s) { return s.sealed() && s.has("valve_pressure"); },
     "the rig's muscle is sealed (valve: {kind: none}), so that no valve has a pressure; say as: ignored"},
    {"muscle_pressure", [](const Said& s) { return s.sealed() && s.gives("muscle_pressure"); },
     "the rig's muscle is sealed (valve: {kind: none}): its pressure is what the gas in it makes of it, and "
     "cannot be the input; leave out as: input"},
    {"valve_pressure",
     [](const Said& s) { return s.pressure() == GivenPressure::muscle && s.has("valve_pressure"); },
     "the muscle's pressure is the input, so that there is no valve; say as: ignored"},
    {"command",
     [](const Said& s) {
       return !s.pair() && s.has("command") && !s.map["current"].absent() && !s.map[command_key].absent();
     },
     "current is a command in mA; give one of the two"},
    {"contraction",
     [](const Said& s) {
       return s.rig.holds_a_length() && !s.gives("contraction") && (s.has("force") || !s.reads_a_pressure());
     },
     "the rig's muscle is held (mechanics: {kind: held_length}): say which length, as: input"},
    {"joint_force", [](const Said& s) { return s.gives("contraction") && s.gives("joint_force"); },
     "the muscle's length is the input, so that a force from outside moves nothing; say as: ignored"},
    {"joint_force",
     [](const Said& s) {
       return s.hangs() && s.gives("joint_force") && !s.has_load() && !s.rig.can_hang(0.0);
     },
     "no load is given, and the rig's wheel has no inertia: a force alone moves nothing that has no mass; "
     "give load of run {}, or joint.moving_mass or wheel_inertia of the rig"},
    {"supply_pressure",
     [](const Said& s) {
       return s.gives("supply_pressure") && !s.rig.effects.get<plant::SupplyDroop>().absent();
     },
     "the rig has a tank whose pressure sinks by itself (effects.supply_droop); say as: ignored"},
    {"supply_pressure",
     [](const Said& s) {
       return s.gives("supply_pressure") && (s.pressure() != GivenPressure::none || s.sealed());
     },
     "nothing is drawn from the supply where a pressure behind the valve is given or shut in; say as: "
     "ignored"},
    {"load", [](const Said& s) { return s.has_load() && s.pair(); },
     "the rig's two muscles turn a link; nothing hangs there"},
    {"load", [](const Said& s) { return s.has_load() && !s.pair() && !s.hangs(); },
     "the muscle's length is given; nothing hangs there"},
    {"load", [](const Said& s) { return s.hangs() && !s.has_load() && !s.gives("joint_force"); },
     "the key load is missing"},
    {"load",
     [](const Said& s) {
       return s.hangs() && s.has_load() && s.data.own_clock && !s.rig.can_hang(*s.run.given_load_kg);
     },
     "it and the rig's joint.load_offset leave no load; at 0 kg joint.moving_mass or wheel_inertia moves"},
    {"start", [](const Said& s) { return s.points() && s.data.recorded.start == Start::moving; },
     "the rows of run {} are settled points"},
    {"start",
     [](const Said& s) {
       return (!s.hangs() || s.rig.lever() != nullptr) && s.data.recorded.start == Start::moving;
     },
     "run {} has no hanging load; the first state can be estimated of such runs only"},
    {"settled", [](const Said& s) { return s.points() && s.any_late(); },
     "the rows of run {} are settled points: leave out `late` of its columns"},
    {"hold", [](const Said& s) { return s.points() && s.data.recorded.hold != Hold::usual; },
     "the rows of run {} are settled points: commands hold while a point is measured, pressures and lengths "
     "are there after half of it at most"},
    {"hold", [](const Said& s) { return s.gives("contraction") && s.data.recorded.hold == Hold::previous; },
     "the length of run {} is given, and cannot jump"},
});

std::string with_run(std::string_view why, const Run& run) {
  std::string text(why);
  if (const auto at = text.find("{}"); at != std::string::npos) text.replace(at, 2, run.id);
  return text;
}

/// The keys of columns that not every rig has, of this one, as a sentence lists them.
std::string keys_of(const plant::Rig& rig) {
  const auto of_others = [&](const Quantity& quantity) {
    return !quantity.belongs(false, false) || !quantity.belongs(false, true) || !quantity.belongs(true, true);
  };
  std::string list;
  for (const Quantity& quantity : quantities())
    if (quantity.belongs(rig) && of_others(quantity) && !quantity.is_old_current)
      list.append(list.empty() ? "" : ", ").append(quantity.key);
  return list;
}

bool gives_a_pressure(const Run& run) {
  return run.measured->given_pressure(1) != GivenPressure::none ||
         run.measured->given_pressure(2) != GivenPressure::none;
}

/// What a purpose needs of a run that was read, with a clock of its own.
struct Need {
  Purpose purpose;  ///< judging: all of them
  bool (*lacks)(const Run& run, Judged judged);
  std::string_view why;
};

constexpr auto needs = std::to_array<Need>({
    {Purpose::judging,
     [](const Run& run, Judged judged) {
       return judged == Judged::contraction && run.measured->gives_length();
     },
     "the muscle's length is given, and in others it is not"},
    {Purpose::judging,
     [](const Run& run, Judged judged) {
       return judged == Judged::contraction && run.measured->values("contraction").empty();
     },
     "contraction is not read"},
    {Purpose::judging,
     [](const Run& run, Judged judged) {
       return judged == Judged::force && !is_read(run.measured->read("force"));
     },
     "the muscle's length is given, and neither force nor pressure is read"},
    {Purpose::judging,
     [](const Run& run, Judged judged) {
       return judged == Judged::angle && !is_read(run.measured->read("angle"));
     },
     "angle is not read"},
    {Purpose::judging,
     [](const Run& run, Judged judged) {
       return judged == Judged::angle && run.measured->given_pressure(1) != run.measured->given_pressure(2);
     },
     "the pressure of one muscle is given, and that of the other is not"},
    {Purpose::calibration,
     [](const Run& run, Judged judged) {
       return judged != Judged::contraction || gives_a_pressure(run) || run.measured->gives_outer_force();
     },
     "it is none of a load that a command lifts"},
});

}  // namespace

std::vector<Contradiction> contradictions(const Dataset& data, const Run& run) {
  std::vector<Contradiction> found;
  Said said{data, run};
  for (const Quantity& quantity : quantities()) {
    if (said.map[quantity].absent()) continue;
    if (!quantity.belongs(said.rig))
      found.push_back({quantity.key, (said.pair()                   ? "the rig has two muscles: "
                                      : said.rig.lever() != nullptr ? "the rig's muscle turns a lever: "
                                                                    : "the rig has one muscle: ") +
                                         keys_of(said.rig)});
    else if (said.map[quantity].as == Role::input && !quantity.may_be_given())
      found.push_back({quantity.key, "it can only be a reading"});
  }
  for (said.muscle = 1; said.muscle <= (said.pair() ? 2U : 1U); ++said.muscle)
    for (const Rule& rule : rules) {
      const std::string key = find_quantity(rule.key) == nullptr ? std::string(rule.key) : said.own(rule.key);
      if ((said.muscle == 1 || key != rule.key) && rule.broken(said))
        found.push_back({key, with_run(rule.why, run)});
    }
  return found;
}

std::optional<Contradiction> why_not(Purpose purpose, const Dataset& data) {
  for (const Run& run : data.runs) {
    if (!run.measured && data.judged() == Judged::angle) return Contradiction{run.id, "angle is not read"};
    for (const Need& need : needs)
      if (run.measured && (need.purpose == Purpose::judging || need.purpose == purpose) &&
          need.lacks(run, data.judged()))
        return Contradiction{run.id, std::string(need.why)};
  }
  return std::nullopt;
}

}  // namespace mckibben::domain
