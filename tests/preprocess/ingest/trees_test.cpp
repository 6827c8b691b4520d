// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "farlod/error.hpp"
#include "ingest/trees/tree_fields.hpp"
#include "ingest/trees/tree_reader.hpp"
#include "small_cities.hpp"
#include "tree_reading.hpp"

namespace farlod::ingest::test {
namespace {

std::string utm_collection(const std::vector<std::string>& features) {
  return collection(features, R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::32632"}},)");
}
std::string tree(const std::string& properties) { return feature(properties, "Point", "[500000,5500000]"); }
Tree only_tree(const std::string& properties, const TreeSettings& settings = {}) {
  return read_inventory("a.geojson", utm_collection({tree(properties)}), settings).source.trees[0];
}

struct Named {
  std::string field;
  double height_m, crown_m, trunk_m;
};

class TreeFieldNames : public testing::TestWithParam<Named> {};

TEST_P(TreeFieldNames, AreKnown) {
  const Named& named = GetParam();
  const Tree t = only_tree(named.field);
  EXPECT_NEAR(t.height_m, named.height_m, float_error_m);
  EXPECT_NEAR(t.crown_diameter_m, named.crown_m, float_error_m);
  EXPECT_NEAR(t.trunk_height_m, named.trunk_m, float_error_m);
}

const double dbh_30_cm_m = 20.0 * std::sqrt(0.3);

INSTANTIATE_TEST_SUITE_P(
    Trees, TreeFieldNames,
    testing::Values(Named{R"("height":8)", 8, 4, 2}, Named{R"("HEIGHT_M":"8,5 m")", 8.5, 4.25, 2.125},
                    Named{R"("BAUMHOEHE":8)", 8, 4, 2}, Named{R"("baumhoehe":"8")", 8, 4, 2},
                    Named{R"("TOTAL_HEIGHT":8)", 8, 4, 2}, Named{R"("h_tree":8,"h_trunk":1)", 8, 4, 1},
                    Named{R"("height_ft":10)", 3.048, 1.524, 0.762}, Named{R"("height":8,"KRONENDURCHMESSER":5)", 8, 5, 2},
                    Named{R"("height":8,"kronedurch":5)", 8, 5, 2}, Named{R"("height":8,"KRONE_DM":5)", 8, 5, 2},
                    Named{R"("height":8,"CROWN_DIAMETER":5)", 8, 5, 2}, Named{R"("height":8,"crownDiameter":5)", 8, 5, 2},
                    Named{R"("height":8,"crown":5)", 8, 5, 2}, Named{R"("height":8,"d_crown":5)", 8, 5, 2},
                    Named{R"("height":8,"diameter_crown":"5 m")", 8, 5, 2}, Named{R"("height":8,"crown_radius":3)", 8, 6, 2},
                    Named{R"("height":8,"canopy_m2":9)", 8, 6.0 / std::sqrt(std::numbers::pi), 2},
                    Named{R"("crown":5)", 10, 5, 2.5}, Named{R"("dbh":30)", dbh_30_cm_m, 0.5 * dbh_30_cm_m, 0.25 * dbh_30_cm_m},
                    Named{R"("Diameter.Breast.Height":30)", dbh_30_cm_m, 0.5 * dbh_30_cm_m, 0.25 * dbh_30_cm_m},
                    Named{R"("stammumfg":94.24777961)", dbh_30_cm_m, 0.5 * dbh_30_cm_m, 0.25 * dbh_30_cm_m},
                    Named{R"("circumference":0.9424777961)", dbh_30_cm_m, 0.5 * dbh_30_cm_m, 0.25 * dbh_30_cm_m},
                    Named{R"("circumference":"37.1054242562 inches")", dbh_30_cm_m, 0.5 * dbh_30_cm_m, 0.25 * dbh_30_cm_m},
                    // Nobody's girth is 94 m
                    Named{R"("circumference":94.24777961)", dbh_30_cm_m, 0.5 * dbh_30_cm_m, 0.25 * dbh_30_cm_m},
                    Named{R"("tree_dbh":"11.8110236 in")", dbh_30_cm_m, 0.5 * dbh_30_cm_m, 0.25 * dbh_30_cm_m},
                    Named{R"("something":5)", 10, 5, 2.5}, Named{R"("height":0,"crown":0)", 10, 5, 2.5},
                    Named{R"("height":8,"h_trunk":0)", 8, 4, 0}));

TEST(Trees, FieldsAreThoseThatAreNamed) {
  TreeSettings settings;
  settings.height_field = "H1";
  settings.crown_field = "Area_Crown_Area";
  EXPECT_THROW((void)only_tree(R"("h1":7,"height":9)", settings), InputError);
  settings.crown_field = "k";
  settings.trunk_field = "S";
  settings.trunk_ratio = 0.5;
  const Tree t = only_tree(R"("h1":7,"height":9,"k":6,"d_crown":3,"s":2)", settings);
  EXPECT_EQ(t.height_m, 7.0F);
  EXPECT_EQ(t.crown_diameter_m, 6.0F);
  EXPECT_EQ(t.trunk_height_m, 2.0F);
  settings.crown_field = "canopy_m2";
  EXPECT_NEAR(only_tree(R"("h1":7,"canopy_m2":9,"d_crown":3,"s":2)", settings).crown_diameter_m,
              6.0 / std::sqrt(std::numbers::pi), float_error_m);
}

TEST(Trees, TagsOfOpenStreetMapAreFields) {
  const std::string text =
      utm_collection({tree(R"("tags":{"natural":"tree","height":"12 m","diameter_crown":"6","leaf_cycle":"evergreen"})"),
                      tree(R"("tags":{"natural":"tree","species":"Taxus baccata"})"),
                      tree(R"("tags":{"amenity":"bench","height":"1"})"), tree(R"("tags":{"natural":"shrub"})")});
  const TreeReading r = read_inventory("a.geojson", text);
  ASSERT_EQ(r.source.trees.size(), 2U);
  EXPECT_EQ(r.source.trees[0].height_m, 12.0F);
  EXPECT_EQ(r.source.trees[0].crown_diameter_m, 6.0F);
  EXPECT_EQ(r.source.trees[0].foliage, Foliage::evergreen);
  EXPECT_EQ(r.source.trees[1].foliage, Foliage::evergreen);
  EXPECT_EQ(r.source.skipped, (SkippedFeatures{{"features other than trees", 2}}));
}

TEST(Trees, TagsAreObjectsOrLists) {
  const Tags both{{"natural", "tree"}, {"name", "a \"b\" => c"}};
  EXPECT_EQ(tags_in(R"({"natural": "tree", "name": "a \"b\" => c", "list": [1]})"), both);
  EXPECT_EQ(tags_in(R"("natural"=>"tree","name"=>"a \"b\" => c")"), both);
  EXPECT_EQ(tags_in(R"({"height": 5.5})"), (Tags{{"height", "5.5"}}));
  for (const char* text : {"", "  ", "A 12", "[1,2]", "{", R"("a"=>)", "null"}) EXPECT_TRUE(tags_in(text).empty()) << text;
}

TEST(Trees, FoliageIsThatOfTheGenus) {
  for (const char* species :
       {"Pinus nigra", "PICEA", "Norway Spruce", "Quercus ilex", "x Cupressocyparis leylandii", "Eucalyptus"})
    EXPECT_EQ(foliage_of_species(species), Foliage::evergreen) << species;
  for (const char* species : {"Larix decidua", "bald cypress", "Robinia pseudoacacia (false acacia)"})
    EXPECT_EQ(foliage_of_species(species), Foliage::deciduous) << species;
  for (const char* species : {"", "Tilia cordata", "イチョウ", "Pineapple", "5"})
    EXPECT_EQ(foliage_of_species(species), Foliage::unknown) << species;
  EXPECT_EQ(foliage_of_leaves("Deciduous"), Foliage::deciduous);
  EXPECT_EQ(foliage_of_leaves("needleleaved"), Foliage::evergreen);
  EXPECT_EQ(foliage_of_leaves("broadleaved"), Foliage::unknown);
  EXPECT_EQ(only_tree(R"("leaf_type":"needleleaved","species":"Larix decidua")").foliage, Foliage::deciduous);
}

TEST(Trees, OutlinesAreCrowns) {
  const std::string square = "[[[500000,5500000],[500004,5500000],[500004,5500004],[500000,5500004],[500000,5500000]]]";
  const std::string court =
      "[[[0,0],[4,0],[4,4],[0,4],[0,0]],[[2,2],[4,2],[4,4],[2,4],[2,2]]]";  // without its north-eastern quarter
  const TreeReading r = read_inventory("a.geojson", utm_collection({feature(R"("height":8)", "Polygon", square),
                                                                    feature(R"("height":8)", "MultiPolygon", "[" + court + "]"),
                                                                    feature(R"("height":8,"d_crown":3)", "Polygon", square)}));
  ASSERT_EQ(r.source.trees.size(), 3U);
  EXPECT_EQ(r.source.trees[0].place, (Point2d{500002.0, 5500002.0}));
  EXPECT_NEAR(r.source.trees[0].crown_diameter_m, 8.0 / std::sqrt(std::numbers::pi), float_error_m);
  EXPECT_NEAR(r.source.trees[1].place.x, 5.0 / 3.0, 1e-12);
  EXPECT_NEAR(r.source.trees[1].place.y, 5.0 / 3.0, 1e-12);
  EXPECT_NEAR(r.source.trees[1].crown_diameter_m, 2.0 * std::sqrt(12.0 / std::numbers::pi), float_error_m);
  EXPECT_EQ(r.source.trees[2].crown_diameter_m, 3.0F);
}

TEST(Trees, OutlinesInDegreesHaveMetres) {
  const std::string file = R"({"type":"FeatureCollection","features":[)" +
                           feature("", "Polygon", "[[[9,60],[9.0001,60],[9.0001,60.00005],[9,60.00005],[9,60]]]") + "]}";
  // 5.55 m by 5.55 m: at 60°, a degree of longitude is half as long as one of latitude
  EXPECT_NEAR(read_inventory("a.geojson", file).source.trees[0].crown_diameter_m, 2.0 * 5.55 / std::sqrt(std::numbers::pi), 0.01);
}

TEST(Trees, EachPointOfSeveralIsOne) {
  const TreeReading r = read_inventory("a.geojson", utm_collection({feature(R"("height":8)", "MultiPoint", "[[1,2],[3,4]]")}));
  ASSERT_EQ(r.source.trees.size(), 2U);
  EXPECT_EQ(r.source.trees[1].place, (Point2d{3.0, 4.0}));
}

TEST(Trees, TablesHaveTheirColumnsInAnyOrder) {
  const TreeReading degrees = read_inventory("a.csv", "Latitude,height,Longitude,x,y\n48.5,8,9.25,1,2\n");
  EXPECT_EQ(degrees.source.trees[0].place, (Point2d{9.25, 48.5}));
  EXPECT_EQ(degrees.source.crs.definition, "EPSG:4326");
  const TreeReading semicolons = read_inventory("a.txt", "Y;X;BAUMHOEHE\n5500000,5;500000,25;8,5\n");
  EXPECT_EQ(semicolons.source.trees[0].place, (Point2d{500000.25, 5500000.5}));
  EXPECT_EQ(semicolons.source.trees[0].height_m, 8.5F);
  EXPECT_EQ(semicolons.source.crs.definition, "");
  EXPECT_THROW((void)read_inventory("a.csv", "a,b\n1,2\n"), InputError);
  EXPECT_EQ(find_place_columns({"lat", "x"}), std::nullopt);
}

TEST(Trees, WhatIsMissingIsCounted) {
  const TreeReading r =
      read_inventory("a.geojson", utm_collection({tree(R"("height":8,"crown":4,"dbh":20)"), tree(R"("height":8)"),
                                                  tree(R"("crown":4)"), tree(R"("dbh":20)"), tree(R"("height":"unknown")")}));
  EXPECT_EQ(r.codes(), std::set<int>{120});
  EXPECT_EQ(r.detail_of(ProblemCode::tree_size_missing),
            "heights from crown diameters: 1 of 5; heights from trunk diameters: 1 of 5; heights of 10 m by default: 1 of 5; "
            "crown diameters from heights: 3 of 5");
}

TEST(Trees, ClassesAreDoubted) {
  std::vector<std::string> classes, metres, one_value;
  for (int n = 0; n < 20; ++n) {
    classes.push_back(tree("\"height\":" + std::to_string(1 + n % 5) + ",\"crown\":4.5"));
    metres.push_back(tree("\"height\":" + std::to_string(1 + n % 12) + ",\"crown\":4.5"));
  }
  const TreeReading r = read_inventory("a.geojson", utm_collection(classes));
  EXPECT_EQ(r.codes(), std::set<int>{121});
  EXPECT_TRUE(r.detail_of(ProblemCode::tree_size_classes).starts_with("the 20 heights are whole numbers up to 5 m: "));
  EXPECT_EQ(read_inventory("b.geojson", utm_collection(metres)).codes(), std::set<int>{});
  for (int n = 0; n < 20; ++n) one_value.push_back(tree(R"("height":9,"crown":4)"));
  EXPECT_EQ(read_inventory("d.geojson", utm_collection(one_value)).codes(), std::set<int>{});
  classes.pop_back();
  EXPECT_EQ(read_inventory("c.geojson", utm_collection(classes)).codes(), std::set<int>{});
}

TEST(Trees, AbsurdSizesAreNotStated) {
  const TreeReading r =
      read_inventory("a.geojson", utm_collection({tree(R"("height":9999,"crown":4)"), tree(R"("height":-1,"crown":4)"),
                                                  tree(R"("height":8,"crown":4,"trunk_height":8)")}));
  EXPECT_EQ(r.codes(), (std::set<int>{120, 122, 125}));
  EXPECT_EQ(r.detail_of(ProblemCode::absurd_tree_size), "2 trees, of which the first: a height of 9999 m");
  EXPECT_EQ(r.detail_of(ProblemCode::trunk_above_crown), "a crown from 8 m to 8 m");
  EXPECT_EQ(r.source.trees[0].height_m, 8.0F);
  EXPECT_EQ(r.source.trees[2].trunk_height_m, 2.0F);
}

TEST(Trees, FeaturesThatAreNoneAreLeftOut) {
  const TreeReading r = read_inventory(
      "a.geojson",
      utm_collection({tree(R"("height":8,"crown":4)"), feature("", "LineString", "[[1,2],[3,4]]"),
                      R"({"type":"Feature","properties":{},"geometry":null})", feature("", "Polygon", "[[[1,1],[2,2],[1,1]]]")}));
  EXPECT_EQ(r.source.trees.size(), 1U);
  EXPECT_EQ(r.codes(), (std::set<int>{108, 111, 112}));
  const TreeReading table = read_inventory("a.csv", "x,y,height,crown\n1,2,8,4\n,2,8,4\nnan,2,8,4\n");
  EXPECT_EQ(table.source.trees.size(), 1U);
  EXPECT_EQ(table.codes(), std::set<int>{102});
}

TEST(Trees, FilesWithoutAnyAreRefused) {
  EXPECT_THROW((void)read_inventory("lost.geojson"), InputError);
  EXPECT_THROW((void)read_inventory("a.geojson", ""), InputError);
  EXPECT_THROW((void)read_inventory("a.csv", ""), InputError);
  EXPECT_THROW((void)read_inventory("a.csv", "x,y\n"), InputError);
  EXPECT_THROW((void)read_inventory("a.geojson", "no map at all"), InputError);
  EXPECT_THROW((void)read_inventory("a.geojson", R"({"type":"FeatureCollection","features":[]})"), InputError);
  EXPECT_THROW((void)read_inventory("a.geojson", utm_collection({feature("", "LineString", "[[1,2],[3,4]]")})), InputError);
}

TEST(Trees, OfCityGmlStandAtTheirReferencePoints) {
  const std::string instance =
      "<veg:species>Pinus</veg:species><veg:height uom=\"m\">8</veg:height><veg:trunkDiameter>30</veg:trunkDiameter>"
      "<veg:crownDiameter>5</veg:crownDiameter><veg:lod2ImplicitRepresentation><ImplicitGeometry><transformationMatrix>"
      "2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1</transformationMatrix><relativeGMLGeometry><gml:posList>0 0 0 1 0 0 1 1 1</gml:posList>"
      "</relativeGMLGeometry><referencePoint><gml:Point><gml:pos>400000.5 5800000.25 40</gml:pos></gml:Point></referencePoint>"
      "</ImplicitGeometry></veg:lod2ImplicitRepresentation>";
  const std::string cover = "<veg:PlantCover><veg:height>9</veg:height></veg:PlantCover>";
  const TreeReading r = read_inventory("a.gml", citygml(cover + citygml_tree(instance)));
  ASSERT_EQ(r.source.trees.size(), 1U);
  const Tree& t = r.source.trees[0];
  EXPECT_EQ(t.place, (Point2d{400000.5, 5800000.25}));
  EXPECT_EQ(t.height_m, 8.0F);
  EXPECT_EQ(t.crown_diameter_m, 5.0F);
  EXPECT_EQ(t.foliage, Foliage::evergreen);
  EXPECT_EQ(r.source.crs.definition, "EPSG:25833");
  EXPECT_FALSE(r.source.crs.longitude_first);
  EXPECT_EQ(r.codes(), std::set<int>{});
}

TEST(Trees, OfCityGmlAreAsLargeAsTheirGeometry) {
  const std::string body = "<veg:lod1Geometry><gml:posList>10 20 5 14 20 5 14 26 12 10 26 12</gml:posList></veg:lod1Geometry>";
  const TreeReading r = read_inventory("a.gml", citygml(citygml_tree(body) + citygml_tree("<veg:height>8</veg:height>")));
  ASSERT_EQ(r.source.trees.size(), 1U);
  EXPECT_EQ(r.source.trees[0].place, (Point2d{12.0, 23.0}));
  EXPECT_EQ(r.source.trees[0].height_m, 7.0F);
  EXPECT_EQ(r.source.trees[0].crown_diameter_m, 5.0F);
  EXPECT_EQ(r.codes(), std::set<int>{111});
  EXPECT_THROW((void)read_inventory("b.gml", citygml("<veg:PlantCover/>")), InputError);
  EXPECT_THROW((void)read_inventory("c.gml", citygml_head + citygml_tree(body)), InputError);
}

const std::string cityjson_tree =
    R"("CityObjects":{"oak":{"type":"SolitaryVegetationObject","attributes":{"height":8.5,"crownDiameter":"5 m","species":"Taxus"},
    "geometry":[{"type":"GeometryInstance","template":0,"boundaries":[1],"transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]},
    "lime":{"type":"SolitaryVegetationObject","geometry":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}]},
    "meadow":{"type":"PlantCover","attributes":{"averageHeight":1}}},"vertices":[[0,0,0],[4000,0,0],[4000,6000,7000]])";

void expect_oak_and_lime(const TreeReading& r) {
  ASSERT_EQ(r.source.trees.size(), 2U);
  const std::vector<Tree> trees = r.trees();
  const Tree& oak = trees[trees[0].height_m == 8.5F ? 0 : 1];
  const Tree& lime = trees[trees[0].height_m == 8.5F ? 1 : 0];
  EXPECT_EQ(oak.place, (Point2d{400004.0, 5800000.0}));
  EXPECT_EQ(oak.crown_diameter_m, 5.0F);
  EXPECT_EQ(oak.foliage, Foliage::evergreen);
  EXPECT_EQ(lime.place, (Point2d{400002.0, 5800003.0}));
  EXPECT_EQ(lime.height_m, 7.0F);
  EXPECT_EQ(lime.crown_diameter_m, 5.0F);
  EXPECT_EQ(r.source.crs.definition, "https://www.opengis.net/def/crs/EPSG/0/25833");
  EXPECT_EQ(r.codes(), std::set<int>{});
}

TEST(Trees, OfCityJsonAreReadToo) {
  const std::string head =
      R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],"translate":[400000,5800000,0]},
      "metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/25833"},)";
  expect_oak_and_lime(read_inventory("a.city.json", head + cityjson_tree + "}"));
  std::string first = head + R"("CityObjects":{},"vertices":[]})";
  std::string second = R"({"type":"CityJSONFeature","id":"oak",)" + cityjson_tree + "}";
  for (std::string* line : {&first, &second}) std::erase(*line, '\n');
  expect_oak_and_lime(read_inventory("a.city.jsonl", first + "\n" + second + "\n"));
  EXPECT_THROW((void)read_inventory("b.city.json", head + R"("CityObjects":{},"vertices":[]})"), InputError);
  EXPECT_THROW((void)read_inventory("c.city.json", head + cityjson_tree), InputError);
}

