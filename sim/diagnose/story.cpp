// See the header.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/story.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

constexpr std::string_view law_terms = "effects.residual_law.terms.";

std::string words(const plant::ForceTerm& term) {
  if (term.of == plant::Basis::sine) {
    const bool shifted = std::abs(term.phase_rad) >= thresholds.law.told_phase;
    return fmt::format(
        "sin(2 pi x / {:.3f} mm{})", 1e3 * term.wavelength_m,
        shifted ? fmt::format(" {} {:.2f} rad", term.phase_rad < 0.0 ? "-" : "+", std::abs(term.phase_rad))
                : "");
  }
  for (const auto& [basis, name] : names(plant::Basis{}))
    if (basis == term.of) return std::string(name);
  return {};
}

std::string sentence_of(const std::string& effect, const plant::Effects& of_rig) {
  std::string text;
  std::apply([&](const auto&... e) { ((effect == e.name ? void(text = e.sentence) : void()), ...); },
             plant::Effects::Table{});
  for (const auto& law : of_rig.laws.list)
    if (effect == law.text->name) text = law.text->sentence;
  return text;
}

}  // namespace

void tell_parameters(Diagnosis& diagnosis, const Model& model, const std::vector<Bounds>& bounds,
                     const RigFile& recalibrated) {
  const auto& terms = model.rig.effects.get<plant::ResidualForce>().terms;
  RigFile rig = model.rig;
  for (std::size_t j = 0; j < model.free.size(); ++j) {
    const Parameter& p = model.free[j];
    const Bounds& at = bounds[j];
    FittedNumber number{p.path,  find(rig, p.path).unit, at.value,    at.low,
                        at.high, at.determined,          at.quadratic};
    if (p.has_prior) {
      const double moved = p.deviations(number.value);
      const double most = thresholds.parameter.at_the_edge * thresholds.parameter.most_deviations;
      diagnosis.recalibrated.push_back({number, p.origin, moved, std::abs(p.scaled(number.value)) > most});
      diagnosis.absorbed.push_back({p.path, p.deviations(value_of(recalibrated, p.path)), moved});
      continue;
    }
    for (auto* effects : {&diagnosis.effects, &diagnosis.stand_ins})
      for (auto& effect : *effects) {
        std::string prefix = keys_of(effect.who());
        if (!p.path.starts_with(prefix)) prefix = fmt::format("effects.{}.{}.", of_laws, effect.name);
        if (!p.path.starts_with(prefix)) continue;
        number.name = p.path.substr(prefix.size());
        effect.parameters.push_back(number);
      }
    if (!p.path.starts_with(law_terms)) continue;
    // terms.INDEX.KEY: the nominal rig may have had terms of its own.
    const std::size_t dot = p.path.find('.', law_terms.size());
    number.name = p.path.substr(dot + 1);
    if (number.name == "coefficient") {
      const auto index = std::stoul(p.path.substr(law_terms.size(), dot - law_terms.size()));
      number.name = words(terms[index]);
      diagnosis.residual_law.push_back({number.name, number});
    } else {
      diagnosis.residual_law.back().shape.push_back(number);  // a term's coefficient comes first
    }
  }
}

std::string amount_of(Judged judged, double value, const RigFile& rig, int digits) {
  switch (judged) {
    case Judged::force:
      return fmt::format("{:.{}g} N", value, digits);
    case Judged::angle:
      return fmt::format("{:.{}g} deg", value / plant::degree_rad, digits);
    case Judged::contraction:
      break;
  }
  return fmt::format("{:.{}g} mm", 1e3 * value * rig.muscle.rest_length_m, digits);
}

std::string_view unit_in_words(Judged judged) {
  switch (judged) {
    case Judged::force:
      return "N";
    case Judged::angle:
      return "rad";
    case Judged::contraction:
      break;
  }
  return "in contraction ratio";
}

namespace {

std::string noise_of_given_pressure(const domain::Dataset& data, const NoiseFloor& floor) {
  switch (data.judged()) {
    case Judged::force:
      return fmt::format("force, {:.2g} N", floor.given);
    case Judged::angle:
      return fmt::format("joint, {}", amount_of(Judged::angle, floor.given, data.rig));
    case Judged::contraction:
      break;
  }
  return fmt::format("motion, {:.2g} in contraction ratio", floor.given);
}

}  // namespace

