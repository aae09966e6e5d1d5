// The names that every law knows: inputs, functions, pi.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include <plant/law.hpp>
#include <sim/law/dimension.hpp>

namespace mckibben::law {

struct Input {
  std::string_view name;
  plant::LawInput input;
  Dimension dimension;
};
inline constexpr std::array<Input, plant::law_inputs> inputs{
    {{"e", plant::LawInput::ratio, ratio},
     {"x", plant::LawInput::rise, metre},
     {"v", plant::LawInput::speed, metre_per_second},
     {"P", plant::LawInput::pressure, pascal},
     {"P_valve", plant::LawInput::valve_pressure, pascal},
     {"F_braid", plant::LawInput::braid_force, newton},
     {"load", plant::LawInput::load, newton},
     {"command", plant::LawInput::command, pascal},
     {"t", plant::LawInput::time, second}}};

struct Function {
  std::string_view name;
  std::size_t arguments;
  plant::LawOperation operation;
};
inline constexpr std::array<Function, 10> functions{{{"min", 2, plant::LawOperation::minimum},
                                                     {"max", 2, plant::LawOperation::maximum},
                                                     {"abs", 1, plant::LawOperation::absolute},
                                                     {"tanh", 1, plant::LawOperation::tanh},
                                                     {"exp", 1, plant::LawOperation::exp},
                                                     {"log", 1, plant::LawOperation::log},
                                                     {"sqrt", 1, plant::LawOperation::sqrt},
                                                     {"sin", 1, plant::LawOperation::sin},
                                                     {"cos", 1, plant::LawOperation::cos},
                                                     {"if", 3, plant::LawOperation::choose}}};
inline constexpr std::string_view pi = "pi";

/// All of them: names that parameters and memories cannot have.
std::span<const std::string_view> reserved_names();

}  // namespace mckibben::law
