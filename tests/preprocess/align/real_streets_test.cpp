// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
// Streets of real cities, from footprints as the surveys and OpenStreetMap drew them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "align/align.hpp"
#include "georeference/georeference.hpp"
#include "tests/preprocess/align/extruded_town.hpp"
#include "tests/scenes/test_data.hpp"

namespace farlod::align {
namespace {

using Json = nlohmann::json;

/// Extrudes the outer ring of a GeoJSON polygon, whose last point is its first again.
void add_polygon(CityModel& city, const Json& polygon) {
  std::vector<Point2d> ring;
  for (const Json& p : polygon.at(0)) ring.push_back({p.at(0).get<double>(), p.at(1).get<double>()});
  ring.pop_back();
  if (ring.size() >= 3) add_extruded(city, ring, 10.0);
}

LocatedCity read_footprints(const std::filesystem::path& path) {
  SourceCity source;
  source.source = path.string();
  source.crs.definition = "OGC:CRS84";
  const Json file = Json::parse(std::ifstream(path));
  for (const Json& feature : file.at("features")) {
    const Json& geometry = feature.at("geometry");
    if (geometry.at("type") == "Polygon") add_polygon(source.city, geometry.at("coordinates"));
    if (geometry.at("type") == "MultiPolygon")
      for (const Json& polygon : geometry.at("coordinates")) add_polygon(source.city, polygon);
  }
  std::vector<SourceCity> sources;
  sources.push_back(std::move(source));
  Report report;
  return georeference::georeference(std::move(sources), {}, report);
}

TEST(RealStreets, ManhattanIsAtTwentyEightDegrees) {
  const auto path = scenes::test_data("manhattan/manhattan.geojson");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << scenes::absence_of(path);
  const LocatedCity located = read_footprints(path);
  EXPECT_EQ(located.georeference.epsg, 32618);
  const Alignment streets = street_alignment(located.city);
  // The Commissioners' Plan of 1811: 29° from true north, as published to the degree
  constexpr double published_to_deg = 0.5;
  EXPECT_NEAR(streets.bearing.degrees(), 28.3, published_to_deg);
  EXPECT_NEAR((streets.bearing + located.georeference.convergence).degrees(), 29.0, published_to_deg);
  RecordProperty("bearing_deg", std::to_string(streets.bearing.degrees()));
  RecordProperty("strength", std::to_string(streets.strength));
}

TEST(RealStreets, OmiyaIsWeakerThanManhattan) {
  const auto omiya = scenes::test_data("omiya/omiya.geojson"), manhattan = scenes::test_data("manhattan/manhattan.geojson");
  for (const auto& path : {omiya, manhattan})
    if (!std::filesystem::exists(path)) GTEST_SKIP() << scenes::absence_of(path);
  const LocatedCity located = read_footprints(omiya);
  EXPECT_EQ(located.georeference.epsg, 32654);
  EXPECT_LT(street_alignment(located.city).strength, street_alignment(read_footprints(manhattan).city).strength);
}

}  // namespace
}  // namespace farlod::align
