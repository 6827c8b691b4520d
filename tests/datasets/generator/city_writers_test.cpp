// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "farlod/error.hpp"
#include "generator/city_writer.hpp"
#include "generator/convex_faces.hpp"
#include "generator/generated_city.hpp"
#include "tests/datasets/generator/solid_geometry.hpp"
#include "tests/datasets/generator/written_city.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using ::testing::HasSubstr;

CitySettings small_city(int lod) {
  return {.size_m = 450.0,
          .seed = 7,
          .rotation_deg = 29.0,
          .terrain_relief_m = 30.0,
          .lod = lod,
          .overhangs = true,
          .epsg = 25832,
          .centre_easting_m = 566000.25};
}

void write(const CitySettings& settings, const std::filesystem::path& path) {
  const auto writer = make_city_writer(*generated_format_of(path), path, header_of(settings, path));
  writer->begin();
  visit_city(settings, {.building = [&writer](const GeneratedBuilding& building) { writer->add(building); }});
  writer->end();
}

PlaceMm placed(const CitySettings& settings, std::int64_t x_mm, std::int64_t y_mm, std::int64_t z_mm) {
  return {millimetres(settings.centre_easting_m) + x_mm, millimetres(settings.centre_northing_m) + y_mm, z_mm};
}

enum class Polygons { facets, convex_faces, none };
enum class Places { solid, footprint };

/// The city as the library makes it, in the terms of a format: `Polygons::facets` stands for formats that know solids and
/// components, and `Places::footprint` for those that have a feature for each part.
WrittenCity expected_city(const CitySettings& settings, Polygons polygons, Places places) {
  WrittenCity city{settings.epsg, {}};
  const auto add_footprint = [&](const GeneratedComponent& c) {
    if (c.kind == ComponentKind::installation) return;
    WrittenBuilding& b = city.buildings[c.id];
    b.base_mm = c.base_mm;
    b.height_mm = c.top_mm - c.base_mm;
    for (const auto* ring : {&c.footprint, &c.footprint_hole})
      for (const PlanPointMm& p : *ring) b.places.insert({placed(settings, p[0], p[1], 0)});
  };
  visit_city(settings, {.building = [&](const GeneratedBuilding& building) {
               if (places == Places::footprint) {
                 for (const GeneratedComponent& c : building.components) add_footprint(c);
                 return;
               }
               WrittenBuilding& b = city.buildings[building.id];
               b.base_mm = building.base_mm;
               b.height_mm = building.top_mm - building.base_mm;
               for (const PointMm& p : building.vertices) b.places.insert(placed(settings, p.x, p.y, p.z));
               if (polygons == Polygons::convex_faces) {
                 for (const GeneratedFacet& facet : building.facets) b.polygons += convex_faces(facet, building.vertices).size();
                 return;
               }
               b.polygons = building.facets.size();
               for (const GeneratedComponent& c : building.components) {
                 b.solids += c.closed ? 1 : 0;
                 if (c.kind != ComponentKind::body) b.children.insert(c.id);
               }
               b.said_by_children = b.children;
             }});
  return city;
}

void expect_same(const WrittenCity& read, const WrittenCity& expected) {
  EXPECT_EQ(read.epsg, expected.epsg);
  ASSERT_EQ(read.buildings.size(), expected.buildings.size());
  ASSERT_GT(read.buildings.size(), 0U);
  for (const auto& [id, building] : expected.buildings) {
    ASSERT_TRUE(read.buildings.contains(id)) << id;
    const WrittenBuilding& found = read.buildings.at(id);
    EXPECT_EQ(found.base_mm, building.base_mm) << id;
    EXPECT_EQ(found.height_mm, building.height_mm) << id;
    EXPECT_EQ(found.polygons, building.polygons) << id;
    EXPECT_EQ(found.solids, building.solids) << id;
    EXPECT_EQ(found.places, building.places) << id;
    EXPECT_EQ(found.children, building.children) << id;
    EXPECT_EQ(found.said_by_children, building.said_by_children) << id;
  }
}

