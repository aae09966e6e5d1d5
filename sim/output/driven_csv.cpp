// The columns of a ride that followed stamps, and of a pair, in the order of the file.
#include <string>

#include <sim/output/csv.hpp>
#include <sim/output/driven_csv.hpp>
#include <sim/run/gaps.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::output {
namespace {

using run::Sample;

class DrivenColumns {
 public:
  DrivenColumns(const run::Recording& recording, const domain::RigFile& rig)
      : recording_(recording), rig_(rig) {
    add("time_s", "s", "time, as the stamps of what drove the rig",
        [](const Sample& row) { return row.time_s; });
  }

  std::vector<formats::Column> of_one(bool force) {
    const auto& [pressure_is_given, ignored] = recording_.driven.pressure;
    if (!pressure_is_given)
      add("current_mA", "mA", "current to the valve, from this row to the next",
          [](const Sample& row) { return row.current_mA; });
    add("contraction_ratio", "1", "contraction ratio of the muscle, true",
        [](const Sample& row) { return row.state.joint.contraction_ratio; });
    add("contraction_speed_per_s", "s-1", "speed of the contraction ratio, true",
        [](const Sample& row) { return row.state.joint.contraction_speed_per_s; });
    if (!pressure_is_given)
      add("valve_pressure_bar", "bar", "gauge pressure at the valve, true",
          [](const Sample& row) { return row.state.side.valve_pressure_Pa / plant::Pa_per_bar; });
    add("muscle_pressure_bar", "bar", "gauge pressure in the muscle, true",
        [](const Sample& row) { return row.state.side.muscle_pressure_Pa / plant::Pa_per_bar; });
    if (force)
      add("force_N", "N", "force of the muscle's cord, true",
          [](const Sample& row) { return row.cord_force_N; });
    add("encoder_contraction_ratio", "1", "contraction ratio as the encoder counts it",
        [per_count = run::contraction_per_count(rig_)](const Sample& row) {
          return static_cast<double>(row.counts) * per_count;
        });
    add("bristle_m", "m", "deflection of the bristles of thread friction, true",
        [](const Sample& row) { return row.state.side.bristle_m; });
    add("braid_force_N", "N", "force of the braid, positive where it shortens the muscle",
        [](const Sample& row) { return row.braid_force_N; });
    add("friction_force_N", "N", "force of thread friction, positive where it shortens the muscle",
        [](const Sample& row) { return row.friction_force_N; });
    return std::move(columns_);
  }

  std::vector<formats::Column> of_pair() {
    const auto& given = recording_.driven.pressure;
    const double rad = rig_.muscle.rest_length_m / rig_.joint.wheel_radius_m;
    if (!given[0]) current("1", [](const Sample& row) { return row.current_mA; });
    if (!given[1]) current("2", [](const Sample& row) { return row.opposite.current_mA; });
    add("angle_rad", "rad", "joint angle, positive as muscle 1 contracts, true",
        [this](const Sample& row) { return run::angle_rad(rig_, row); });
    add("angle_speed_rad_per_s", "rad s-1", "its speed, true",
        [rad](const Sample& row) { return rad * row.state.joint.contraction_speed_per_s; });
    if (!given[0]) valve("1", [](const Sample& row) { return row.state.side.valve_pressure_Pa; });
    muscle("1", [](const Sample& row) { return row.state.side.muscle_pressure_Pa; });
    if (!given[1]) valve("2", [](const Sample& row) { return row.state.opposite.valve_pressure_Pa; });
    muscle("2", [](const Sample& row) { return row.state.opposite.muscle_pressure_Pa; });
    tension("1", [](const Sample& row) { return row.cord_force_N; });
    tension("2", [](const Sample& row) { return row.opposite.cord_force_N; });
    add("encoder_angle_rad", "rad", "joint angle as the encoder counts it",
        [this](const Sample& row) { return run::counted_angle_rad(rig_, row); });
    contraction("1", [](const Sample& row) { return row.state.joint.contraction_ratio; });
    contraction("2", [](const Sample& row) { return row.opposite.contraction_ratio; });
    add("stiffness_Nm_per_rad", "N m rad-1", "stiffness of the joint at the pressures that it has, true",
        [](const Sample& row) { return row.stiffness_N_m_per_rad; });
    if (rig_.gauge.fitted) gauges("gauge_pressure_");
    return std::move(columns_);
  }

