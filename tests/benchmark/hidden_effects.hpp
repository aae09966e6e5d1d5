// Measured data with something hidden in it, for scoring the diagnosis: made with the other engine and
// another tolerance than the diagnosis uses, laws sharper or softer than its own, a rig off its data
// sheet, jitter, counts and slow disturbances.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>

#include "other_law.hpp"

namespace mckibben::diagnose {

struct Planted {
  std::string path;  ///< of the parameter in a rig file
  double value;
};

struct Hidden {
  std::string title;
  Verdict verdict = Verdict::missing_effect;
  std::vector<std::string> effects{};
  bool other_law = false;          ///< beside them
  std::vector<Planted> truth{};    ///< of the effects
  std::vector<Planted> numbers{};  ///< of the rig, as it truly is
  domain::Dataset data{};
  plant::Rig rig{};      ///< that was measured
  plant::Noise noise{};  ///< what disturbed it
  std::uint64_t seed = 1;
};

/// The rig that is measured: the thesis's, one of another size, or one whose numbers are known three times
/// less well than a data sheet says, and say so.
enum class Bench { thesis, other_size, badly_known };

/// How far the rig's numbers are off their data sheet: by chance, as told; each by one deviation; or two of
/// them by three, the others by a tenth or so.
enum class OffSheet { by_chance, each_by_one, two_by_three };

struct Surroundings {
  Bench bench = Bench::thesis;
  OffSheet off_sheet = OffSheet::by_chance;
  OtherLaw other_law = OtherLaw::none;
  /// By how many of their deviations its numbers are off; unless told, a tenth where something is hidden.
  /// Those of a rig that is badly known are always as far off as they are known.
  std::optional<double> off_by{};
  double share = 1.0;  ///< of an effect's size
  std::size_t runs = 9;
  double lasting = 1.0;  ///< of the 7 to 11 s of a run
  bool poor = false;     ///< data: nothing but sines
};

/// What may be hidden. `kind` counts from 0 to kinds() - 1: each effect at two sizes, pairs, triples, changed
/// nominal parameters, nulls with white, wandering and rippling disturbance, laws outside the catalogue. Even
/// seeds hide the other sign where an effect may have either, every third the saturating bladder.
std::size_t kinds();
const std::string& title(std::size_t kind);
/// The one that has this title. Throws std::invalid_argument.
std::size_t kind_titled(std::string_view wanted);
Hidden hide(std::size_t kind, std::uint64_t seed, const Surroundings& surroundings = {});

/// Effects that have relatives (docs/effects.md), which poor data may take for them. Delays are not among
/// them, as no current tells which of the two it is.
inline constexpr std::array<std::string_view, 10> relatives{
    "viscous_damping", "guide_friction",  "bladder_hysteresis", "polytropic_gas",   "gas_temperature",
    "valve_lag",       "valve_dead_band", "valve_hysteresis",   "friction_warm_up", "encoder_backlash"};

/// The measurement that a diagnosis asks for, made on the rig that was measured.
domain::Run measured_as(const NextExperiment& wanted, const Hidden& hidden);

}  // namespace mckibben::diagnose
