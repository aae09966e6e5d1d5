// Postfix pieces to postfix steps, with a stack of units beside; see the header.
//
// The unit of a memory is not said. It is what the memory is added to, subtracted from or compared with;
// failing that, what its rate is times seconds. Passes over all expressions go on until no unit is found
// anew; the last one complains.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <sim/law/compile.hpp>

namespace mckibben::law {
namespace {

using Kind = Piece::Kind;
using Operation = plant::LawOperation;

struct Input {
  std::string_view name;
  plant::LawInput input;
  Dimension dimension;
};
constexpr std::array<Input, plant::law_inputs> inputs{{{"e", plant::LawInput::ratio, ratio},
                                                       {"x", plant::LawInput::rise, metre},
                                                       {"v", plant::LawInput::speed, metre_per_second},
                                                       {"P", plant::LawInput::pressure, pascal},
                                                       {"P_valve", plant::LawInput::valve_pressure, pascal},
                                                       {"load", plant::LawInput::load, newton},
                                                       {"command", plant::LawInput::command, pascal},
                                                       {"t", plant::LawInput::time, second}}};

struct Function {
  std::string_view name;
  std::size_t arguments;
  Operation operation;
};
constexpr std::array<Function, 10> functions{{{"min", 2, Operation::minimum},
                                              {"max", 2, Operation::maximum},
                                              {"abs", 1, Operation::absolute},
                                              {"tanh", 1, Operation::tanh},
                                              {"exp", 1, Operation::exp},
                                              {"log", 1, Operation::log},
                                              {"sqrt", 1, Operation::sqrt},
                                              {"sin", 1, Operation::sin},
                                              {"cos", 1, Operation::cos},
                                              {"if", 3, Operation::choose}}};
constexpr std::string_view pi = "pi";

/// What a memory's unit is, as far as it is known.
using MemoryUnits = std::vector<std::optional<Dimension>>;

/// A value on the stack.
struct Item {
  enum class Unit { known, any, open };  ///< any: a zero; open: of a memory whose unit is not found yet
  Unit unit = Unit::known;
  Dimension dimension{};
  std::optional<double> constant{};
  std::optional<std::size_t> memory{};  ///< it is this memory itself, whose unit is open
  bool truth = false;                   ///< of a comparison
  std::size_t begin = 0;                ///< its first step in the program
  std::size_t from = 0, to = 0;         ///< bytes of the text
};

/// A text of the law in a message: of a long one its beginning.
std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  if (text.size() <= longest) return std::string(text);
  std::size_t end = longest;
  while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // not inside a character
  return std::string(text.substr(0, end)) + "...";
}

/// One pass over one expression.
class Pass {
 public:
  Pass(const Wording& wording, std::string_view text, const Units& units, MemoryUnits& memories)
      : wording_(wording), text_(text), units_(units), memories_(memories) {}

