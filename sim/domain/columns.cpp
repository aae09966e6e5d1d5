// Maps of a data set and of its runs; see the header.
#include <sim/domain/columns.hpp>

namespace mckibben::domain {

ColumnMap merged(const ColumnMap& shared, const ColumnMap& own) {
  ColumnMap map = own;
  const auto fill = [](ColumnPlace& place, const ColumnPlace& otherwise) {
    if (place.absent()) place = otherwise;
  };
  if (!own.rows_are_ticks) fill(map.time, shared.time);
  fill(map.current, shared.current);
  fill(map.contraction, shared.contraction);
  fill(map.muscle_pressure, shared.muscle_pressure);
  map.rows_are_ticks = own.rows_are_ticks || (shared.rows_are_ticks && own.time.absent());
  return map;
}

}  // namespace mckibben::domain
