// Columns of text for a terminal; shared by the tables.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace mckibben::output {

/// A part of a text under its title; nothing where there is nothing to say.
inline std::string section(const std::string& title, const std::string& body) {
  return body.empty() ? "" : "\n" + title + "\n" + body;
}

/// A table whose columns are as wide as their widest cell;
/// the first column and texts to the left, numbers to the right.
class Grid {
 public:
  explicit Grid(std::vector<std::string> head, std::size_t text_columns)
      : text_columns_(text_columns), rows_{std::move(head)} {}

  bool empty() const { return rows_.size() == 1; }
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// What a line is of, and what is said of it.
  void add(std::vector<std::string> head, const std::vector<std::string>& cells) {
    head.insert(head.end(), cells.begin(), cells.end());
    add(std::move(head));
  }
  /// The same where there is nothing but a word.
  void add(std::vector<std::string> head, const std::string& word) {
    head.push_back(word);
    head.resize(rows_.front().size(), "-");
    add(std::move(head));
  }

  std::string text() const {
    std::vector<std::size_t> widths(rows_.front().size(), 0);
    for (const auto& row : rows_)
      for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string text;
    for (const auto& row : rows_) {
      std::string line = " ";
      for (std::size_t i = 0; i < row.size(); ++i)
        line += i < text_columns_ ? fmt::format(" {:<{}}", row[i], widths[i])
                                  : fmt::format("  {:>{}}", row[i], widths[i]);
      text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
  }

 private:
  std::size_t text_columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace mckibben::output
