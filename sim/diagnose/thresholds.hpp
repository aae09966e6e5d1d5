// Every number that a diagnosis goes by: its unit, what it means, where it comes from; a file for each stage,
// in running order. No other file of this room has one.
//
// Where no origin is told, a number was chosen by hand; docs/testing.md has the seeds of the benchmark on
// which the workflow as a whole was looked at, and those by which it is judged. Mean squares of residuals are
// over the noise floor's; "left" is what they are above it.
#pragma once

#include <sim/diagnose/thresholds/baseline.hpp>
#include <sim/diagnose/thresholds/check.hpp>
#include <sim/diagnose/thresholds/decide.hpp>
#include <sim/diagnose/thresholds/law.hpp>
#include <sim/diagnose/thresholds/name.hpp>
#include <sim/diagnose/thresholds/plan.hpp>
#include <sim/diagnose/thresholds/shared.hpp>
#include <sim/diagnose/thresholds/where.hpp>

namespace mckibben::diagnose {

struct Thresholds {
  NearThresholds near{};
  ScatterThresholds scatter{};
  PredictThresholds predict{};
  ParameterThresholds parameter{};
  LabelThresholds label{};
  FaultThresholds fault{};
  NoiseThresholds noise{};
  HeldOutThresholds held_out{};
  AskedThresholds asked{};
  FitThresholds fit{};
  StartsThresholds starts{};
  IntervalThresholds interval{};
  LeftOpenThresholds left_open{};
  WhereThresholds where{};
  ScreenThresholds screen{};
  ImprovementThresholds improvement{};
  NameThresholds name{};
  FurtherThresholds further{};
  SubsetThresholds subset{};
  CompetitionThresholds competition{};
  ConstancyThresholds constancy{};
  LawThresholds law{};
  DecideThresholds decide{};
  StartThresholds start{};
  PlanThresholds plan{};
};

inline constexpr Thresholds thresholds{};

}  // namespace mckibben::diagnose
