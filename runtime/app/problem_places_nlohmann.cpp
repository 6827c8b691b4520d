// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/problem_places.hpp"
#include "inputs/requested_points.hpp"

namespace farlod {

std::optional<std::vector<Point2d>> problem_places_in(const std::filesystem::path& file) {
  using Json = nlohmann::json;
  std::ifstream stream(file, std::ios::binary);
  char first = 0;
  if (!(stream >> first) || first != '[') return std::nullopt;
  stream.seekg(0);
  std::vector<Point2d> places;
  try {
    for (const Json& problem : Json::parse(stream)) {
      // A report of an earlier version has none of them
      const Json& lon_lat = problem.at("lon_lat");
      if (!lon_lat.is_null()) places.push_back({lon_lat.at(0).get<double>(), lon_lat.at(1).get<double>()});
    }
  } catch (const Json::exception&) {
    throw PointsError(file.string() +
                      " is JSON, but no report that says where problems are: have farlod-pack write it, by --report.");
  }
  return places;
}

}  // namespace farlod
