// The table of controllers of a pair: an entry here and its header make one known to scenarios of pairs.
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <type_traits>
#include <variant>

#include <controllers/pair_model_inverse.hpp>
#include <controllers/pair_pid.hpp>

namespace mckibben::controllers {

using PairSettings =
    std::variant<PairPidSettings, PairModelInverseSettings, PairModelInverseFeedbackSettings>;

/// A controller at its beginning. Throws std::invalid_argument if the settings are incomplete.
inline std::unique_ptr<Controller> make(const PairSettings& settings, const Knowledge& knowledge) {
  return std::visit([&](const auto& one) { return one.make(knowledge); }, settings);
}

/// The name it goes by in tables and files.
inline const std::string& name_of(const PairSettings& settings) {
  return std::visit([](const auto& one) -> const std::string& { return one.name; }, settings);
}

/// What a controller that plans with a model says about it, else null.
template <class Settings>
requires std::same_as<std::remove_const_t<Settings>, PairSettings>
auto* model_terms(Settings& settings) {
  using Terms = std::conditional_t<std::is_const_v<Settings>, const PairModelTerms, PairModelTerms>;
  return std::visit(
      [](auto& one) -> Terms* {
        if constexpr (std::derived_from<std::remove_cvref_t<decltype(one)>, PairModelTerms>)
          return &one;
        else
          return nullptr;
      },
      settings);
}

}  // namespace mckibben::controllers
