// What operands may measure, each operation's, and what comes of them; comparisons in their place.
#include <fmt/format.h>

#include <sim/law/pass.hpp>

namespace mckibben::law {

/// Both measure the same; a zero measures anything, and an open memory what the other does.
bool Pass::alike(const Item& a, const Item& b) {
  if (a.unit == Item::Unit::known && b.unit == Item::Unit::known) return a.dimension == b.dimension;
  if (a.memory && b.unit == Item::Unit::known) memories_[*a.memory] = b.dimension;
  if (b.memory && a.unit == Item::Unit::known) memories_[*b.memory] = a.dimension;
  return true;
}

Item::Unit Pass::unit_of_sum(const Item& a, const Item& b) {
  if (a.unit == Item::Unit::known || b.unit == Item::Unit::known) return Item::Unit::known;
  return a.unit == Item::Unit::open ? a.unit : b.unit;
}

void Pass::same(const Piece& piece, const Item& a, const Item& b, std::string_view what, Item& result) {
  if (!alike(a, b))
    return complain(piece.offset, fmt::format("{} is in {} and {} in {}: they cannot be {}", excerpt(a),
                                              a.dimension.unit(), excerpt(b), b.dimension.unit(), what));
  result.unit = unit_of_sum(a, b);
  result.dimension = a.unit == Item::Unit::known ? a.dimension : b.dimension;
}

void Pass::check(const Piece& piece, Operation operation, const std::vector<Item>& items, Item& result) {
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
        return complain(items[0].from, fmt::format("{} is in {}; {} wants a number without a unit",
                                                   excerpt(items[0]), items[0].dimension.unit(), piece.text));
      result.dimension = ratio;
      result.unit = Item::Unit::known;
      return;
    default:
      return;  // the unit stays
  }
}

}  // namespace mckibben::law
