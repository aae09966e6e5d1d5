// What holds for every controller of the table.
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

PidTerms* pid_terms(Settings& settings) {
  return part_of<PidTerms>(settings);
}

CalibratedSettings* calibrated(Settings& settings) {
  return part_of<CalibratedSettings>(settings);
}

const CalibratedSettings* calibrated(const Settings& settings) {
  return part_of<const CalibratedSettings>(settings);
}

}  // namespace mckibben::controllers