std::vector<std::string> sheets_in_words(const domain::Dataset& data, const NoiseFloor& floor) {
  std::vector<std::string> words;
  if (floor.command > 0.0)
    words.push_back(fmt::format(
        "the regulator repeats a pressure within {:.2g} mbar; what that does to what was read, {} (rms), "
        "counts "
        "in the noise floor",
        1e-2 * data.rig.valve.repeatability_Pa, amount_of(data.judged(), floor.command, data.rig)));
  if (floor.accuracy > 0.0)
    words.push_back(fmt::format("the sensor's accuracy, {}, counts in the noise floor",
                                amount_of(data.judged(), floor.accuracy, data.rig)));
  return words;
}

std::vector<std::string> rows_in_words(const domain::Dataset& data, const NoiseFloor& floor) {
  std::vector<std::string> words;
  if (!data.rows_of_stamps) return words;
  const domain::Rows& rows = *data.rows_of_stamps;
  if (rows.rows < rows.stamps)
    words.push_back(
        fmt::format("of {} stamps {} rows were judged, {:.3g} ms apart, each of {:.0f} readings on average; "
                    "the inputs were "
                    "followed at {} stamps, with all at which they jump or bend",
                    rows.stamps, rows.rows, 1e3 * rows.row_s, rows.readings, rows.inputs));
  if (rows.given_noise_Pa > 0.0)
    words.push_back(fmt::format(
        "the noise of the given pressure, {:.2g} mbar, {}; what it does to the {}, counts in the noise floor",
        1e-2 * rows.given_noise_Pa, rows.smoothed ? "was smoothed" : "was left as it is",
        noise_of_given_pressure(data, floor)));
  if (rows.slack > 0)
    words.push_back(
        fmt::format("{} readings of force are 0, a cord that hangs through: how far the muscle is from "
                    "pulling they do not say, and nothing goes by them",
                    rows.slack));
  if (rows.at_the_end > 0)
    words.push_back(
        fmt::format("{} readings of force are at the end of the load cell's range; nothing goes by them",
                    rows.at_the_end));
  if (data.force_is_judged())
    words.push_back(
        "the muscle's length is the input: what acts on the load, on its guide or on the encoder is out of "
        "sight, "
        "and runs are not looked through for faults of a recorder");
  const bool pair = data.judged() == Judged::angle;
  if (pair)
    words.push_back(
        "two muscles turn the joint: effects are looked for on both alike and on each; runs are not looked "
        "through for faults of a recorder, no further measurement is planned, and a load's guide there is "
        "none");
  if (data.pressure_is_given())
    words.push_back(
        fmt::format("the muscle{} the input: valve, supply, hose and gas are out of sight, and with them {}",
                    pair ? "s' pressures are" : "'s pressure is", fmt::join(effects_out_of_sight(), ", ")));
  return words;
}

std::string faults_in_words(const Diagnosis& d) {
  std::string text;
  for (const FaultyRun& faulty : d.faults) {
    if (faulty.common && &faulty != &d.faults.front() && faulty.kind == d.faults.front().kind) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ",
                        faulty.common ? "every run" : "run " + faulty.run, faulty.words);
  }
  if (text.empty()) return text;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text + ". ";
}

std::pair<std::string_view, std::string_view> told(domain::Beside which, bool pair) {
  switch (which) {
    case domain::Beside::force:
      return {"force", "N"};
    case domain::Beside::opposite_pressure:
      return {"muscle_pressure_2", "Pa"};
    case domain::Beside::muscle_pressure:
      break;
  }
  return {pair ? "muscle_pressure_1" : "muscle_pressure", "Pa"};
}

std::string besides_in_words(const domain::Dataset& data) {
  std::vector<std::string> list;
  for (const domain::Beside which : domain::besides) {
    const auto read = [&](const domain::Run& run) { return run.beside(which) != nullptr; };
    if (std::ranges::none_of(data.runs, read)) continue;
    const auto [reading, unit] = told(which, data.rig.pair() != nullptr);
    list.push_back(fmt::format("{}_{}", reading, unit == "Pa" ? "bar" : unit));
  }
  return fmt::format("{}", fmt::join(list, " and "));
}

std::string ignored_in_words(const domain::Dataset& data) {
  const auto has = [&](domain::Beside which) {
    return std::ranges::any_of(data.runs, [&](const auto& run) { return run.beside(which) != nullptr; });
  };
  const bool gauge = std::ranges::any_of(domain::gauges, has), cell = has(domain::Beside::force);
  const bool several = std::ranges::count_if(domain::besides, has) > 1;
  return fmt::format(
      "{} {} ignored: no model meets both {} and the motion, but one meets the motion alone "
      "(has the {} an offset, another scale, a limit; was it on another muscle?)",
      besides_in_words(data), several ? "are" : "is", several ? "them" : "it",
      gauge && cell ? "gauge or the load cell"
      : gauge       ? "gauge"
                    : "load cell");
}

