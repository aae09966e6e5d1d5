// A CSV file of numbers, by its heading.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace mckibben {

using Table = std::map<std::string, std::vector<double>>;

inline std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

inline Table table_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> head = cells_of(line);
  Table table;
  while (std::getline(file, line)) {
    const auto cells = cells_of(line);
    for (std::size_t i = 0; i < head.size(); ++i) table[head[i]].push_back(std::stod(cells.at(i)));
  }
  return table;
}

}  // namespace mckibben
