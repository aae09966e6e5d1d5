// Maps of a data set and of its runs; see the header.
#include <sim/domain/columns.hpp>

namespace mckibben::domain {

ColumnMap merged(const ColumnMap& shared, const ColumnMap& own) {
  ColumnMap map = own;
  for (const Quantity& quantity : quantities)
    if (ColumnPlace& place = map.*quantity.place; place.absent()) place = shared.*quantity.place;
  if (own.rows_are_ticks) map.time = own.time;
  map.rows_are_ticks = own.rows_are_ticks || (shared.rows_are_ticks && own.time.absent());
  return map;
}

}  // namespace mckibben::domain