// A crown of such a height would end where it begins, once it stands on the ground
TEST(Trees, HaveNoSizesThatAreLeftOfAZero) {
  const Tree t = only_tree(R"("height":1e-30,"crown_diameter":1e-60,"trunk_height":1e-31)");
  EXPECT_EQ(t.height_m, 10.0F);
  EXPECT_EQ(t.crown_diameter_m, 5.0F);
}

struct Inventory {
  std::string file;
  std::size_t trees;
  std::set<int> codes;
  double mean_height_m, mean_crown_m;
};

class RealInventory : public testing::TestWithParam<Inventory> {};

TEST_P(RealInventory, IsRead) {
  const Inventory& known = GetParam();
  FARLOD_NEEDS_DATA("trees/" + known.file);
  const TreeReading r = read_inventory(shared_data("trees/" + known.file));
  EXPECT_EQ(r.source.trees.size(), known.trees);
  EXPECT_EQ(r.codes(), known.codes);
  double height_m = 0.0, crown_m = 0.0;
  for (const Tree& t : r.trees()) {
    height_m += t.height_m / static_cast<double>(known.trees);
    crown_m += t.crown_diameter_m / static_cast<double>(known.trees);
  }
  EXPECT_NEAR(height_m, known.mean_height_m, 0.005);
  EXPECT_NEAR(crown_m, known.mean_crown_m, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Trees, RealInventory,
                         testing::Values(Inventory{"inv_tokyo/trees.geojson", 1107, {}, 10.127, 4.596},
                                         Inventory{"inv_honmoku/trees.geojson", 3584, {120}, 5.860, 4.777},
                                         Inventory{"inv_osm/trees.geojson", 301, {120}, 9.362, 4.681},
                                         Inventory{"inv_fitzroy/trees.csv", 1200, {120}, 15.503, 7.752},
                                         Inventory{"berlin_lidar/tree_positions_parameterized.geojson", 288, {}, 12.088, 6.876},
                                         Inventory{
                                             "berlin_lidar/crowns_convex_hull_parameterized.geojson", 288, {}, 12.088, 6.876}));

}  // namespace
}  // namespace farlod::ingest::test
