// The one table of controllers: an entry here and its header make a controller known to scenarios.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include <controllers/controller.hpp>
#include <controllers/external.hpp>
#include <controllers/feedforward_pid.hpp>
#include <controllers/model_inverse.hpp>
#include <controllers/model_inverse_feedback.hpp>
#include <controllers/open_loop.hpp>
#include <controllers/open_loop_limited.hpp>
#include <controllers/pid.hpp>
#include <controllers/plugin.hpp>
#include <controllers/static_inverse.hpp>
#include <controllers/waveform.hpp>

namespace mckibben::controllers {

using Settings = std::variant<PidSettings, FeedforwardPidSettings, OpenLoopSettings, OpenLoopLimitedSettings,
                              StaticInverseSettings, ModelInverseSettings, ModelInverseFeedbackSettings,
                              ExternalSettings, PluginSettings, SineCurrent, TriangleCurrent, StepCurrent,
                              StairCurrent, ChirpCurrent, RecordedCurrent>;

/// A controller at its beginning. Throws std::invalid_argument if the settings are incomplete: a PID whose
/// gains are still to be tuned, a recording that was not read.
std::unique_ptr<Controller> make(const Settings& settings, const Knowledge& knowledge);

/// The name it goes by in tables and files.
const std::string& name_of(const Settings& settings);

/// Currents that are left open become what they follow: the ends of what the rig's valve answers to.
void follow(Settings& settings, const CurrentRange& range);

/// Between which currents the controller works; none for a given current, which has no limits of its own.
std::optional<CurrentRange> limits_of(const Settings& settings, const Knowledge& knowledge);

/// The feedback terms of a controller that has some, else null.
PidTerms* pid_terms(Settings& settings);

/// The ends of the output of a controller that lets them be given, else null.
const OutputLimits* output_limits(const Settings& settings);

/// What is said about a controller that is somebody else's program, else null.
GuestTerms* guest_terms(Settings& settings);
const GuestTerms* guest_terms(const Settings& settings);

/// What a controller that needs a calibration says about it, else null.
CalibrationTerms* calibrated(Settings& settings);
const CalibrationTerms* calibrated(const Settings& settings);

/// How a controller weighs the load in contractions, if it does, else null.
const WeighingSettings* weighing_of(const Settings& settings);

/// What a controller that plans with a model says about it, else null.
ModelTerms* model_terms(Settings& settings);
const ModelTerms* model_terms(const Settings& settings);

}  // namespace mckibben::controllers
