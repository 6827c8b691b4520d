// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <map>

#include "city/city_model.hpp"
#include "farlod/error.hpp"
#include "ingest/footprints/feature_tags.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::ingest::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

/// A square whose lower left corner is at (x, y), in units of 1e-5°.
std::string square_at(double x, double y, double edge = 10.0) {
  const auto corner = [&](double dx, double dy) {
    return "[" + std::to_string(1e-5 * (x + dx)) + "," + std::to_string(1e-5 * (y + dy)) + "]";
  };
  return "[[" + corner(0, 0) + "," + corner(edge, 0) + "," + corner(edge, edge) + "," + corner(0, edge) + "," + corner(0, 0) +
         "]]";
}

/// A feature of OpenStreetMap as Overpass writes it.
std::string way(const std::string& id, const std::string& tags, double x = 0.0, double edge = 10.0) {
  return feature(R"("@id":"way/)" + id + R"(",)" + tags, "Polygon", square_at(x, 0.0, edge));
}

Reading read_tagged(const std::vector<std::string>& features, const IngestSettings& settings = {}) {
  return read_text("a.geojson", collection(features), settings);
}

/// Lowest and highest point of each building, by id.
std::map<std::string, std::pair<double, double>> extents(const Reading& r) {
  std::map<std::string, std::pair<double, double>> found;
  for (const Building& b : r.city().buildings()) {
    auto& [low, high] = found.try_emplace(b.id, 1e9, -1e9).first->second;
    for (const Point3d& p : r.city().points_of(b)) {
      low = std::min(low, p.z);
      high = std::max(high, p.z);
    }
  }
  return found;
}

IngestSettings with_default(double height_m) {
  IngestSettings settings;
  settings.footprints.default_height_m = height_m;
  return settings;
}

TEST(OpenStreetMap, BuildingsAreReadAndNothingElse) {
  const Reading r =
      read_tagged({way("1", R"("building":"yes","height":"12")"), way("2", R"("landuse":"residential")"),
                   way("3", R"("natural":"water")"), way("4", R"("building":"no","height":"9")"),
                   way("5", R"("demolished:building":"yes","height":"9")"), way("6", R"("building":"demolished","height":"9")"),
                   way("7", R"("building":"garage","height":"3","location":"underground")"),
                   way("8", R"("building":"train_station","height":"8","layer":"-1")"),
                   way("9", R"("building":"roof","building:levels":"2")")},
                  with_default(5.0));
  EXPECT_THAT(extents(r), ElementsAre(Pair("way/1", Pair(0.0, 12.0)), Pair("way/9", Pair(0.0, 6.0))));
  EXPECT_THAT(r.source.skipped, ElementsAre(Pair("buildings below the ground", 2), Pair(HasSubstr("no buildings"), 5)));
  EXPECT_THAT(r.codes(), IsEmpty());
}

TEST(OpenStreetMap, TagsInOneColumnAreFieldsToo) {
  const std::string osm = R"("osm_id":"17","building":"yes","other_tags":)";
  const Reading r = read_tagged(
      {feature(osm + R"("\"height\"=>\"21 m\",\"name\"=>\"A\"")", "Polygon", square_at(0, 0)),
       feature(R"("osm_id":"18","building":"yes","other_tags":"\"building:levels\"=>\"3\",\"roof:levels\"=>\"1\"")", "Polygon",
               square_at(20, 0)),
       feature(
           R"("osm_id":"19","building":null,"other_tags":"\"building:part\"=>\"yes\",\"height\"=>\"9\",\"min_height\"=>\"4\"")",
           "Polygon", square_at(40, 0)),
       feature(R"("osm_id":"20","building":null,"other_tags":"\"landuse\"=>\"grass\"")", "Polygon", square_at(60, 0))});
  EXPECT_THAT(extents(r), ElementsAre(Pair("17", Pair(0.0, 21.0)), Pair("18", Pair(0.0, 12.0)), Pair("19", Pair(4.0, 9.0))));
}

TEST(OpenStreetMap, PartsStandForTheirOutline) {
  const std::string outline = R"("building":"commercial","height":"60")";
  const Reading r =
      read_tagged({way("outline", outline), way("podium", R"("building:part":"yes","height":"12")"),
                   way("tower", R"("building:part":"yes","height":"60","min_height":"12")", 2.0, 4.0),
                   way("neighbor", outline, 100.0), way("mast", R"("building:part":"yes","height":"70")", 101.0, 1.0)});
  EXPECT_THAT(extents(r), ElementsAre(Pair("way/mast", Pair(0.0, 70.0)), Pair("way/neighbor", Pair(0.0, 60.0)),
                                      Pair("way/podium", Pair(0.0, 12.0)), Pair("way/tower", Pair(12.0, 60.0))))
      << "an outline that parts do not fill stays";
  EXPECT_THAT(r.source.skipped, ElementsAre(Pair("outlines of buildings whose parts are there", 1)));
  for (const Building& b : r.city().buildings()) EXPECT_EQ(b.foot, b.id == "way/tower" ? Foot::above_ground : Foot::on_ground);
}

