// One pass over one expression: its postfix pieces to postfix steps, with a stack of units beside.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plant/law.hpp>
#include <sim/law/compile.hpp>

namespace mckibben::law {

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

class Pass {
 public:
  Pass(const Wording& wording, std::string_view text, const Units& units, MemoryUnits& memories)
      : wording_(wording), text_(text), units_(units), memories_(memories) {}

  /// The value that is left; nothing if something is wrong.
  std::optional<Item> operator()(const std::vector<Piece>& pieces);
  /// Of the text, so much as a message can hold.
  std::string excerpt(const Item& item) const;
  void complain(std::size_t offset, std::string message, std::string unknown = {});

  plant::LawProgram program;
  std::vector<Problem> problems;
  bool knows_time = false;

 private:
  using Kind = Piece::Kind;
  using Operation = plant::LawOperation;

  void take(const Piece& piece);
  void push(Item item, plant::LawStep step);
  void push_constant(double value, const Dimension& dimension, std::size_t from, std::size_t to);
  void number(const Piece& piece);
  void name(const Piece& piece);
  void call(const Piece& piece);
  void greater(const Piece& piece);
  void power(const Piece& piece);
  void put_together(const Piece& piece, Operation operation, std::size_t count, bool swapped = false);
  void fold(const Piece& piece);
  bool alike(const Item& a, const Item& b);
  static Item::Unit unit_of_sum(const Item& a, const Item& b);
  void same(const Piece& piece, const Item& a, const Item& b, std::string_view what, Item& result);
  void check(const Piece& piece, Operation operation, const std::vector<Item>& items, Item& result);

  const Wording& wording_;
  std::string_view text_;
  const Units& units_;
  MemoryUnits& memories_;
  std::vector<Item> stack_;
  std::size_t unknown_ = 0;  ///< names, among the problems
};

}  // namespace mckibben::law
