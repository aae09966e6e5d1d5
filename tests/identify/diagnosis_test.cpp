// What is handed over of small data sets whose answer is known.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <sim/identify/diagnosis.hpp>
#include <sim/identify/held_out.hpp>
#include <sim/identify/screen.hpp>

#include "diagnose/planted.hpp"
#include "identify/handed_over.hpp"
#include "says.hpp"

namespace mckibben::identify {
namespace {

const diagnose::Moved* moved(const Diagnosis& found, const std::string& path) {
  const auto at =
      std::ranges::find_if(found.recalibrated, [&](const auto& one) { return one.fitted.name == path; });
  return at == found.recalibrated.end() ? nullptr : &*at;
}

TEST(HandedOver, AnEffectWithItsIntervalTheRigWithItAndTheGapThatItCloses) {
  const Diagnosis found = handed_over(diagnose::small(with_a_leak()));
  ASSERT_EQ(found.effects.size(), 1U) << found.because;
  EXPECT_EQ(found.effects[0].name, "muscle_leak");
  EXPECT_TRUE(found.effects[0].confusable_with.empty());
  EXPECT_EQ(found.effects[0].support.by.size(), 6U);
  ASSERT_EQ(found.effects[0].parameters.size(), 1U);
  const FittedNumber& conductance = found.effects[0].parameters[0];
  EXPECT_EQ(conductance.name, "conductance");
  EXPECT_EQ(conductance.unit, "m3/(s.Pa)");
  EXPECT_TRUE(surrounds(conductance, 2e-10));
  EXPECT_LT(conductance.high - conductance.low, 0.4e-10);
  EXPECT_TRUE(conductance.determined);
  EXPECT_EQ(found.corrected.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa, conductance.value);
  EXPECT_TRUE(found.because.starts_with("Missing: muscle_leak")) << found.because;
  EXPECT_TRUE(found.bench.empty());

  EXPECT_GT(found.gap.nominal_rmse, 5.0 * found.gap.noise_floor);
  EXPECT_LT(found.gap.corrected_rmse, 1.3 * found.gap.noise_floor);
  EXPECT_LT(found.gap.corrected_rmse, found.gap.recalibrated_rmse);
  EXPECT_GT(found.gap.closed, 0.95);
  ASSERT_EQ(found.runs.size(), 6U);
  for (const diagnose::RunGap& run : found.runs) {  // each is predicted from those of other loads
    EXPECT_TRUE(run.held_out);
    ASSERT_EQ(run.corrected.size(), run.measured.size());
    double square = 0.0;
    for (std::size_t k = 0; k < run.measured.size(); ++k)
      square += std::pow(run.measured[k] - run.corrected[k], 2);
    EXPECT_NEAR(std::sqrt(square / static_cast<double>(run.measured.size())), run.corrected_rmse,
                0.05 * run.corrected_rmse);
  }

  ASSERT_FALSE(found.ranking.empty());
  EXPECT_EQ(found.ranking[0].name, "muscle_leak");
  EXPECT_EQ(found.ranking[0].outcome, "chosen");
  ASSERT_FALSE(found.explanations.empty());
  EXPECT_EQ(std::ranges::count_if(found.explanations, &diagnose::Explanation::chosen), 1);
  EXPECT_TRUE(found.explanations[0].chosen);
  EXPECT_EQ(found.explanations[0].nats, 0.0);
  EXPECT_FALSE(found.where.empty());
  EXPECT_FALSE(found.recalibrated.empty());
}

TEST(HandedOver, TheRigAsDescribedWhereNothingIsMissing) {
  const Diagnosis found = handed_over(diagnose::small({}));
  EXPECT_EQ(found.verdict, Verdict::nothing_missing) << found.because;
  EXPECT_TRUE(found.recalibrated.empty());
  EXPECT_TRUE(found.bench.empty());
  EXPECT_LT(found.gap.corrected_rmse, 1.3 * found.gap.noise_floor);
}

// Other numbers fit the wander better than the rig as described does, and predict no better.
TEST(HandedOver, NothingIsMissingWhereTheSupplyWandersSlowly) {
  domain::Dataset data = diagnose::small({});
  for (std::size_t r = 0; r < data.runs.size(); ++r) {  // 8 mbar of 5 bar over 16 mA
    std::vector<double>& current_mA = data.runs[r].current_mA;
    for (std::size_t k = 0; k < current_mA.size(); ++k)
      current_mA[k] -= 0.025 * std::sin(3.0 * 0.012 * static_cast<double>(k) + static_cast<double>(r));
  }
  const Diagnosis found = handed_over(data);
  EXPECT_EQ(found.verdict, Verdict::nothing_missing) << found.because;
  EXPECT_TRUE(found.effects.empty());
}

// A force along the stroke that no effect of the catalogue is like, beside a leak that it cannot imitate.
TEST(HandedOver, AnEffectAndWhatElseIsMissingBesideIt) {
  plant::Rig truth = with_a_leak();
  truth.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 1e-9;
  truth.effects.get<plant::ResidualForce>().terms = {{plant::Basis::sine, 1.0, 0.012}};
  const Diagnosis found = handed_over(diagnose::small(truth));
  EXPECT_EQ(found.verdict, Verdict::missing_effect) << found.because;
  ASSERT_EQ(found.effects.size(), 1U) << found.because;
  EXPECT_EQ(found.effects[0].name, "muscle_leak");
  EXPECT_TRUE(surrounds(found.effects[0].parameters[0], 1e-9));
  EXPECT_FALSE(found.residual_law.empty());
  EXPECT_FALSE(found.law_valid_for.empty());
  EXPECT_TRUE(found.stand_ins.empty());
  EXPECT_TRUE(holds(found.because, "Missing: muscle_leak", "Something else is missing, too: as a force"))
      << found.because;
}

TEST(HandedOver, ParametersThatMovedInTheUnitsOfTheRig) {
  plant::Rig truth;
  truth.friction.scale = 1.25;
  const Diagnosis found = handed_over(diagnose::small(truth));
  EXPECT_EQ(found.verdict, Verdict::recalibrate) << found.because;
  const diagnose::Moved* scale = moved(found, "friction.scale");
  ASSERT_NE(scale, nullptr);
  EXPECT_TRUE(surrounds(scale->fitted, 1.25));
  EXPECT_EQ(scale->nominal, 1.0);
  EXPECT_NEAR(scale->deviations, 2.5, 0.5);
  EXPECT_EQ(found.corrected.friction.scale, scale->fitted.value);
  EXPECT_GT(found.gap.closed, 0.95);
}

/// The rig as described, its parameters, and general terms, all of a family or one: as a search finds them.
Identified with_general_terms(domain::Dataset data, const Settings& settings, Terms terms, double term_N,
                              bool one = false) {
  Identified found;
  found.study = std::make_shared<const Study>(std::move(data), settings);
  const Study& study = *found.study;
  const Dictionary& dictionary = study.dictionary;
  const Error error(study.rows, study.simulator.wander(dictionary.setting(dictionary.described())));
  Model described(study.problem, dictionary.described(), error),
      parameters(study.problem, dictionary.nominal(), error);
  for (Model* model : {&described, &parameters}) model->look();
  described.evidence();
  parameters.settle({.rounds = 2});
  parameters.evidence();
  Model general = parameters.with_terms(terms, columns_of(parameters, terms), term_N);
  if (one) {
    general = Model(study.problem, few_of(general, term_N).front().point, error, term_N);
    general.look();
    general.settle({});
    general.evidence();
  }
  for (const Model& model : {described, parameters, general}) {
    found.models.push_back(model);
    found.models.back().score = model.log_evidence;
    found.table.push_back({.names = dictionary.names(model.point),
                           .described = model.point.z.size() == 0,
                           .general = model.point.terms != Terms::none,
                           .score = model.log_evidence,
                           .held_out = held_out(model, groups_of(study.rows))});
  }
  found.decision = decide(found.table);
  return found;
}

// A leak that the sheet allows is found where more is missing; one that needs other parameters is not.
TEST(HandedOver, NamesThatLeaveTheGapAndNeedWhatTheSheetForbidsAreNoFindings) {
  plant::Rig truth;
  truth.effects.get<plant::ResidualForce>().terms = {{plant::Basis::sine, 8.0, 0.012}};
  const Settings settings{.threads = 2};
  Identified found = with_general_terms(diagnose::small(truth, 2.5), settings, Terms::smooth, 25.0);
  const Model& parameters = found.models[1];
  const auto& entries = found.study->dictionary.entries;
  const auto leak = std::ranges::find(entries, "muscle_leak", &Entry::name);
  ASSERT_NE(leak, entries.end());
  Model named(found.study->problem,
              parameters.point.with({static_cast<std::size_t>(leak - entries.begin()), 1.0}),
              parameters.error);
  named.look();
  named.evidence();
  found.models[2] = named;
  found.table[2] = {.names = {"muscle_leak"}, .held_out = held_out(named, groups_of(found.study->rows))};
  found.decision = {.verdict = Verdict::missing_effect, .chosen = 2, .best = 2, .mass = {0.0, 0.0, 1.0}};
  EXPECT_EQ(diagnosis_of(found, settings).verdict, Verdict::missing_effect);
  found.decision.contradicts_sheet = true;
  const Diagnosis said = diagnosis_of(found, settings);
  EXPECT_EQ(said.verdict, Verdict::unknown_effect) << said.because;
  EXPECT_TRUE(said.effects.empty());
}

TEST(HandedOver, ALawOutsideTheCatalogueThatTheRigCarries) {
  plant::Rig truth;
  truth.effects.get<plant::ResidualForce>().terms = {
      {.of = plant::Basis::pressure_ratio, .coefficient_N = 30.0}};
  const Settings settings{.threads = 2};
  const Diagnosis found =
      diagnosis_of(with_general_terms(diagnose::small(truth, 2.5), settings, Terms::smooth, 25.0), settings);
  EXPECT_EQ(found.verdict, Verdict::unknown_effect) << found.because;
  EXPECT_TRUE(found.effects.empty());
  ASSERT_FALSE(found.residual_law.empty()) << found.because;
  const auto& terms = found.corrected.effects.get<plant::ResidualForce>().terms;
  ASSERT_EQ(terms.size(), found.residual_law.size());
  EXPECT_EQ(terms[3].coefficient_N, found.residual_law[3].coefficient.value);
  EXPECT_FALSE(found.law_valid_for.empty());
  EXPECT_TRUE(holds(found.because, "as a force on the load it is", "smaller terms"));
  EXPECT_LT(found.gap.corrected_rmse, 0.5 * found.gap.nominal_rmse);
}

// A sine and a cosine whose wavelength is none of the family's.
TEST(HandedOver, OneWaveWithItsWavelengthAndPhase) {
  plant::Rig truth;
  truth.effects.get<plant::ResidualForce>().terms = {
      {.of = plant::Basis::sine, .coefficient_N = 6.0, .wavelength_m = 0.012, .phase_rad = 0.8}};
  const Settings settings{.threads = 2};
  const Diagnosis found = diagnosis_of(
      with_general_terms(diagnose::small(truth, 2.5), settings, Terms::waves, 5.0, true), settings);
  EXPECT_EQ(found.verdict, Verdict::unknown_effect) << found.because;
  ASSERT_EQ(found.residual_law.size(), 1u) << found.because;
  const diagnose::LawTerm& wave = found.residual_law[0];
  EXPECT_TRUE(surrounds(wave.coefficient, 6.0));
  ASSERT_EQ(wave.shape.size(), 2u);
  EXPECT_EQ(wave.shape[0].name, "wavelength");
  EXPECT_NEAR(wave.shape[0].value, 0.012, 5e-5);
  EXPECT_LT(wave.shape[0].high - wave.shape[0].low, 5e-5);
  EXPECT_EQ(wave.shape[1].name, "phase");
  EXPECT_NEAR(wave.shape[1].value, 0.8, 0.05);
  const auto& terms = found.corrected.effects.get<plant::ResidualForce>().terms;
  ASSERT_EQ(terms.size(), 1u);
  EXPECT_EQ(terms[0].wavelength_m, wave.shape[0].value);
  EXPECT_GT(found.gap.closed, 0.9);
}

TEST(HandedOver, TheBestSoFarOfASearchThatWasEnded) {
  const domain::Dataset data = diagnose::small(with_a_leak(), 2.0);
  const Diagnosis at_once = handed_over(data, {.threads = 2, .time_limit_s = 0.0});
  EXPECT_EQ(at_once.verdict, Verdict::cannot_tell);
  EXPECT_EQ(at_once.ended, Ended::by_time);
  EXPECT_TRUE(at_once.because.starts_with("So far: ")) << at_once.because;
  EXPECT_TRUE(holds(at_once.because, "not done to the end: the rig's parameters; effects"));

  // Work, not time: alike on every machine.
  const Diagnosis later = handed_over(data, {.threads = 1, .most_passes = 120});
  EXPECT_EQ(later.ended, Ended::by_work);
  EXPECT_EQ(later.verdict, Verdict::cannot_tell);
  EXPECT_LT(later.gap.corrected_rmse, later.gap.nominal_rmse);  // never less than what was found
  EXPECT_FALSE(later.recalibrated.empty());
  const Diagnosis again = handed_over(data, {.threads = 2, .most_passes = 120});
  EXPECT_EQ(again.gap.corrected_rmse, later.gap.corrected_rmse);
  EXPECT_EQ(again.because, later.because);
}

TEST(HandedOver, DelaysThatNoCurrentSeparatesAndAGaugeThatWould) {
  plant::Rig late;
  late.effects.get<plant::CommandDelay>().time_s = 0.04;
  const Diagnosis found = handed_over(diagnose::small(late));
  ASSERT_EQ(found.effects.size(), 1U) << found.because;
  ASSERT_EQ(found.effects[0].confusable_with.size(), 1U);
  EXPECT_GT(found.effects[0].support.before_rivals, 6.0);  // of those that are not as good
  EXPECT_FALSE(found.next_experiment);
  ASSERT_TRUE(found.next_sensor);
  EXPECT_GT(found.next_sensor->expected_power, 0.9);
}

}  // namespace
}  // namespace mckibben::identify