std::string remark_in_words(Remark remark, const Naming& naming, double left, const std::string& besides) {
  std::vector<std::string> names;
  for (const NamedEffect& effect : naming.effects) names.push_back(full_name(effect));
  const double floors = std::sqrt(left + 1.0);
  switch (remark) {
    case Remark::gauge_misleads:
      return fmt::format("effects that would explain {} make the motion worse: is it right?", besides);
    case Remark::more_is_missing:
      return fmt::format(
          "{:.1f} noise floors are left with the effects named: more is missing, or their laws are "
          "not quite these",
          floors);
    case Remark::not_named:
      return fmt::format("nearest comes {}, but {:.1f} noise floors are left: not named",
                         fmt::join(names, " with "), floors);
    case Remark::stands_in: {
      std::vector<std::string> stand_ins;
      for (const NamedEffect& effect : naming.effects)
        if (effect.stands_in) stand_ins.push_back(full_name(effect));
      return fmt::format(
          "{}: added to the corrected rig, but no name for what is missing; how it drifts is a hint at the "
          "true "
          "law",
          fmt::join(stand_ins, " and "));
    }
    case Remark::bent_numbers:
      return fmt::format(
          "other numbers come nearest, but at the edge of what is allowed of them or with {:.1f} noise "
          "floors "
          "left: that is no explanation",
          floors);
    case Remark::invisible:
      break;
  }
  return fmt::format("these data would not show, even at their usual size: {}",
                     fmt::join(naming.invisible, ", "));
}

std::string far_runs_in_words(const std::vector<FarRun>& runs) {
  std::vector<std::string> list;
  list.reserve(runs.size());
  for (const FarRun& run : runs) list.push_back(fmt::format("{} by {:.0f}", run.id, std::sqrt(run.left)));
  std::sort(list.begin(), list.end());
  return fmt::format("{}", fmt::join(list, ", "));
}