TEST(Overture, BuildingsHavePartsAndSomeAreUnderground) {
  const auto overture = [](const std::string& properties, double x) { return feature(properties, "Polygon", square_at(x, 0.0)); };
  const Reading r = read_tagged({overture(R"("id":"a","height":30,"has_parts":true,"is_underground":false)", 0),
                                 overture(R"("id":"b","building_id":"a","is_underground":false,"height":8)", 0),
                                 overture(R"("id":"c","height":5,"has_parts":false,"is_underground":true)", 20),
                                 overture(R"("id":"d","num_floors":2,"has_parts":false,"is_underground":false)", 40)});
  EXPECT_THAT(extents(r), ElementsAre(Pair("b", Pair(0.0, 8.0)), Pair("d", Pair(0.0, 6.0))));
}

TEST(OpenStreetMap, TablesOfOthersMayHaveAFieldOfThatName) {
  const Reading r = read_tagged({feature(R"("building":"Town hall","height":5)", "Polygon", square_at(0, 0)),
                                 feature(R"("building":null,"height":6)", "Polygon", square_at(20, 0))});
  EXPECT_EQ(r.city().buildings().size(), 2u);
}

TEST(Overture, PartsInAnotherFileStandForTheirOutlines) {
  const auto write = [](const char* name, const std::vector<std::string>& features) {
    return write_file(name, collection(features));
  };
  const auto outlines =
      write("building.geojson", {feature(R"("id":"a","has_parts":true,"height":60)", "Polygon", square_at(0, 0)),
                                 feature(R"("id":"b","has_parts":false,"height":9)", "Polygon", square_at(20, 0))});
  const auto parts =
      write("building_part.geojson",
            {feature(R"("id":"p","building_id":"a","is_underground":false,"height":12)", "Polygon", square_at(0, 0)),
             feature(R"("id":"q","building_id":"a","is_underground":false,"height":60,"min_height":12)", "Polygon",
                     square_at(2, 2, 3))});
  Report report;
  const std::vector<SourceCity> cities = ingest_all(std::vector<InputFile>{outlines, parts}, {}, report);
  ASSERT_THAT(report.problems(), IsEmpty());
  ASSERT_EQ(cities.size(), 2U);
  ASSERT_EQ(cities[0].city.buildings().size(), 1U);
  EXPECT_EQ(cities[0].city.buildings()[0].id, "b");
  EXPECT_THAT(cities[0].skipped, ElementsAre(Pair("outlines of buildings whose parts are there", 1U)));
  EXPECT_EQ(cities[1].city.buildings().size(), 2U);
}

TEST(FootprintTable, NumbersThatAreNoHeightGiveWayToStoreysAndTheDefault) {
  const std::vector<std::string> features{feature(R"("id":"a","height":-1,"levels":2)", "Polygon", square_at(0, 0)),
                                          feature(R"("id":"b","height":-9999,"levels":null)", "Polygon", square_at(20, 0)),
                                          feature(R"("id":"c","height":0,"levels":0)", "Polygon", square_at(40, 0)),
                                          feature(R"("id":"d","height":999,"levels":4)", "Polygon", square_at(60, 0))};
  IngestSettings settings = with_default(7.0);
  EXPECT_THAT(extents(read_tagged(features, settings)), ElementsAre(Pair("a", Pair(0.0, 6.0)), Pair("b", Pair(0.0, 7.0)),
                                                                    Pair("c", Pair(0.0, 7.0)), Pair("d", Pair(0.0, 999.0))));
  settings.footprints.unknown_heights = {999.0, 2.0};
  EXPECT_THAT(extents(read_tagged(features, settings)), ElementsAre(Pair("a", Pair(0.0, 7.0)), Pair("b", Pair(0.0, 7.0)),
                                                                    Pair("c", Pair(0.0, 7.0)), Pair("d", Pair(0.0, 12.0))));
  settings.footprints.default_height_m.reset();
  EXPECT_THAT(extents(read_tagged(features, settings)), ElementsAre(Pair("d", Pair(0.0, 12.0))));
}

TEST(FootprintTable, ALayerIsReadByItsName) {
  IngestSettings settings;
  settings.footprints.layer = "elsewhere";
  const auto file = write_file("a.geojson", collection({feature(R"("height":3)", "Polygon", square_at(0, 0))}));
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_file(file, settings); }),
              HasSubstr("has no layer \"elsewhere\": give one of a as --layer"));
  settings.footprints.layer = "a";
  EXPECT_EQ(read_file(file, settings).city().buildings().size(), 1u);
}

}  // namespace
}  // namespace farlod::ingest::test
