// A table that import looks at, row by row.
#pragma once

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <sim/recognise/recognise.hpp>

#include "scratch.hpp"

namespace mckibben::recognise {

class Asked : public ::testing::Test {
 protected:
  /// Of a table of 200 rows: `row(k)` is a line.
  Recognised of(const std::string& head, const auto& row, const std::string& name = "5kg.csv",
                const KnownRig& rig = {}) const {
    std::string text = head;
    for (int k = 0; k < 200; ++k) text += row(k) + "\n";
    return recognise({folder_.write(name, text)}, true, rig);
  }
  static double drive(int k) { return 0.5 - 0.5 * std::cos(0.03 * k); }
  static const ColumnGuess& column(const Recognised& found, const char* key) {
    return *found.maps[0].find(key);
  }
  static std::string start(const Recognised& found) {
    for (const Setting& each : found.dataset)
      if (each.key == "start") return each.told.value;
    return "";
  }

  Scratch folder_;
};

}  // namespace mckibben::recognise