/// Each level of detail, and a city for each option.
std::vector<CitySettings> written_cities() {
  std::vector<CitySettings> cities = cities_with_each_option();
  for (CitySettings& city : cities) city.size_m = 350.0;
  cities.insert(cities.begin(), {small_city(1), small_city(2)});
  return cities;
}

class CityWriters : public ::testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Cities, CityWriters, ::testing::Range<std::size_t>(0, 11));

TEST_P(CityWriters, EachFormatHoldsTheCityAndLeavesNothingBesideIt) {
  struct Format {
    const char* file;
    WrittenCity (*read)(const std::filesystem::path&);
    Polygons polygons = Polygons::facets;
    Places places = Places::solid;
  };
  const CitySettings settings = written_cities().at(GetParam());
  const scenes::TemporaryFolder folder;
  for (const auto& [file, read, polygons, places] : {Format{"city.gml", read_citygml}, Format{"city.city.json", read_cityjson},
                                                     Format{"city.obj", read_obj, Polygons::convex_faces},
                                                     Format{"city.geojson", read_geojson, Polygons::none, Places::footprint}}) {
    SCOPED_TRACE(file);
    write(settings, folder.file(file));
    expect_same(read(folder.file(file)), expected_city(settings, polygons, places));
  }
  EXPECT_EQ(folder.names().size(), 4U);
}

CitySettings town(void (*switch_on)(CitySettings&)) {
  CitySettings settings = small_city(2);
  switch_on(settings);
  return settings;
}

TEST(CityGmlWriter, OpenShellsHaveNoSolid) {
  const scenes::TemporaryFolder folder;
  for (const int lod : {1, 2}) {
    CitySettings settings = small_city(lod);
    settings.open_shells = true, settings.overhangs = false;
    write(settings, folder.file("city.gml"));
    const std::string text = scenes::text_of(folder.file("city.gml"));
    EXPECT_EQ(count_of(text, "Solid>"), 0U);
    EXPECT_EQ(count_of(text, "<bldg:lod1MultiSurface>") > 0, lod == 1);
    EXPECT_EQ(count_of(text, "<bldg:lod2MultiSurface>") > 0, lod == 2);
  }
}

TEST(CityGmlWriter, WindowsAndDoorsAreOpeningsOfTheirWalls) {
  const scenes::TemporaryFolder folder;
  const CitySettings settings = town([](CitySettings& s) { s.facade_details = true; });
  write(settings, folder.file("city.gml"));
  const std::string text = scenes::text_of(folder.file("city.gml"));
  std::size_t windows = 0, doors = 0, holes = 0;
  visit_city(settings, {.building = [&](const GeneratedBuilding& building) {
               for (const GeneratedFacet& facet : building.facets) {
                 windows += facet.filling == Filling::window ? 1 : 0;
                 doors += facet.filling == Filling::door ? 1 : 0;
                 holes += facet.openings.size() + (facet.hole.empty() ? 0 : 1);
               }
             }});
  EXPECT_GT(windows, 0U);
  EXPECT_GT(doors, 0U);
  EXPECT_EQ(count_of(text, "<bldg:opening><bldg:Window gml:id="), windows);
  EXPECT_EQ(count_of(text, "<bldg:opening><bldg:Door gml:id="), doors);
  EXPECT_EQ(count_of(text, "<gml:interior>"), holes);
  EXPECT_EQ(count_of(text, "lod2"), 0U);
  EXPECT_GT(count_of(text, "<bldg:lod3Solid>"), 0U);
  EXPECT_GT(count_of(text, "<bldg:lod3Geometry>"), 0U);
  // An opening follows the polygon of its wall, and is followed by another or by the end of the wall
  EXPECT_EQ(count_of(text, "</bldg:opening>\n<bldg:opening>") + count_of(text, "</bldg:opening></bldg:WallSurface>"),
            windows + doors);
}

