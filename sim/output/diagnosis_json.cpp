// Layout of diagnosis.json. Its first keys are relied on from outside (schema mckibben-diagnosis/1).
#include <algorithm>
#include <string>

#include <sim/diagnose/priors.hpp>
#include <sim/input/field_kinds.hpp>
#include <sim/input/rigs.hpp>
#include <sim/output/diagnosis_results.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/json_parts.hpp>

namespace mckibben::diagnose {

inline void to_json(input::Json& json, Explanation::Kind kind) {
  json = std::string(plant::name_of(kind));
}
MCKIBBEN_MEMBERS_AS_JSON(Cell, factor, cell, share_of_gap, significant, rows, mean, rms, p_value)
MCKIBBEN_MEMBERS_AS_JSON(BesideGap, reading, unit, noise_floor, nominal_rmse, recalibrated_rmse,
                         corrected_rmse)
MCKIBBEN_MEMBERS_AS_JSON(Start, lasting_s, share_of_gap, share_of_time, unsettled)
MCKIBBEN_MEMBERS_AS_JSON(NextExperiment, separates, current, load_kg, expected_power, waveform)
MCKIBBEN_MEMBERS_AS_JSON(NextSensor, separates, run, expected_power)
MCKIBBEN_MEMBERS_AS_JSON(RunGap, id, load_kg, held_out, left_out, nominal_rmse, recalibrated_rmse,
                         corrected_rmse)
MCKIBBEN_MEMBERS_AS_JSON(Ranked, round, name, variant, score, likeness, refitted, outcome)
MCKIBBEN_MEMBERS_AS_JSON(Explanation, kind, effects, misfit, strain, held_out_rmse, nats, held_out_nats,
                         held_out_error, mass, as_good, chosen)
MCKIBBEN_MEMBERS_AS_JSON(LeftOpen, parameters, known, words)
MCKIBBEN_MEMBERS_AS_JSON(FaultyRun, run, kind, size, unit, action, words)

}  // namespace mckibben::diagnose

namespace mckibben::output {
namespace {

using input::Json;

Json ci95(const diagnose::FittedNumber& number) {
  return {number.low, number.high};
}

Json value_json(const diagnose::FittedNumber& number) {
  Json json{{"value", number.value}, {"unit", number.unit}, {"ci95", ci95(number)}};
  if (!number.determined) json["determined"] = false;
  return json;
}

std::string last_part(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

/// The last part of a path, `rest_radius`; with its part of the rig, `valve_conductance`, where another
/// parameter that a calibration may move ends alike.
std::string short_key(const std::string& path, const plant::Rig& nominal) {
  const auto movable = diagnose::nominal_parameters(nominal, nominal.spreads);
  const auto alike = [&](const auto& other) {
    return other.path != path && last_part(other.path) == last_part(path);
  };
  if (std::none_of(movable.begin(), movable.end(), alike)) return last_part(path);
  constexpr std::string_view mechanics = "mechanics.";
  std::string key = path.starts_with(mechanics) ? path.substr(mechanics.size()) : path;
  std::replace(key.begin(), key.end(), '.', '_');
  return key;
}

Json support_json(const diagnose::Support& support) {
  const bool rivals = std::isfinite(support.before_rivals);
  return {{"misfit_fall", support.fall},
          {"before_rivals", rivals ? Json(support.before_rivals) : Json()},
          {"runs_for", support.by},
          {"runs_against", support.against}};
}

/// 1 or 2; of both nothing is said.
void tell_side(Json& json, diagnose::Side side) {
  if (side != diagnose::Side::both) json["side"] = side == diagnose::Side::one ? 1 : 2;
}

/// Other effects, whosever they are, by name.
std::vector<std::string> other_names(const diagnose::NamedEffect& effect) {
  std::vector<std::string> names;
  for (const auto& rival : effect.confusable_with)
    if (rival.effect != effect.name && std::ranges::find(names, rival.effect) == names.end())
      names.push_back(rival.effect);
  return names;
}

/// Of a pair: the same effect, or another one, of one muscle or of both; empty where whose is no question.
Json sides_json(const diagnose::NamedEffect& effect) {
  Json list = Json::array();
  for (const auto& rival : effect.confusable_with) {
    if (rival.side == effect.side && effect.side == diagnose::Side::both) continue;
    list.push_back({{"name", rival.effect}});
    tell_side(list.back(), rival.side);
  }
  return list;
}

Json effects_json(const std::vector<diagnose::NamedEffect>& effects) {
  Json list = Json::array();
  for (const auto& effect : effects) {
    Json parameters = Json::object();
    for (const auto& parameter : effect.parameters) parameters[parameter.name] = value_json(parameter);
    list.push_back({{"name", effect.name},
                    {"variant", effect.variant},
                    {"confusable_with", other_names(effect)},
                    {"parameters", parameters},
                    {"stands_in", effect.stands_in},
                    {"support", support_json(effect.support)}});
    tell_side(list.back(), effect.side);
    if (Json sides = sides_json(effect); !sides.empty()) list.back()["confusable_sides"] = std::move(sides);
  }
  return list;
}

Json bench_json(const diagnose::Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const auto& fault : diagnosis.bench)
    list.push_back({{"name", fault.name},
                    {"runs", fault.runs},
                    {"value", fault.size.value},
                    {"unit", fault.size.unit},
                    {"ci95", ci95(fault.size)},
                    {"write", fault.write},
                    {"words", fault.words}});
  return list;
}

Json recalibrated_json(const diagnose::Diagnosis& diagnosis, const plant::Rig& nominal) {
  Json all = Json::object();
  for (const auto& moved : diagnosis.recalibrated) {
    Json& json = all[short_key(moved.fitted.name, nominal)];
    json = {{"path", moved.fitted.name}, {"nominal", moved.nominal},   {"fitted", moved.fitted.value},
            {"unit", moved.fitted.unit}, {"ci95", ci95(moved.fitted)}, {"deviations", moved.deviations}};
  }
  return all;
}

Json law_json(const diagnose::Diagnosis& diagnosis) {
  if (diagnosis.residual_law.empty()) return nullptr;
  Json terms = Json::array();
  for (const auto& term : diagnosis.residual_law) {
    Json one = {{"term", term.term},
                {"coefficient", term.coefficient.value},
                {"unit", term.coefficient.unit},
                {"ci95", ci95(term.coefficient)}};
    for (const auto& shape : term.shape) one[shape.name] = value_json(shape);
    terms.push_back(std::move(one));
  }
  return {{"terms", terms}, {"valid_for", diagnosis.law_valid_for}};
}

Json gap_json(const diagnose::Diagnosis& diagnosis) {
  const auto& gap = diagnosis.gap;
  Json all{{"held_out_runs", held_out(diagnosis)}, {"noise_floor", gap.noise_floor},
           {"nominal_rmse", gap.nominal_rmse},     {"recalibrated_rmse", gap.recalibrated_rmse},
           {"corrected_rmse", gap.corrected_rmse}, {"closed", gap.closed},
           {"encoder_jitter", gap.jitter},         {"reading", std::string(plant::name_of(gap.judged))},
           {"unit", words_of(gap.judged).unit}};
  if (!gap.beside.empty()) all["beside"] = gap.beside;
  return all;
}

Json remaining_json(const diagnose::Remaining& remaining) {
  Json pattern = Json::array();
  for (const auto& dense : remaining.pattern)
    pattern.push_back({{"factor", dense.cell.factor},
                       {"cell", dense.cell.cell},
                       {"mean", dense.cell.mean},
                       {"share_of_gap", dense.cell.share_of_gap},
                       {"share_of_time", dense.share_of_time}});
  return {{"floors", remaining.floors}, {"share", remaining.share}, {"pattern", std::move(pattern)}};
}

Json ranking_json(const diagnose::Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const auto& one : diagnosis.ranking) {
    Json entry = one;
    if (one.refitted) {
      entry["training_rmse"] = one.training_rmse;
      entry["held_out_rmse"] = one.held_out_rmse;
      entry["fall"] = one.fall;
    }
    tell_side(entry, one.side);
    list.push_back(std::move(entry));
  }
  return list;
}

Json absorbed_json(const diagnose::Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const auto& one : diagnosis.absorbed)
    list.push_back({{"path", one.path}, {"deviations_without", one.without}, {"deviations_with", one.with}});
  return list;
}

