// Step by step; see the header. What operands may be: unit_check.cpp.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include <sim/law/names.hpp>
#include <sim/law/pass.hpp>

namespace mckibben::law {
namespace {

/// A text of the law in a message: of a long one its beginning.
std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  if (text.size() <= longest) return std::string(text);
  std::size_t end = longest;
  while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // not inside a character
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace

std::optional<Item> Pass::operator()(const std::vector<Piece>& pieces) {
  for (const Piece& piece : pieces) {
    take(piece);
    if (problems.size() > unknown_) return std::nullopt;
    if (stack_.size() > plant::deepest_law_stack) {
      complain(piece.offset, fmt::format("more than {} values wait for their operators: write it with fewer "
                                         "brackets",
                                         plant::deepest_law_stack));
      return std::nullopt;
    }
  }
  if (unknown_ > 0) return std::nullopt;
  if (program.size() > plant::most_law_steps) {
    complain(0, fmt::format("{} operations; a law has at most {}", program.size(), plant::most_law_steps));
    return std::nullopt;
  }
  if (stack_.back().truth) {
    complain(stack_.back().from, "a comparison is no value: use it in if(a < b, then, else)");
    return std::nullopt;
  }
  return stack_.back();
}

std::string Pass::excerpt(const Item& item) const {
  return shown(text_.substr(item.from, item.to - item.from));
}

void Pass::complain(std::size_t offset, std::string message, std::string unknown) {
  problems.push_back({offset, std::move(message), std::move(unknown)});
}

void Pass::take(const Piece& piece) {
  switch (piece.kind) {
    case Kind::number:
      return number(piece);
    case Kind::name:
      return name(piece);
    case Kind::call:
      return call(piece);
    case Kind::group:
      stack_.back().from = piece.offset;
      stack_.back().to = piece.end;
      return;
    case Kind::negate:
      return put_together(piece, Operation::negate, 1);
    case Kind::add:
      return put_together(piece, Operation::add, 2);
    case Kind::subtract:
      return put_together(piece, Operation::subtract, 2);
    case Kind::multiply:
      return put_together(piece, Operation::multiply, 2);
    case Kind::divide:
      return put_together(piece, Operation::divide, 2);
    case Kind::power:
      return power(piece);
    case Kind::less:
      return put_together(piece, Operation::less, 2);
    case Kind::less_equal:
      return put_together(piece, Operation::less_equal, 2);
    case Kind::greater:  // a > b is not (a <= b), but for what is no number
    case Kind::greater_equal:
      return greater(piece);
  }
}

void Pass::push(Item item, plant::LawStep step) {
  item.begin = program.size();
  program.push_back(step);
  stack_.push_back(item);
}

void Pass::push_constant(double value, const Dimension& dimension, std::size_t from, std::size_t to) {
  push({.unit = value == 0.0 ? Item::Unit::any : Item::Unit::known,
        .dimension = dimension,
        .constant = value,
        .from = from,
        .to = to},
       {Operation::constant, 0, value});
}

void Pass::number(const Piece& piece) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(piece.text.data(), piece.text.data() + piece.text.size(), value);
  if (error != std::errc{})
    return complain(piece.offset, fmt::format("{} is out of range", shown(piece.text)));
  UnitSize unit;
  if (!piece.unit.empty()) {
    const auto found = units_(piece.unit);
    if (!found) return complain(piece.offset, fmt::format("{} is not a unit", shown(piece.unit)));
    unit = *found;
  }
  value *= unit.size;
  if (!std::isfinite(value))
    return complain(piece.offset, fmt::format("{} is out of range", shown(piece.text)));
  std::size_t to = piece.offset + piece.text.size();
  if (!piece.unit.empty()) to = text_.find(']', to) + 1;
  push_constant(value, unit.dimension, piece.offset, to);
}

void Pass::name(const Piece& piece) {
  const std::size_t from = piece.offset, to = from + piece.text.size();
  for (const Input& one : inputs) {
    if (one.name != piece.text) continue;
    knows_time = knows_time || one.input == plant::LawInput::time;
    return push({.dimension = one.dimension, .from = from, .to = to},
                {Operation::input, static_cast<std::uint8_t>(one.input)});
  }
  if (piece.text == pi) return push_constant(std::numbers::pi, ratio, from, to);
  for (std::size_t i = 0; i < wording_.parameters.size(); ++i)
    if (wording_.parameters[i].name == piece.text)
      return push({.dimension = wording_.parameters[i].dimension, .from = from, .to = to},
                  {Operation::parameter, static_cast<std::uint8_t>(i)});
  for (std::size_t i = 0; i < wording_.memories.size(); ++i) {
    if (wording_.memories[i].name != piece.text) continue;
    Item item{.from = from, .to = to};
    if (memories_[i]) {
      item.dimension = *memories_[i];
    } else {
      item.unit = Item::Unit::open;
      item.memory = i;
    }
    return push(item, {Operation::memory, static_cast<std::uint8_t>(i)});
  }
  const bool is_function =
      std::ranges::any_of(functions, [&](const Function& one) { return one.name == piece.text; });
  if (is_function) return complain(from, fmt::format("{} is a function: {}(...)", piece.text, piece.text));
  complain(from, fmt::format("unknown name {}", shown(piece.text)), piece.text);
  ++unknown_;  // and on, to tell of all of them
  push({.unit = Item::Unit::open, .from = from, .to = to}, {Operation::constant});
}

void Pass::call(const Piece& piece) {
  const auto found =
      std::ranges::find_if(functions, [&](const Function& one) { return one.name == piece.text; });
  if (found == functions.end())
    return complain(piece.offset, fmt::format("unknown function {}", shown(piece.text)), piece.text);
  if (found->arguments != piece.arguments)
    return complain(piece.offset, fmt::format("{} takes {} argument{}, not {}", piece.text, found->arguments,
                                              found->arguments == 1 ? "" : "s", piece.arguments));
  put_together(piece, found->operation, found->arguments);
}

void Pass::greater(const Piece& piece) {  // b < a, of what stands in the other order: the steps change places
  const Item &left = stack_[stack_.size() - 2], &right = stack_.back();
  const auto begin = program.begin() + static_cast<std::ptrdiff_t>(left.begin);
  std::rotate(begin, program.begin() + static_cast<std::ptrdiff_t>(right.begin), program.end());
  put_together(piece, piece.kind == Kind::greater ? Operation::less : Operation::less_equal, 2, true);
}

// A constant exponent is part of the step.
void Pass::power(const Piece& piece) {
  const Item exponent = stack_.back();
  Item& base = stack_[stack_.size() - 2];
  if (base.truth || exponent.truth) return complain(piece.offset, "a comparison is no value");
  const bool is_parameter =
      exponent.begin + 1 == program.size() && program.back().operation == Operation::parameter;
  if (!exponent.constant && !is_parameter)
    return complain(exponent.from,
                    fmt::format("the exponent {} is neither a number nor a parameter", excerpt(exponent)));
  if (exponent.unit == Item::Unit::known && !exponent.dimension.is_ratio())
    return complain(exponent.from, fmt::format("the exponent {} is in {}; an exponent has no unit",
                                               excerpt(exponent), exponent.dimension.unit()));
  if (is_parameter && base.unit == Item::Unit::known && !base.dimension.is_ratio())
    return complain(base.from, fmt::format("{} is in {}: to a power that may change it must have no unit",
                                           excerpt(base), base.dimension.unit()));
  const plant::LawStep step = is_parameter
                                  ? plant::LawStep{Operation::power_of_parameter, program.back().index}
                                  : plant::LawStep{Operation::power, 0, *exponent.constant};
  program.resize(exponent.begin);
  base.to = exponent.to;
  base.memory.reset();
  base.dimension = is_parameter ? ratio : base.dimension.to_the(*exponent.constant);
  program.push_back(step);
  stack_.pop_back();
  if (stack_.back().constant && exponent.constant) fold(piece);
}

void Pass::put_together(const Piece& piece, Operation operation, std::size_t count, bool swapped) {
  const std::size_t first = stack_.size() - count;
  const std::vector<Item> items(stack_.begin() + static_cast<std::ptrdiff_t>(first), stack_.end());
  Item result = items.front();
  result.memory.reset();
  result.from = piece.kind == Kind::call || piece.kind == Kind::negate ? piece.offset : items.front().from;
  result.to = piece.kind == Kind::call ? piece.end : items.back().to;
  if (swapped) result.begin = std::min(items[0].begin, items[1].begin);
  check(piece, operation, items, result);
  if (problems.size() > unknown_) return;
  const bool constant =
      std::ranges::all_of(items, [](const Item& item) { return item.constant.has_value(); });
  if (operation == Operation::divide && items[1].constant && *items[1].constant == 0.0)
    return complain(piece.offset, fmt::format("division by {}, which is zero", excerpt(items[1])));
  program.push_back({operation});
  if (!constant) result.constant.reset();
  stack_.resize(first);
  stack_.push_back(result);
  if (constant && !result.truth) fold(piece);
}

/// What is constant is calculated now.
void Pass::fold(const Piece& piece) {
  Item item = stack_.back();
  const plant::LawProgram part(program.begin() + static_cast<std::ptrdiff_t>(item.begin), program.end());
  const std::array<double, plant::most_law_parameters> none{};
  const double value = plant::value_of(part, plant::LawNumbers<double, double>{{}, none, {}});
  if (!std::isfinite(value))
    return complain(piece.offset, fmt::format("{} is not a finite number", excerpt(item)));
  program.resize(item.begin);
  program.push_back({Operation::constant, 0, value});
  item.constant = value;
  stack_.back() = item;
}

}  // namespace mckibben::law