TEST(CityJsonWriter, NamesWindowsAndDoors) {
  const scenes::TemporaryFolder folder;
  const CitySettings settings = town([](CitySettings& s) { s.facade_details = true; });
  write(settings, folder.file("city.city.json"));
  const auto json = nlohmann::json::parse(scenes::text_of(folder.file("city.city.json")));
  const std::map<Filling, std::string> type_of{{Filling::window, "Window"}, {Filling::door, "Door"}};
  visit_city(settings, {.building = [&](const GeneratedBuilding& building) {
               const auto& geometry = json.at("CityObjects").at(building.id).at("geometry").at(0);
               EXPECT_EQ(geometry.at("lod"), "3");
               const auto& semantics = geometry.at("semantics");
               for (std::size_t k = 0; k < building.components.front().facet_count; ++k) {
                 const std::string type =
                     semantics.at("surfaces").at(semantics.at("values").at(0).at(k).get<std::size_t>()).at("type");
                 const auto expected = type_of.find(building.facets[k].filling);
                 EXPECT_EQ(type == "Window" || type == "Door", expected != type_of.end());
                 if (expected != type_of.end()) {
                   EXPECT_EQ(type, expected->second);
                 }
               }
             }});
}

TEST(CityJsonWriter, ShellsThatAreNotClosedAreMultiSurfacesWithSemantics) {
  const scenes::TemporaryFolder folder;
  const CitySettings settings = town([](CitySettings& s) { s.eaves_m = 0.5; });
  write(settings, folder.file("city.city.json"));
  const auto json = nlohmann::json::parse(scenes::text_of(folder.file("city.city.json")));
  int open = 0;
  visit_city(settings, {.building = [&](const GeneratedBuilding& building) {
               const auto& geometry = json.at("CityObjects").at(building.id).at("geometry").at(0);
               const bool closed = building.components.front().closed;
               EXPECT_EQ(geometry.at("type"), closed ? "Solid" : "MultiSurface");
               open += closed ? 0 : 1;
               const auto& values = geometry.at("semantics").at("values");
               EXPECT_EQ((closed ? values.at(0) : values).size(), building.facets.size());
             }});
  EXPECT_GT(open, 0);
}

TEST(CityGmlWriter, EnvelopeHoldsTheCityTightly) {
  const scenes::TemporaryFolder folder;
  write(small_city(2), folder.file("city.gml"));
  const std::string text = scenes::text_of(folder.file("city.gml"));
  PlaceMm low{INT64_MAX, INT64_MAX, INT64_MAX}, high{INT64_MIN, INT64_MIN, INT64_MIN};
  for (const auto& [id, building] : read_citygml(folder.file("city.gml")).buildings)
    for (const PlaceMm& p : building.places)
      for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  for (const auto& [element, corner] : {std::pair{"lowerCorner", low}, std::pair{"upperCorner", high}}) {
    const std::size_t begin = text.find(std::string("<gml:") + element + ">") + std::string(element).size() + 6;
    std::istringstream numbers(text.substr(begin, 60));
    for (std::size_t k = 0; k < 3; ++k) {
      double x = 0.0;
      numbers >> x;
      EXPECT_EQ(millimetres(x), corner[k]) << element << k;
    }
  }
}

TEST(CityGmlWriter, SolidsOfLod2ReferToAllTheirSurfaces) {
  const scenes::TemporaryFolder folder;
  write(small_city(2), folder.file("city.gml"));
  const std::string text = scenes::text_of(folder.file("city.gml"));
  std::set<std::string> named, referred;
  const std::regex id("<gml:Polygon gml:id=\"([^\"]+)\""), reference("xlink:href=\"#([^\"]+)\"");
  for (std::sregex_iterator m(text.begin(), text.end(), id), end; m != end; ++m) EXPECT_TRUE(named.insert((*m)[1]).second);
  for (std::sregex_iterator m(text.begin(), text.end(), reference), end; m != end; ++m)
    EXPECT_TRUE(referred.insert((*m)[1]).second);
  EXPECT_FALSE(named.empty());
  EXPECT_EQ(named, referred);
}

