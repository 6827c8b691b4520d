// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "ingest/trees/tree_reader.hpp"
#include "reading.hpp"

namespace farlod::ingest::test {

/// Sizes are kept as floats: half a step at 130 m.
inline constexpr double float_error_m = 1e-5;

struct TreeReading {
  SourceTrees source;
  Report report;

  [[nodiscard]] std::vector<Tree> trees() const { return {source.trees.begin(), source.trees.end()}; }
  [[nodiscard]] std::set<int> codes() const {
    std::set<int> codes;
    for (const Problem& problem : report.problems()) codes.insert(static_cast<int>(problem.code));
    return codes;
  }
  [[nodiscard]] std::string detail_of(ProblemCode code) const {
    for (const Problem& problem : report.problems())
      if (problem.code == code) return problem.detail;
    return "";
  }
};

inline TreeReading read_inventory(const std::filesystem::path& file, const TreeSettings& settings = {}) {
  TreeReading reading;
  reading.source = read_trees(file, settings, reading.report);
  return reading;
}
inline TreeReading read_inventory(const std::string& name, const std::string& text, const TreeSettings& settings = {}) {
  return read_inventory(write_file(name, text), settings);
}

inline constexpr const char* citygml_head = R"(<CityModel xmlns="http://www.opengis.net/citygml/2.0"
  xmlns:veg="http://www.opengis.net/citygml/vegetation/2.0" xmlns:gml="http://www.opengis.net/gml"><gml:boundedBy>
  <gml:Envelope srsName="EPSG:25833"/></gml:boundedBy>)";

inline std::string citygml(const std::string& trees) {
  std::string text = citygml_head;
  return text + "<cityObjectMember>" + trees + "</cityObjectMember></CityModel>";
}
inline std::string citygml_tree(const std::string& inside) {
  return "<veg:SolitaryVegetationObject>" + inside + "</veg:SolitaryVegetationObject>";
}

}  // namespace farlod::ingest::test