namespace {

std::string amount_in_words(const Diagnosis& d, double value) {
  return amount_of(d.gap.judged, value, d.corrected);
}
std::string what_is_judged(const Diagnosis& d) {
  switch (d.gap.judged) {
    case Judged::force:
      return "the cord's force";
    case Judged::angle:
      return "the joint's angle";
    case Judged::contraction:
      break;
  }
  return "the load's height";
}

std::string gap_in_words(const Diagnosis& d) {
  return fmt::format(
      "On runs that the fit has not seen the error of {} falls from {} to {}; the instruments cannot see "
      "below "
      "{}.",
      what_is_judged(d), amount_in_words(d, d.gap.nominal_rmse), amount_in_words(d, d.gap.corrected_rmse),
      amount_in_words(d, d.gap.noise_floor));
}

/// Numbers further off than they are stated to be; empty, or sentences and a space.
std::string exceeded_in_words(const Diagnosis& d) {
  std::string text;
  for (const Moved& m : d.recalibrated) {
    if (!m.exceeds()) continue;
    const double deviation = std::abs((m.fitted.value - m.nominal) / m.deviations);
    text += fmt::format(
        "The ± of {}, {:.2g}{}, is exceeded: it is off by {:.1f} times that; measure it, or ask "
        "where the value comes from. ",
        m.fitted.name, deviation, m.fitted.unit == "1" ? "" : " " + m.fitted.unit, std::abs(m.deviations));
  }
  return text;
}

std::string numbers_in_words(const Diagnosis& d) {
  std::string moved;
  for (const Moved& m : d.recalibrated) {
    if (!m.notable()) continue;
    moved += fmt::format("{}{} from {:.4g} to {:.4g}{}", moved.empty() ? "" : ", ", m.fitted.name, m.nominal,
                         m.fitted.value, m.fitted.unit == "1" ? "" : " " + m.fitted.unit);
  }
  return fmt::format("No effect is missing; other values of the rig's parameters explain the gap{}{}. {}{}",
                     moved.empty() ? "" : ": ", moved, exceeded_in_words(d), gap_in_words(d));
}

/// What is not the same everywhere, and how; empty if nothing is.
std::string stand_ins_in_words(const Diagnosis& d) {
  std::string said;
  for (const NamedEffect& effect : d.stand_ins) {
    const Drift* drift = effect.constancy.drift();
    said += fmt::format(" {} stands in for it: ", full_name(effect));
    if (drift == nullptr || effect.parameters.empty()) {
      said += "much is left, and no two parts of the data show its size.";
      continue;
    }
    said += fmt::format("along the {} its size differs by {:.0f} % for certain (", drift->along,
                        100.0 * drift->share);
    bool first = true;
    for (const SizeIn& size : drift->sizes) {
      if (!std::isfinite(size.error)) continue;
      const std::string& unit = effect.parameters.front().unit;
      said += fmt::format("{}{:.3g}{} at {}", first ? "" : ", ", size.value, unit == "1" ? "" : " " + unit,
                          size.part);
      first = false;
    }
    said += "), as no real effect's does.";
  }
  return said;
}

/// Of which muscle it is, if that is open; what else it may be.
std::string doubts_in_words(const NamedEffect& effect) {
  std::vector<std::string> others;
  std::size_t sides = 0;
  for (const EffectName& rival : effect.confusable_with) {
    if (rival.effect == effect.name) ++sides;
    if (rival.effect != effect.name || effect.side != Side::both) others.push_back(rival.words());
  }
  std::string said;
  if (effect.side == Side::both && sides > 0)
    said = " - whether of both muscles alike or of one these data cannot tell";
  if (!others.empty()) said += fmt::format(" - these data cannot tell it from {}", fmt::join(others, ", "));
  return said;
}

std::string effects_in_words(const Diagnosis& d) {
  std::string said;
  for (const NamedEffect& effect : d.effects) {
    said += fmt::format("{}{} ({})", said.empty() ? "" : ", and ", effect.who().words(),
                        sentence_of(effect.name, d.corrected.effects));
    said += doubts_in_words(effect);
  }
  const std::string more = stand_ins_in_words(d);
  return fmt::format("Missing: {}.{} {}{}", said,
                     more.empty() ? "" : " Something else is missing besides." + more, exceeded_in_words(d),
                     gap_in_words(d));
}

std::string law_in_words(const Diagnosis& d) {
  std::string law;
  for (const LawTerm& term : d.residual_law)
    law += fmt::format("{}{:.3g} N x {}", law.empty() ? "" : " + ", term.coefficient.value, term.term);
  if (law.empty() && !d.stand_ins.empty())
    return fmt::format("Something real is missing that no effect of the catalogue explains.{} {}",
                       stand_ins_in_words(d), gap_in_words(d));
  if (law.empty())
    return "Something real is missing, but no effect of the catalogue explains it, and no simple law of "
           "force was found either.";
  return fmt::format(
      "Something is missing that no effect of the catalogue explains; as a force {} it is {}. {}",
      d.gap.judged == Judged::angle ? "that shortens each muscle" : "on the load", law, gap_in_words(d));
}

std::string cannot_tell_in_words(const Diagnosis& d) {
  if (d.ended != Ended::no)
    return "Nothing that was found until then tells what is missing, or that nothing is.";
  if (!d.unexplained.empty())
    return fmt::format(
        "Something is wrong that these data do not settle: no model comes near every run (in noise floors: "
        "{}), and no effect "
        "convinces on the runs held out.",
        d.unexplained);
  if (std::any_of(d.faults.begin(), d.faults.end(), [](const FaultyRun& f) { return f.common; }))
    return "Apart from that model and data agree, but whether the recorder does it or the rig, these data "
           "cannot tell.";
  return "Nothing was found, but these data would not show more than half of the effects of the catalogue at "
         "their usual size: whether one is missing they cannot tell.";
}

/// Empty if it was through.
std::string search_in_words(const Diagnosis& d) {
  if (d.ended == Ended::no) return {};
  return fmt::format(
      "The search was ended {} before it was through; not done to the end: {}. ",
      d.ended == Ended::by_user ? "by you" : fmt::format("by its time limit of {:g} s", d.time_limit_s),
      fmt::join(d.not_done, "; "));
}

std::string verdict_in_words(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::nothing_missing:
      return fmt::format(
          "{} to within noise: on runs held out {} differs by {}, and neither other values of "
          "the nominal parameters nor any effect of the catalogue makes that convincingly less.",
          d.faults.empty() ? "Model and data agree" : "Apart from that model and data agree",
          what_is_judged(d), amount_in_words(d, d.gap.nominal_rmse));
    case Verdict::recalibrate:
      return numbers_in_words(d);
    case Verdict::missing_effect:
      return effects_in_words(d);
    case Verdict::unknown_effect:
      return law_in_words(d);
    case Verdict::cannot_tell:
      break;
  }
  return cannot_tell_in_words(d);
}

}  // namespace

std::string because(const Diagnosis& diagnosis) {
  return search_in_words(diagnosis) + faults_in_words(diagnosis) + verdict_in_words(diagnosis);
}

}  // namespace mckibben::diagnose