TEST(CityJsonWriter, SemanticsNameARoleForEachSurface) {
  const scenes::TemporaryFolder folder;
  write(small_city(2), folder.file("city.city.json"));
  const auto json = nlohmann::json::parse(scenes::text_of(folder.file("city.city.json")));
  EXPECT_EQ(json.at("version"), "2.0");
  std::map<std::string, FacetRole> role_of{{"RoofSurface", FacetRole::roof},
                                           {"WallSurface", FacetRole::wall},
                                           {"GroundSurface", FacetRole::ground},
                                           {"OuterCeilingSurface", FacetRole::outer_ceiling}};
  visit_city(small_city(2), {.building = [&](const GeneratedBuilding& building) {
               const auto& geometry = json.at("CityObjects").at(building.id).at("geometry").at(0);
               const auto& values = geometry.at("semantics").at("values").at(0);
               ASSERT_EQ(values.size(), building.facets.size());
               for (std::size_t k = 0; k < values.size(); ++k) {
                 const std::string type = geometry.at("semantics").at("surfaces").at(values[k].get<std::size_t>()).at("type");
                 EXPECT_EQ(role_of.at(type), building.facets[k].role);
               }
             }});
}

TEST(ObjWriter, CountsFromTheCentreWhenAsked) {
  const scenes::TemporaryFolder folder;
  const CitySettings settings = small_city(1);
  CityHeader header = header_of(settings, folder.file("local.obj"));
  header.obj_from_centre = true;
  const auto writer = make_obj_writer(folder.file("local.obj"), header);
  writer->begin();
  const GeneratedBuilding building = buildings_of_block(settings, {0, 0}).at(0);
  writer->add(building);
  writer->end();
  const PointMm& p = building.vertices.front();
  EXPECT_TRUE(read_obj(folder.file("local.obj")).buildings.at(building.id).places.contains({p.x, p.y, p.z}));
  EXPECT_THAT(scenes::text_of(folder.file("local.obj")), HasSubstr("# Origin, to be added to x and y: 566000.250,5500000.000\n"));
}

TEST(GeneratedCityWriter, NamesTheFolderThatIsNotThere) {
  const CityHeader header;
  EXPECT_THAT([&] { (void)make_obj_writer("/no/such/folder/city.obj", header); },
              ::testing::ThrowsMessage<OutputError>(
                  ::testing::AllOf(HasSubstr("/no/such/folder/city.obj"), HasSubstr("No such file or directory"))));
}

TEST(GeneratedCityWriter, AnUnfinishedCityLeavesNothing) {
  const scenes::TemporaryFolder folder;
  {
    const auto writer = make_cityjson_writer(folder.file("city.city.json"), CityHeader{});
    writer->begin();
  }
  EXPECT_EQ(folder.names().size(), 0U);
}

TEST(GeneratedCityWriter, OddFileNamesDoNotSpoilTheFile) {
  const scenes::TemporaryFolder folder;
  const std::string name = "a\"<&>\n\xFFz.city.json";
  write(small_city(1), folder.file(name));
  EXPECT_EQ(nlohmann::json::parse(scenes::text_of(folder.file(name))).at("metadata").at("title"), "a______z");
}

TEST(CityFormatOf, KnowsTheEndings) {
  EXPECT_EQ(generated_format_of("a/b.gml"), CityFormat::citygml);
  EXPECT_EQ(generated_format_of("b.city.json"), CityFormat::cityjson);
  EXPECT_EQ(generated_format_of("b.obj"), CityFormat::obj);
  EXPECT_EQ(generated_format_of("b.geojson"), CityFormat::geojson);
  EXPECT_FALSE(generated_format_of("b.tif"));
  EXPECT_FALSE(generated_format_of("obj"));
}

TEST(AppendMetres, WritesThreeDecimalsAlways) {
  std::string text;
  for (const std::int64_t value_mm : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{5500000020}, std::int64_t{-12345}}) {
    append_metres(text, value_mm);
    text += ' ';
  }
  EXPECT_EQ(text, "0.000 -0.001 5500000.020 -12.345 ");
}

}  // namespace
}  // namespace farlod
