// What holds for every controller of the table.
#include <algorithm>
#include <concepts>
#include <type_traits>

#include <controllers/settings.hpp>

namespace mckibben::controllers {
namespace {

template <class Part, class Whole>
Part* part_of(Whole& settings) {
  return std::visit(
      [](auto& one) -> Part* {
        if constexpr (std::derived_from<std::remove_cvref_t<decltype(one)>, std::remove_const_t<Part>>)
          return &one;
        return nullptr;
      },
      settings);
}

}  // namespace

std::unique_ptr<Controller> make(const Settings& settings, const Knowledge& knowledge) {
  return std::visit([&](const auto& one) { return one.make(knowledge); }, settings);
}

const std::string& name_of(const Settings& settings) {
  return std::visit([](const auto& one) -> const std::string& { return one.name; }, settings);
}

void follow(Settings& settings, const CurrentRange& range) {
  std::visit(
      [&](auto& one) {
        if constexpr (requires { one.follow(range); }) one.follow(range);
      },
      settings);
}

std::optional<CurrentRange> limits_of(const Settings& settings, const Knowledge& knowledge) {
  const auto* open_loop = std::get_if<OpenLoopSettings>(&settings);
  if (open_loop != nullptr && open_loop->mode == OpenLoopMode::triangle) return std::nullopt;
  if (knowledge.pair) return std::nullopt;
  Settings complete = settings;
  follow(complete, working_range(knowledge));
  if (const OutputLimits* limits = output_limits(complete)) return limits->within(knowledge);
  if (calibrated(complete) != nullptr || model_terms(complete) != nullptr ||
      std::holds_alternative<StaticInverseSettings>(complete))
    return working_range(knowledge);
  return std::nullopt;
}

PidForm* feedback_of(Settings& settings) {
  return part_of<PidForm>(settings);
}

const OutputLimits* output_limits(const Settings& settings) {
  return part_of<const OutputLimits>(settings);
}

GuestTerms* guest_terms(Settings& settings) {
  return part_of<GuestTerms>(settings);
}

const GuestTerms* guest_terms(const Settings& settings) {
  return part_of<const GuestTerms>(settings);
}

PlansWithModel* model_terms(Settings& settings) {
  return part_of<PlansWithModel>(settings);
}

const PlansWithModel* model_terms(const Settings& settings) {
  return part_of<const PlansWithModel>(settings);
}

CalibrationTerms* calibrated(Settings& settings) {
  return part_of<CalibrationTerms>(settings);
}

const CalibrationTerms* calibrated(const Settings& settings) {
  return part_of<const CalibrationTerms>(settings);
}

const WeighingSettings* weighing_of(const Settings& settings) {
  const auto* weighs = part_of<const CalibratedSettings>(settings);
  return weighs != nullptr ? &weighs->weighing : nullptr;
}

}  // namespace mckibben::controllers
