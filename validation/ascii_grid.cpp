// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/ascii_grid.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

namespace farlod {
namespace {

using Head = std::map<std::string, double>;

std::string lower_case(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

Head read_head(std::istream& text) {
  Head head;
  while (text >> std::ws && std::isalpha(text.peek())) {
    std::string key;
    double value = 0.0;
    if (text >> key >> value) head[lower_case(key)] = value;
  }
  return head;
}

std::vector<std::optional<double>> read_values(std::istream& text, double nodata) {
  std::vector<std::optional<double>> values;
  for (double value = 0.0; text >> value;) values.push_back(value == nodata ? std::nullopt : std::optional(value));
  return values;
}

}  // namespace

AsciiGrid read_ascii_grid(const std::filesystem::path& file) {
  std::ifstream text(file);
  if (!text) throw std::runtime_error(file.string() + " cannot be read");
  Head head = read_head(text);
  for (const char* key : {"ncols", "nrows", "xllcorner", "yllcorner", "cellsize", "nodata_value"})
    if (!head.contains(key)) throw std::runtime_error(file.string() + ": its head has no " + key);
  AsciiGrid grid{static_cast<std::size_t>(head["ncols"]),
                 static_cast<std::size_t>(head["nrows"]),
                 head["cellsize"],
                 {head["xllcorner"], head["yllcorner"]},
                 read_values(text, head["nodata_value"])};
  if (grid.values.size() != grid.columns * grid.rows)
    throw std::runtime_error(file.string() + ": " + std::to_string(grid.values.size()) + " values, where its head says " +
                             std::to_string(grid.columns * grid.rows));
  return grid;
}

}  // namespace farlod
