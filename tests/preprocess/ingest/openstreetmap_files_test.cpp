// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <gmock/gmock.h>

#include <memory>

#include "ingest/footprints/feature_tags.hpp"
#include "reading.hpp"
#include "small_cities.hpp"

namespace farlod::ingest::test {
namespace {

using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// A square of 0.0001° × `edge` with its corner at (x, 48).
std::string block(double x, double edge = 1.0) {
  const auto corner = [&](double dx, double dy) {
    return "[" + std::to_string(11.0 + 1e-4 * (x + dx * edge)) + "," + std::to_string(48.0 + 1e-4 * dy * edge) + "]";
  };
  return "[[" + corner(0, 0) + "," + corner(1, 0) + "," + corner(1, 1) + "," + corner(0, 1) + "," + corner(0, 0) + "]]";
}

/// The ids of the buildings, each with the heights between which it lies.
std::vector<std::string> buildings_of(const Reading& r) {
  std::vector<std::string> found;
  for (const Building& b : r.city().buildings()) {
    double low = 1e9, high = -1e9;
    for (const Point3d& p : r.city().points_of(b)) {
      low = std::min(low, p.z);
      high = std::max(high, p.z);
    }
    std::ostringstream text;
    text << b.id << ": " << low << " to " << high;
    found.push_back(text.str());
  }
  return found;
}

Reading read_all(const std::vector<std::string>& features) { return read_text("a.geojson", collection(features)); }

TEST(OpenStreetMapFile, ClosedWaysThatArePartsAreAreas) {
  std::string nodes;
  const char* places[] = {"0.0000", "0.0001"};
  for (int n = 0; n < 4; ++n)
    nodes += "<node id=\"" + std::to_string(n + 1) + "\" lat=\"" + places[n / 2] + "\" lon=\"" +
             places[(n == 1 || n == 2) ? 1 : 0] + "\"/>";
  const auto way = [](int id, const std::string& tags) {
    return "<way id=\"" + std::to_string(id) + R"("><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="1"/>)" + tags +
           "</way>";
  };
  const Reading r =
      read_text("a.osm", R"(<?xml version="1.0"?><osm version="0.6">)" + nodes +
                             way(10, R"(<tag k="building" v="yes"/><tag k="height" v="60"/>)") +
                             way(11, R"(<tag k="building:part" v="yes"/><tag k="height" v="12"/>)") +
                             way(12, R"(<tag k="building:part" v="yes"/><tag k="height" v="60"/><tag k="min_height" v="12"/>)") +
                             way(13, R"(<tag k="landuse" v="grass"/>)") + "</osm>");
  EXPECT_THAT(buildings_of(r), UnorderedElementsAre("11: 0 to 12", "12: 12 to 60"));
  EXPECT_THAT(r.codes(), IsEmpty());
  EXPECT_EQ(r.source.skipped.at("outlines of buildings whose parts are there"), 1U);
  EXPECT_EQ(r.source.skipped.at("features whose tags make them no buildings"), 1U);
}

TEST(OpenStreetMapFile, TagsMayBeNestedInEachFeature) {
  const auto nested = [](int id, const std::string& tags, double x) {
    return feature(R"("type":"way","id":)" + std::to_string(id) + R"(,"tags":{)" + tags + "}", "Polygon", block(x));
  };
  const Reading r =
      read_all({nested(1, R"("landuse":"residential","building:levels":"1")", 0),
                nested(2, R"("building":"house","height":"7")", 1), nested(3, R"("building":"no","height":"9")", 2)});
  EXPECT_THAT(buildings_of(r), UnorderedElementsAre("2: 0 to 7"));
  EXPECT_THAT(r.codes(), IsEmpty());
  const Reading other = read_all({feature(R"("id":"a","height":4,"tags":"{\"use\":\"shed\"}")", "Polygon", block(0))});
  EXPECT_THAT(buildings_of(other), UnorderedElementsAre("a: 0 to 4")) << "tags of somebody else";
}

TEST(OpenStreetMapFile, PartsOfATowerCountOnceInThePlan) {
  std::vector<std::string> features{feature(R"("@id":"hall","building":"yes","height":"10")", "Polygon", block(0, 4))};
  for (int n = 0; n < 9; ++n)
    features.push_back(feature(R"("@id":"p)" + std::to_string(n) + R"(","building:part":"yes","height":")" +
                                   std::to_string(20 + 10 * n) + R"(","min_height":")" + std::to_string(10 + 10 * n) + "\"",
                               "Polygon", block(0.1, 1)));
  const Reading r = read_all(features);
  EXPECT_EQ(r.city().buildings().size(), 10U) << "nine parts above each other cover a sixteenth of the hall";
}

TEST(OpenStreetMapFile, ShapefilesCutTheNamesOfKeys) {
  GDALAllRegister();
  const auto geojson = write_file(
      "a.geojson",
      collection({feature(R"("osm_id":"1","building":"yes","building:levels":"4","roof:levels":"1","building:part":null)",
                          "Polygon", block(0)),
                  feature(R"("osm_id":"2","building":null,"building:levels":"2","roof:levels":null,"building:part":"yes")",
                          "Polygon", block(2)),
                  feature(R"("osm_id":"3","building":"no","building:levels":"9","roof:levels":null,"building:part":null)",
                          "Polygon", block(4))}));
  const std::filesystem::path file = geojson.parent_path() / "a.shp";
  GDALDatasetUniquePtr source(GDALDataset::Open(geojson.c_str(), GDAL_OF_VECTOR));
  GDALDatasetH handle = GDALDataset::ToHandle(source.get());
  GDALClose(GDALVectorTranslate(file.c_str(), nullptr, 1, &handle, nullptr, nullptr));
  EXPECT_THAT(buildings_of(read_file(file)), UnorderedElementsAre("1: 0 to 15", "2: 0 to 6"));
}

TEST(OpenStreetMapFile, ProgramsWriteWordsForNoValue) {
  std::vector<std::string> features{feature(R"("osm_id":"1","building":"yes","height":"12 Meter")", "Polygon", block(0))};
  for (const char* none : {"None", "nan", "NULL", ""})
    features.push_back(feature(R"("osm_id":"2","height":"9","building":")" + std::string(none) + "\"", "Polygon", block(2)));
  EXPECT_THAT(buildings_of(read_all(features)), UnorderedElementsAre("1: 0 to 12"));
}

TEST(OpenStreetMapFile, PartsThatBeginAboveTheirTopAreTold) {
  const Reading r = read_all(
      {feature(R"("osm_id":"1","building":"yes","height":"12","min_height":"12","building:min_level":null)", "Polygon", block(0)),
       feature(R"("osm_id":"2","building":"yes","height":"3")", "Polygon", block(2))});
  ASSERT_EQ(r.report.problems().size(), 1U);
  EXPECT_EQ(r.report.problems()[0].detail,
            "height is \"12\", and it begins only above that: min_height is \"12\", building:min_level is empty");
}

TEST(OpenStreetMapFile, ColumnsAreKnownByShorterNames) {
  for (const char* column : {"building:levels", "BUILDING_LEVELS", "building_l", "building:l"})
    EXPECT_TRUE(is_column_of(column, "building:levels")) << column;
  EXPECT_TRUE(is_column_of("is_undergr", "is_underground"));
  EXPECT_TRUE(is_column_of("measuredhe", "measuredheight"));
  for (const auto& [column, known] : {std::pair("building_m", "building:min_level"), std::pair("number_of_", "number_of_floors"),
                                      std::pair("building", "building:levels"), std::pair("build", "building")})
    EXPECT_FALSE(is_column_of(column, known)) << column;
}

TEST(Overture, PartsMayBeginAtAStorey) {
  const Reading r =
      read_all({feature(R"("id":"p","building_id":"a","height":20.0,"min_floor":2,"roof_shape":"flat","is_underground":false)",
                        "Polygon", block(0))});
  EXPECT_THAT(buildings_of(r), UnorderedElementsAre("p: 6 to 20"));
}

}  // namespace
}  // namespace farlod::ingest::test
