// What holds for every controller of the table.
#include <controllers/settings.hpp>

namespace mckibben::controllers {

std::unique_ptr<Controller> make(const Settings& settings, const Knowledge& knowledge) {
  auto made = std::visit([&](const auto& one) { return one.make(knowledge); }, settings);
  const CommandFilter* filter = filter_of(settings);
  if (filter == nullptr) return made;
  return filtered(*filter, limits_of(settings, knowledge), knowledge.tick_s, std::move(made));
}

const CommandFilter* filter_of(const Settings& settings) {
  const auto* terms = part_of<CommandTerms>(settings);
  return terms != nullptr && terms->command_filter ? &*terms->command_filter : nullptr;
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
  if (const OutputLimits* limits = part_of<OutputLimits>(complete)) return limits->within(knowledge);
  if (part_of<CalibrationTerms>(complete) != nullptr || part_of<PlansWithModel>(complete) != nullptr ||
      std::holds_alternative<StaticInverseSettings>(complete))
    return working_range(knowledge);
  return std::nullopt;
}

const WeighingSettings* weighing_of(const Settings& settings) {
  const auto* weighs = part_of<CalibratedSettings>(settings);
  return weighs != nullptr ? &weighs->weighing : nullptr;
}

}  // namespace mckibben::controllers
