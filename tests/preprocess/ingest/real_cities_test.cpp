// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "reading.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
namespace {

TEST(RealCities, Tokyo) {
  FARLOD_NEEDS_DATA("tokyo");
  const std::filesystem::path file = shared_data("tokyo/53392633_bldg_6697_2_op.gml");
  const Reading best = read_file(file);
  EXPECT_EQ(best.city().buildings().size(), 9u);
  EXPECT_EQ(best.source.crs.definition, "http://www.opengis.net/def/crs/EPSG/0/6697");
  // The 1,083 polygons of the file are 9 roof edges, 177 in LoD 1 and 897 in LoD 2: one level may count
  EXPECT_EQ(surface_count(best.city()), 897u);
  EXPECT_EQ(best.codes(), std::set<int>{114});
  IngestSettings settings;
  settings.lod.exactly = 1;
  EXPECT_EQ(surface_count(read_file(file, settings).city()), 177u);
}

TEST(RealCities, NorthRhineWestphalia) {
  FARLOD_NEEDS_DATA("nrw");
  std::size_t buildings = 0, parts = 0;
  std::uint64_t polygons = 0;
  for (const char* name : {"nrw/LoD2_32_280_5657_1_NW.gml", "nrw/LoD2_32_280_5659_1_NW.gml"}) {
    const Reading r = read_file(shared_data(name));
    EXPECT_TRUE(r.codes().empty());
    buildings += r.city().buildings().size();
    polygons += surface_count(r.city());
    for (const Building& b : r.city().buildings()) {
      std::set<std::uint16_t> numbers;
      for (const Facet& f : r.city().facets_of(b)) numbers.insert(f.part);
      numbers.erase(0);
      parts += numbers.size();
    }
  }
  EXPECT_EQ(buildings, 192u);
  EXPECT_EQ(parts, 105u);
  EXPECT_EQ(polygons, 2585u);
}

TEST(RealCities, Rotterdam) {
  FARLOD_NEEDS_DATA("rotterdam");
  const Reading r = read_file(shared_data("rotterdam/delfshaven.city.json"));
  EXPECT_EQ(r.city().buildings().size(), 853u);
  EXPECT_EQ(r.report.count(ProblemCode::too_few_points), 633u);
  EXPECT_EQ(surface_count(r.city()) + r.report.count(ProblemCode::too_few_points), 15482u);
}

TEST(RealCities, Queens) {
  FARLOD_NEEDS_DATA("nyc_queens");
  const Reading r = read_file(shared_data("nyc_queens/queens_da4.obj"));
  EXPECT_EQ(r.city().buildings().size(), 16665u);
  EXPECT_EQ(r.city().facets().size() + r.report.count(ProblemCode::too_few_points), 401110u);
  // One building number stands for all 929 buildings without a number
  EXPECT_EQ(r.report.count(ProblemCode::repeated_id), 928u);
  EXPECT_EQ(surface_count(r.city()), 153851u);
}

TEST(RealCities, Omiya) {
  FARLOD_NEEDS_DATA("omiya");
  IngestSettings settings;
  settings.footprints.height_field = "TAKASA";
  const Reading r = read_file(shared_data("omiya/omiya.geojson"), settings);
  EXPECT_EQ(r.city().buildings().size(), 10213u);
  // 101,722 sides and lids, of which 669 walls stand between a vertex and its repetition: they are no surfaces
  EXPECT_EQ(surface_count(r.city()), 101722u - 669u);
  EXPECT_EQ(r.report.count(ProblemCode::repeated_vertex), 88u);
}

TEST(RealCities, Manhattan) {
  FARLOD_NEEDS_DATA("manhattan");
  const Reading r = read_file(shared_data("manhattan/manhattan.geojson"));
  // Of 11 without a height two have building:levels, and 5 and 4 walls
  EXPECT_EQ(r.city().buildings().size(), 1239u - 9u);
  EXPECT_EQ(surface_count(r.city()), 15091u + 7u + 6u);
  EXPECT_EQ(r.report.count(ProblemCode::no_height), 9u);
  EXPECT_EQ(r.report.count(ProblemCode::not_an_area), 47u);
}

TEST(RealCities, BuildingAndGarageShareAWallOnce) {
  FARLOD_NEEDS_DATA("formats");
  const Reading r = read_file(shared_data("formats/Building_and_garage_LOD2-EPSG25832.gml"));
  EXPECT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(surface_count(r.city()), 13u);
  EXPECT_TRUE(r.codes().empty());
}

TEST(RealCities, OpeningsFillTheWallsOfLod3) {
  FARLOD_NEEDS_DATA("formats");
  const Reading r = read_file(shared_data("formats/Building_LOD3-EPSG25832.gml"));
  EXPECT_EQ(surface_count(r.city()), 24u);
  EXPECT_TRUE(r.codes().empty());
}

}  // namespace
}  // namespace farlod::ingest::test
