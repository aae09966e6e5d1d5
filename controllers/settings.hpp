// The one table of controllers: an entry here and its header make a controller known to scenarios. What
// drives one muscle cannot drive two, so each is listed under the rigs that it is for.
#pragma once

#include <concepts>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>

#include <controllers/controller.hpp>
#include <controllers/external.hpp>
#include <controllers/feedforward_pid.hpp>
#include <controllers/lever_pid.hpp>
#include <controllers/model_inverse.hpp>
#include <controllers/open_loop.hpp>
#include <controllers/open_loop_limited.hpp>
#include <controllers/pair_model_inverse.hpp>
#include <controllers/pair_pid.hpp>
#include <controllers/pid.hpp>
#include <controllers/plugin.hpp>
#include <controllers/static_inverse.hpp>
#include <controllers/waveform.hpp>

namespace mckibben::controllers {

/// Of one muscle that lifts a load.
using SingleSettings =
    std::variant<PidSettings, FeedforwardPidSettings, OpenLoopSettings, OpenLoopLimitedSettings,
                 StaticInverseSettings, ModelInverseSettings, ModelInverseFeedbackSettings, ExternalSettings,
                 PluginSettings, SineCurrent, TriangleCurrent, StepCurrent, StairCurrent, ChirpCurrent,
                 RecordedCurrent>;
/// Of one muscle that turns a lever.
using LeverSettings = std::variant<LeverPidSettings, ExternalSettings, PluginSettings, SineCurrent,
                                   TriangleCurrent, StepCurrent, StairCurrent, ChirpCurrent, RecordedCurrent>;
/// Of two muscles that turn a joint.
using PairSettings =
    std::variant<PairPidSettings, PairModelInverseSettings, PairModelInverseFeedbackSettings>;

template <class... Ones, class... Pairs>
std::variant<Ones..., LeverPidSettings, Pairs...> joined(std::variant<Ones...>, std::variant<Pairs...>);
using Settings = decltype(joined(SingleSettings(), PairSettings()));

template <class One, class Variant>
inline constexpr bool is_one_of = false;
template <class One, class... All>
inline constexpr bool is_one_of<One, std::variant<All...>> = (std::same_as<One, All> || ...);

/// The same settings among others: those of one kind of rig, or all. Throws std::invalid_argument if they are
/// none of them.
template <class To, class... From>
To settings_as(const std::variant<From...>& settings) {
  return std::visit(
      []<class One>(const One& one) -> To {
        if constexpr (is_one_of<One, To>)
          return To(std::in_place_type<One>, one);
        else
          throw std::invalid_argument("a controller of another kind of rig");
      },
      settings);
}

/// A controller at its beginning, its commands filtered as they are to be. Throws std::invalid_argument if
/// the settings are incomplete: a PID whose gains are still to be tuned, a recording that was not read.
std::unique_ptr<Controller> make(const Settings& settings, const Knowledge& knowledge);

/// The name it goes by in tables and files.
const std::string& name_of(const Settings& settings);

/// Currents that are left open become what they follow: the ends of what the rig's valve answers to.
void follow(Settings& settings, const CurrentRange& range);

/// Between which currents the controller works; none for a given current, which has no limits of its own, and
/// of two muscles, whose limits are those of their pressures.
std::optional<CurrentRange> limits_of(const Settings& settings, const Knowledge& knowledge);

/// What the settings share with other controllers: the feedback (PidForm), the ends of the output
/// (OutputLimits), what is said of somebody else's program (GuestTerms), of a calibration (CalibrationTerms),
/// of a model of the rig (PlansWithModel), of its commands (CommandTerms). Null if they have no such part.
template <class Part, class Whole>
auto part_of(Whole& settings) {
  using Found = std::conditional_t<std::is_const_v<Whole>, const Part, Part>;
  return std::visit(
      [](auto& one) -> Found* {
        if constexpr (std::derived_from<std::remove_cvref_t<decltype(one)>, Part>) return &one;
        return nullptr;
      },
      settings);
}

/// What filters its commands, if anything does, else null.
const CommandFilter* filter_of(const Settings& settings);

/// How a controller weighs the load in contractions, if it does, else null.
const WeighingSettings* weighing_of(const Settings& settings);

}  // namespace mckibben::controllers