Json rows_json(const domain::Rows& rows) {
  return {{"stamps", rows.stamps},
          {"slack", rows.slack},
          {"rows", rows.rows},
          {"row_s", rows.row_s},
          {"readings_of_a_row", rows.readings},
          {"input_stamps", rows.inputs},
          {"given_pressure_noise_bar", rows.given_noise_Pa / plant::Pa_per_bar},
          {"given_pressure", rows.given_noise_Pa > 0.0 ? "smoothed" : "as recorded"}};
}

Json search_json(const diagnose::Diagnosis& diagnosis) {
  using diagnose::Ended;
  const double limit_s = diagnosis.time_limit_s;
  return {{"ended", diagnosis.ended == Ended::no        ? Json()
                    : diagnosis.ended == Ended::by_time ? Json("by_time")
                    : diagnosis.ended == Ended::by_work ? Json("by_work")
                                                        : Json("by_user")},
          {"time_limit_s", std::isfinite(limit_s) ? Json(limit_s) : Json()},
          {"not_done", diagnosis.not_done}};
}

}  // namespace

std::string json_of(const domain::Dataset& data, const diagnose::Diagnosis& diagnosis) {
  Json document{{"schema", "mckibben-diagnosis/1"},
                {"verdict", std::string(plant::name_of(diagnosis.verdict))},
                {"because", diagnosis.because},
                {"bench", bench_json(diagnosis)},
                {"effects", effects_json(diagnosis.effects)},
                {"stand_ins", effects_json(diagnosis.stand_ins)},
                {"recalibrated", recalibrated_json(diagnosis, data.rig)},
                {"left_open", diagnosis.left_open},
                {"residual_law", law_json(diagnosis)},
                {"where", diagnosis.where},
                {"start_of_run", diagnosis.start},
                {"gap", gap_json(diagnosis)},
                {"remaining", remaining_json(diagnosis.remaining)},
                {"next_experiment", diagnosis.next_experiment ? Json(*diagnosis.next_experiment) : Json()},
                {"next_sensor", diagnosis.next_sensor ? Json(*diagnosis.next_sensor) : Json()},
                {"search", search_json(diagnosis)},
                {"false_alarm_rate", diagnosis.false_alarm_rate},
                {"seed", diagnosis.seed},
                {"warnings", diagnosis.warnings},
                {"faults", diagnosis.faults},
                {"runs", diagnosis.runs},
                {"explanations", diagnosis.explanations},
                {"ranking", ranking_json(diagnosis)},
                {"absorbed", absorbed_json(diagnosis)}};
  if (data.rows_of_stamps) document["rows"] = rows_json(*data.rows_of_stamps);
  Json heading = heading_json("mckibben-diagnosis/1", data.inputs);
  document["program"] = heading["program"];
  document["input_files"] = heading["input_files"];
  document["tolerance"] = data.rig.integrator.tolerance;
  document["rig"] = input::rig_json(data.rig);
  document["corrected_rig"] = input::rig_json(diagnosis.corrected);
  return text_of(document);
}

}  // namespace mckibben::output
