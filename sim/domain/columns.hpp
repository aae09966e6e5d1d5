// Where a measured file holds what we ask for, and in which units: the map `columns` of a data set, from our
// quantities to the file's columns.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mckibben::domain {

/// One quantity: where it stands and how its numbers are to be read.
struct ColumnPlace {
  std::string column;  ///< empty: not said
  std::string unit;
  double zero = 0.0, factor = 1.0;

  bool absent() const { return column.empty(); }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.required(
        "column", self.column,
        "heading in a .csv, channel (or number) in an .lvm, variable, run.field or data(:,2) in a .mat, "
        "number from 1 in a .txt");
    visit.required("unit", self.unit, "unit of its numbers; 1 for a ratio, count for encoder counts");
    visit("zero", self.zero, "1", -1e12, 1e12, "taken from each number, in that unit, first of all");
    visit("factor", self.factor, "1", -1e12, 1e12, "each is multiplied by it then: a gear, a sensor, a sign");
  }

  template <class Report>
  void rules(Report& report) const {
    if (factor == 0.0) report("factor", "it must not be 0");
    if (column.empty() && !unit.empty()) report("column", "it must not be empty");
  }
};

struct ColumnMap {
  ColumnPlace time, current, contraction, muscle_pressure;
  bool rows_are_ticks = false;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("time", self.time, "time since the first row");
    visit("current", self.current, "current to the valve");
    visit("contraction", self.contraction,
          "height of the load: ratio, angle of the wheel, travel of the rope, or encoder counts");
    visit("muscle_pressure", self.muscle_pressure, "gauge pressure in the muscle, where it was measured");
    visit("rows_are_ticks", self.rows_are_ticks, "the file holds no time: its rows are one tick apart");
  }

  template <class Report>
  void rules(Report& report) const {
    if (rows_are_ticks && !time.absent()) report("rows_are_ticks", "and yet a column of time is named");
    const std::pair<const char*, const ColumnPlace*> places[] = {{"time", &time},
                                                                 {"current", &current},
                                                                 {"contraction", &contraction},
                                                                 {"muscle_pressure", &muscle_pressure}};
    for (const auto& [key, place] : places)
      for (const auto* other = places; other->second != place; ++other)
        if (!place->absent() && place->column == other->second->column)
          report(key, std::string("it stands in the same column as ") + other->first);
  }
};

/// `own` where it says something, otherwise `shared`.
ColumnMap merged(const ColumnMap& shared, const ColumnMap& own);

}  // namespace mckibben::domain