  /// The value that is left; nothing if something is wrong.
  std::optional<Item> operator()(const std::vector<Piece>& pieces) {
    for (const Piece& piece : pieces) {
      take(piece);
      if (problems.size() > unknown_) return std::nullopt;
      if (stack_.size() > plant::deepest_law_stack) {
        complain(piece.offset,
                 fmt::format("more than {} values wait for their operators: write it with fewer "
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
  /// Of the text, so much as a message can hold.
  std::string excerpt(const Item& item) const { return shown(text_.substr(item.from, item.to - item.from)); }
  void complain(std::size_t offset, std::string message, std::string unknown = {}) {
    problems.push_back({offset, std::move(message), std::move(unknown)});
  }

  plant::LawProgram program;
  std::vector<Problem> problems;
  bool knows_time = false;

 private:
  void take(const Piece& piece) {
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

  void push(Item item, plant::LawStep step) {
    item.begin = program.size();
    program.push_back(step);
    stack_.push_back(item);
  }
  void push_constant(double value, const Dimension& dimension, std::size_t from, std::size_t to) {
    push({.unit = value == 0.0 ? Item::Unit::any : Item::Unit::known,
          .dimension = dimension,
          .constant = value,
          .from = from,
          .to = to},
         {Operation::constant, 0, value});
  }

  void number(const Piece& piece) {
    double value = 0.0;
    const auto [end, error] =
        std::from_chars(piece.text.data(), piece.text.data() + piece.text.size(), value);
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

  void name(const Piece& piece) {
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

  void call(const Piece& piece) {
    const auto found =
        std::ranges::find_if(functions, [&](const Function& one) { return one.name == piece.text; });
    if (found == functions.end())
      return complain(piece.offset, fmt::format("unknown function {}", shown(piece.text)), piece.text);
    if (found->arguments != piece.arguments)
      return complain(piece.offset,
                      fmt::format("{} takes {} argument{}, not {}", piece.text, found->arguments,
                                  found->arguments == 1 ? "" : "s", piece.arguments));
    put_together(piece, found->operation, found->arguments);
  }

  void greater(const Piece& piece) {  // b < a, of what stands in the other order: the steps change places
    const Item &left = stack_[stack_.size() - 2], &right = stack_.back();
    const auto begin = program.begin() + static_cast<std::ptrdiff_t>(left.begin);
    std::rotate(begin, program.begin() + static_cast<std::ptrdiff_t>(right.begin), program.end());
    put_together(piece, piece.kind == Kind::greater ? Operation::less : Operation::less_equal, 2, true);
  }

  // A constant exponent is part of the step.
  void power(const Piece& piece) {
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

  void put_together(const Piece& piece, Operation operation, std::size_t count, bool swapped = false) {
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
  void fold(const Piece& piece) {
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

  /// Both measure the same; a zero measures anything, and an open memory what the other does.
  bool alike(const Item& a, const Item& b) {
    if (a.unit == Item::Unit::known && b.unit == Item::Unit::known) return a.dimension == b.dimension;
    if (a.memory && b.unit == Item::Unit::known) memories_[*a.memory] = b.dimension;
    if (b.memory && a.unit == Item::Unit::known) memories_[*b.memory] = a.dimension;
    return true;
  }
  static Item::Unit unit_of_sum(const Item& a, const Item& b) {
    if (a.unit == Item::Unit::known || b.unit == Item::Unit::known) return Item::Unit::known;
    return a.unit == Item::Unit::open ? a.unit : b.unit;
  }
  void same(const Piece& piece, const Item& a, const Item& b, std::string_view what, Item& result) {
    if (!alike(a, b))
      return complain(piece.offset, fmt::format("{} is in {} and {} in {}: they cannot be {}", excerpt(a),
                                                a.dimension.unit(), excerpt(b), b.dimension.unit(), what));
    result.unit = unit_of_sum(a, b);
    result.dimension = a.unit == Item::Unit::known ? a.dimension : b.dimension;
  }

  void check(const Piece& piece, Operation operation, const std::vector<Item>& items, Item& result) {
    const std::size_t values = operation == Operation::choose ? 1 : 0;
    if (operation == Operation::choose && !items[0].truth)
      return complain(items[0].from, "the first argument of if must be a comparison, as in v > 0");
    for (std::size_t i = values; i < items.size(); ++i)
      if (items[i].truth)
        return complain(items[i].from, "a comparison is no value: it belongs first in if(...)");
    const auto times = [&](double sign) {
      const Item &a = items[0], &b = items[1];
      result.dimension = a.dimension.times(b.dimension, sign);
      result.unit = a.unit == Item::Unit::any || (sign > 0.0 && b.unit == Item::Unit::any) ? Item::Unit::any
                    : a.unit == Item::Unit::open || b.unit == Item::Unit::open             ? Item::Unit::open
                                                                               : Item::Unit::known;
    };
    switch (operation) {
      case Operation::add:
      case Operation::subtract:
        return same(piece, items[0], items[1], operation == Operation::add ? "added" : "subtracted", result);
      case Operation::minimum:
      case Operation::maximum:
        return same(piece, items[0], items[1], "compared", result);
      case Operation::less:
      case Operation::less_equal:
        same(piece, items[0], items[1], "compared", result);
        result.truth = true;
        return;
      case Operation::choose:
        result.truth = false;
        return same(piece, items[1], items[2], "chosen between", result);
      case Operation::multiply:
        return times(1.0);
      case Operation::divide:
        return times(-1.0);
      case Operation::sqrt:
        result.dimension = items[0].dimension.to_the(0.5);
        return;
      case Operation::tanh:
      case Operation::exp:
      case Operation::log:
      case Operation::sin:
      case Operation::cos:
        if (items[0].unit == Item::Unit::known && !items[0].dimension.is_ratio())
          return complain(items[0].from,
                          fmt::format("{} is in {}; {} wants a number without a unit", excerpt(items[0]),
                                      items[0].dimension.unit(), piece.text));
        result.dimension = ratio;
        result.unit = Item::Unit::known;
        return;
      default:
        return;  // the unit stays
    }
  }

  const Wording& wording_;
  std::string_view text_;
  const Units& units_;
  MemoryUnits& memories_;
  std::vector<Item> stack_;
  std::size_t unknown_ = 0;  ///< names, among the problems
};

/// All expressions, the law first.
class Compiler {
 public:
  Compiler(const Wording& wording, const Units& units, std::vector<Fault>& faults)
      : wording_(wording), units_(units), faults_(faults), memories_(wording.memories.size()) {}

  std::optional<Programs> operator()() {
    parse(wording_.law, std::nullopt);
    for (std::size_t i = 0; i < wording_.memories.size(); ++i) parse(wording_.memories[i].rate, i);
    if (!faults_.empty()) return std::nullopt;
    find_units();
    Programs programs;
    one(0, wording_.law, std::nullopt, dimension_of(wording_.adds),
        fmt::format("adds: {} wants", spelling(wording_.adds)), programs.law, programs.knows_time);
    for (std::size_t i = 0; i < wording_.memories.size(); ++i) {
      const auto& memory = wording_.memories[i];
      auto& into = programs.memories.emplace_back();
      if (!memories_[i]) {
        faults_.push_back({{0, fmt::format("what {} measures cannot be told: add it to something, or compare "
                                           "it with something, whose unit is known",
                                           memory.name)},
                           i});
        continue;
      }
      into.dimension = *memories_[i];
      one(i + 1, memory.rate, i, memories_[i]->times(second, -1.0),
          fmt::format("{} is in {}, so that its rate is", memory.name, memories_[i]->unit()), into.rate,
          programs.knows_time);
    }
    if (!faults_.empty()) return std::nullopt;
    return programs;
  }

 private:
  static std::string_view spelling(plant::LawTarget target) {
    for (const auto& [known, text] : names(target))
      if (known == target) return text;
    return {};
  }
  void parse(std::string_view text, std::optional<std::size_t> memory) {
    std::vector<Problem> problems;
    pieces_.push_back(law::parse(text, problems));
    for (Problem& problem : problems) faults_.push_back({std::move(problem), memory});
  }
  void find_units() {
    std::size_t known = 0, before = 0;
    do {
      before = known;
      Pass(wording_, wording_.law, units_, memories_)(pieces_[0]);
      for (std::size_t i = 0; i < wording_.memories.size(); ++i) {
        Pass pass(wording_, wording_.memories[i].rate, units_, memories_);
        const auto rate = pass(pieces_[i + 1]);
        if (rate && !memories_[i] && rate->unit == Item::Unit::known)
          memories_[i] = rate->dimension.times(second);
      }
      known = static_cast<std::size_t>(
          std::ranges::count_if(memories_, [](const auto& m) { return m.has_value(); }));
    } while (known > before);
  }
  void one(std::size_t index, const std::string& text, std::optional<std::size_t> memory,
           const Dimension& wanted, const std::string& who, plant::LawProgram& program, bool& knows_time) {
    Pass pass(wording_, text, units_, memories_);
    const auto result = pass(pieces_[index]);
    if (result && result->unit == Item::Unit::known && !(result->dimension == wanted))
      pass.complain(result->from, fmt::format("{} is in {}; {} {}", pass.excerpt(*result),
                                              result->dimension.unit(), who, wanted.unit()));
    for (Problem& problem : pass.problems) faults_.push_back({std::move(problem), memory});
    program = std::move(pass.program);
    knows_time = knows_time || pass.knows_time;
  }

  const Wording& wording_;
  const Units& units_;
  std::vector<Fault>& faults_;
  MemoryUnits memories_;
  std::vector<std::vector<Piece>> pieces_;
};

}  // namespace

Dimension dimension_of(plant::LawTarget target) {
  switch (target) {
    case plant::LawTarget::force:
      return newton;
    case plant::LawTarget::friction_factor:
      return ratio;
    case plant::LawTarget::outflow:
      return kilogram_per_second;
    case plant::LawTarget::command:
      return pascal;
    case plant::LawTarget::reading:
      return metre;
  }
  return ratio;
}

std::span<const std::string_view> reserved_names() {
  static const auto list = [] {
    std::array<std::string_view, inputs.size() + functions.size() + 1> names;
    auto next = names.begin();
    for (const Input& one : inputs) *next++ = one.name;
    for (const Function& one : functions) *next++ = one.name;
    *next = pi;
    return names;
  }();
  return list;
}

std::vector<std::string> known_names(const Wording& wording) {
  std::vector<std::string> list;
  for (const auto& parameter : wording.parameters) list.push_back(parameter.name);
  for (const auto& memory : wording.memories) list.push_back(memory.name);
  for (const std::string_view name : reserved_names()) list.emplace_back(name);
  return list;
}

std::optional<Programs> compile(const Wording& wording, const Units& units, std::vector<Fault>& faults) {
  return Compiler(wording, units, faults)();
}

}  // namespace mckibben::law