  std::vector<formats::Column> of_pair_as_measured() {
    current("1", [](const Sample& row) { return row.current_mA; });
    current("2", [](const Sample& row) { return row.opposite.current_mA; });
    add("angle_rad", "rad", "joint angle, positive as muscle 1 contracts, as the encoder counts it",
        [this](const Sample& row) { return run::counted_angle_rad(rig_, row); });
    if (rig_.gauge.fitted) gauges("muscle_pressure_");
    return std::move(columns_);
  }

 private:
  template <class Value>
  void add(const std::string& name, const char* unit, const std::string& meaning, const Value& value) {
    formats::Column column{name, unit, meaning, {}};
    column.values.reserve(recording_.samples.size());
    for (const Sample& row : recording_.samples) column.values.push_back(value(row));
    columns_.push_back(std::move(column));
  }
  template <class Value>
  void current(const std::string& muscle, const Value& value) {
    add("current_" + muscle + "_mA", "mA",
        "current to the valve of muscle " + muscle + ", from this row to the next", value);
  }
  template <class Value>
  void valve(const std::string& muscle, const Value& value_Pa) {
    add("valve_pressure_" + muscle + "_bar", "bar",
        "gauge pressure at the valve of muscle " + muscle + ", true",
        [&](const Sample& row) { return value_Pa(row) / plant::Pa_per_bar; });
  }
  template <class Value>
  void muscle(const std::string& muscle, const Value& value_Pa) {
    add("muscle_pressure_" + muscle + "_bar", "bar", "gauge pressure in muscle " + muscle + ", true",
        [&](const Sample& row) { return value_Pa(row) / plant::Pa_per_bar; });
  }
  void gauges(const std::string& name) {
    const auto gauge = [&](const std::string& muscle, auto value_Pa) {
      add(name + muscle + "_bar", "bar", "gauge pressure in muscle " + muscle + " as measured",
          [&](const Sample& row) { return value_Pa(row) / plant::Pa_per_bar; });
    };
    gauge("1", [](const Sample& row) { return row.gauge_Pa; });
    gauge("2", [](const Sample& row) { return row.opposite.gauge_Pa; });
  }
  template <class Value>
  void tension(const std::string& muscle, const Value& value) {
    add("tension_" + muscle + "_N", "N", "force of the cord of muscle " + muscle + ", true", value);
  }
  template <class Value>
  void contraction(const std::string& muscle, const Value& value) {
    add("contraction_ratio_" + muscle, "1", "contraction ratio of muscle " + muscle + ", true", value);
  }

  const run::Recording& recording_;
  const domain::RigFile& rig_;
  std::vector<formats::Column> columns_;
};

}  // namespace

std::vector<formats::Column> driven_columns(const run::Recording& recording, const domain::RigFile& rig,
                                            bool force) {
  DrivenColumns columns(recording, rig);
  return recording.driven.pair ? columns.of_pair() : columns.of_one(force || recording.driven.length);
}

std::vector<formats::Column> measured_pair_columns(const run::Recording& recording,
                                                   const domain::RigFile& rig) {
  auto columns = DrivenColumns(recording, rig).of_pair_as_measured();
  for (double& time_s : columns.front().values) time_s = tidy_s(time_s);
  return columns;
}

std::vector<formats::Column> pair_columns(const run::PairRun& run, const domain::RigFile& rig) {
  std::vector<formats::Column> columns = driven_columns(run.recording, rig, false);
  if (!run.followed) return columns;
  const auto add = [&](const char* name, const char* unit, const char* meaning, std::vector<double> wanted) {
    if (wanted.empty()) return;
    wanted.resize(run.recording.samples.size());
    columns.push_back({name, unit, meaning, std::move(wanted)});
  };
  add("target_angle_rad", "rad", "joint angle that is wanted", run.followed->angle_rad);
  add("target_stiffness_Nm_per_rad", "N m rad-1", "stiffness of the joint that is wanted",
      run.followed->stiffness_N_m_per_rad);
  return columns;
}

}  // namespace mckibben::output
