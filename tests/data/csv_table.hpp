// Reading one of the tables of data/.
#pragma once

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

// Cells as they are printed, one map from column name to cell for each row. Of quoting no more than the tables read
// here need: none.
using Row = std::map<std::string, std::string>;

inline std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

inline std::vector<Row> read_table(const std::string& name) {
  std::ifstream in(CRUMBLE_SOURCE_DIR "/data/" + name);
  std::vector<std::string> heading;
  std::vector<Row> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    const auto row = cells(line);
    if (heading.empty()) {
      heading = row;
      continue;
    }
    for (std::size_t k = rows.size(), column = (rows.emplace_back(), 0); column < row.size(); ++column)
      rows[k][heading.at(column)] = row[column];
  }
  if (rows.empty()) throw std::runtime_error(name + ": no rows");
  return rows;
}

inline double number(const Row& row, const std::string& column) { return std::stod(row.at(column)); }

// One unit of the last printed digit: "5.30960" -> 1e-5, "2.26e-10" -> 1e-12.
inline double last_digit(const std::string& printed) {
  const auto exponent = printed.find_first_of("eE");
  const std::string mantissa = printed.substr(0, exponent);
  const auto point = mantissa.find('.');
  const double decimals = point == std::string::npos ? 0 : static_cast<double>(mantissa.size() - point - 1);
  const double power = exponent == std::string::npos ? 0 : std::stod(printed.substr(exponent + 1));
  return std::pow(10, power - decimals);
}
