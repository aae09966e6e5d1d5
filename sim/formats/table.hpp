// One run as a table with units: what the writers of all formats are given.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mckibben::formats {

/// One column: a number for each row.
struct Column {
  std::string name;     ///< as a heading and a variable: letters, digits and _
  std::string unit;     ///< as UDUNITS-2 spells it; "1" for a ratio
  std::string meaning;  ///< in words
  std::vector<double> values;
};

/// What is true of the whole table: "load_kg" and 11.138.
using Attribute = std::pair<std::string, std::variant<std::string, double>>;

struct Table {
  std::string title;
  std::vector<Column> columns;  ///< all of one length; the first is time
  std::vector<Attribute> attributes;
};

/// A file that is not what it should be, or a library that cannot make one; `what()` says why.
class BadFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mckibben::formats
