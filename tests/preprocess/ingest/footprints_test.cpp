// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "city/city_model.hpp"
#include "farlod/error.hpp"
#include "ingest/footprints/footprint_reader.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
namespace {

const std::string square = "[[[0,0],[4,0],[4,4],[0,4],[0,0]]]";
// The hole runs the same way round as the outer ring: files do not agree on this
const std::string court = "[[[0,0],[0,4],[4,4],[4,0],[0,0]],[[1,1],[1,3],[3,3],[3,1],[1,1]]]";

/// The volume under the outward normals (divergence theorem).
double volume(const CityModel& city) {
  double sum = 0.0;
  for (const Facet& f : city.facets())
    for (std::uint32_t k = 0; k < f.ring_count; ++k) {
      const auto ring = city.ring(f, k);
      for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += dot(ring[0], cross(ring[i], ring[i + 1]));
    }
  return sum / 6.0;
}

Reading read_features(const std::vector<std::string>& features, const IngestSettings& settings = {}) {
  return read_text("a.geojson", collection(features), settings);
}

TEST(Footprints, SayHowManyHeightsWereNotMeasured) {
  IngestSettings settings;
  settings.footprints.default_height_m = 5.0;
  settings.footprints.floor_height_m = 2.5;
  const Reading r = read_features({feature(R"("height":3)", "Polygon", square), feature(R"("levels":4)", "Polygon", square),
                                   feature(R"("levels":2)", "Polygon", square), feature("", "Polygon", square)},
                                  settings);
  ASSERT_EQ(r.source.notes.size(), 2u);
  EXPECT_TRUE(r.source.notes[0].ends_with("a.geojson: 2 heights are storeys of 2.5 m")) << r.source.notes[0];
  EXPECT_TRUE(r.source.notes[1].ends_with("a.geojson: 1 heights are the default height")) << r.source.notes[1];
  EXPECT_TRUE(read_features({feature(R"("height":3)", "Polygon", square)}).source.notes.empty());
}

TEST(Footprints, SayThatHeightsCountBeforeTheStoreysThatAreAskedFor) {
  const std::vector<std::string> features{feature(R"("height":3,"n":2)", "Polygon", square),
                                          feature(R"("height":9,"n":4)", "Polygon", square),
                                          feature(R"("height":null,"n":4)", "Polygon", square)};
  IngestSettings settings;
  settings.footprints.storeys_field = "n";
  const Reading r = read_features(features, settings);
  ASSERT_EQ(r.source.notes.size(), 2u);
  EXPECT_TRUE(r.source.notes[0].ends_with("1 heights are storeys of 3 m")) << r.source.notes[0];
  EXPECT_TRUE(r.source.notes[1].ends_with("2 heights are of the field height, which counts before the storeys of n"))
      << r.source.notes[1];
}

TEST(Footprints, BecomePrismsThatFaceOutwards) {
  const Reading r = read_features({feature(R"("height":3)", "Polygon", square)});
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(surface_count(r.city()), 6u);
  EXPECT_EQ(volume(r.city()), 48.0);
  for (const Facet& f : r.city().facets()) {
    const Point3d n = double_area_vector(r.city(), f);
    EXPECT_EQ(kind_of_normal(normalized(n)), f.kind);
  }
  EXPECT_EQ(r.city().buildings()[0].height_reference, HeightReference::on_ground);
  EXPECT_TRUE(r.source.crs.longitude_first);
  EXPECT_TRUE(r.source.crs.heights_in_metres);
  EXPECT_NE(r.source.crs.definition.find("WGS 84"), std::string::npos);
}

TEST(Footprints, HolesGetWallsTooWhicheverWayTheyRun) {
  const Reading r = read_features({feature(R"("height":2)", "Polygon", court)});
  EXPECT_EQ(surface_count(r.city()), 10u);
  EXPECT_EQ(volume(r.city()), (16.0 - 4.0) * 2.0);
}

TEST(Footprints, AFeatureOfSeveralPolygonsIsOneBuildingWithParts) {
  const Reading r = read_features({feature(R"("height":2)", "MultiPolygon", "[" + square + ",[[[9,0],[10,0],[10,1],[9,0]]]]")});
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.city().facets().front().part, 0);
  EXPECT_EQ(r.city().facets().back().part, 1);
  EXPECT_EQ(surface_count(r.city()), 11u);
}

TEST(Footprints, TheBaseComesFromItsOwnField) {
  IngestSettings settings;
  settings.footprints = {.height_field = "h", .base_field = "ground"};
  const Reading r = read_features({feature(R"("h":"10 ft","ground":100)", "Polygon", square)}, settings);
  EXPECT_EQ(r.city().buildings()[0].height_reference, HeightReference::elevation);
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[0].z, 100.0 + 10.0 * 0.3048);
}

TEST(Footprints, ADefaultHeightServesThoseWithoutOne) {
  IngestSettings settings;
  settings.footprints.default_height_m = 7.0;
  const Reading r = read_features({feature("", "Polygon", square), feature(R"("height":3)", "Polygon", square)}, settings);
  EXPECT_EQ(r.city().buildings().size(), 2u);
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[0].z, 7.0);
  EXPECT_TRUE(r.codes().empty());
}

TEST(Footprints, IdsComeFromTheTableOrAreNumbers) {
  const Reading r =
      read_features({feature(R"("height":3,"@id":"way/7")", "Polygon", square), feature(R"("height":3)", "Polygon", square)});
  EXPECT_EQ(r.city().buildings()[0].id, "way/7");
  EXPECT_EQ(r.city().buildings()[1].id, "1");
}

TEST(Footprints, ElevationsOfVerticesAreIgnored) {
  const Reading r = read_features({feature(R"("height":3)", "Polygon", "[[[0,0,50],[4,0,51],[4,4,52],[0,0,50]]]")});
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[0].z, 3.0);
}

TEST(Footprints, ATableWithoutHeightsNamesItsNumbers) {
  const std::filesystem::path file =
      write_file("a.geojson", collection({feature(R"("rooms":3,"area":"4.5","use":"school")", "Polygon", square)}));
  for (const FootprintSettings& footprints : {FootprintSettings{}, FootprintSettings{.height_field = "TAKASA"}}) {
    IngestSettings settings;
    settings.footprints = footprints;
    const std::string refusal = scenes::refusal_of<InputError>([&] { (void)read_file(file, settings); });
    EXPECT_NE(refusal.find("rooms, area"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("--height-field"), std::string::npos) << refusal;
    EXPECT_EQ(refusal.find("use"), std::string::npos) << refusal;
  }
}

TEST(Footprints, StoreysServeThoseWithoutAHeight) {
  IngestSettings settings;
  settings.footprints.floor_height_m = 3.25;
  const Reading r = read_features({feature(R"("height":"17.5 m","building:levels":"9")", "Polygon", square),
                                   feature(R"("height":null,"building:levels":"4")", "Polygon", square),
                                   feature(R"("height":null,"building:levels":null)", "Polygon", square)},
                                  settings);
  ASSERT_EQ(r.city().buildings().size(), 2u);
  EXPECT_EQ(r.city().points_of(r.city().buildings()[0])[0].z, 17.5);
  EXPECT_EQ(r.city().points_of(r.city().buildings()[1])[0].z, 13.0);
  EXPECT_EQ(r.codes(), std::set<int>{107});
  EXPECT_EQ(r.report.problems()[0].detail, "height is empty, building:levels is empty");
}

TEST(Footprints, FieldsThatAreAskedForMustBeThere) {
  const std::filesystem::path file = write_file("a.geojson", collection({feature(R"("height":3)", "Polygon", square)}));
  IngestSettings storeys, roof;
  storeys.footprints.storeys_field = roof.footprints.roof_field = "nowhere";
  for (const auto& [settings, option] : {std::pair(storeys, "--storeys-field"), std::pair(roof, "--roof-field")}) {
    const std::string refusal = scenes::refusal_of<InputError>([&, &given = settings] { (void)read_file(file, given); });
    EXPECT_NE(refusal.find(option), std::string::npos) << refusal;
  }
}

TEST(Footprints, OfWhichOnlyTheRoofIsKnownReachDownToTheGround) {
  IngestSettings settings;
  settings.footprints.roof_field = "roof";
  const Reading r = read_features({feature(R"("roof":"412,5")", "Polygon", court)}, settings);
  EXPECT_EQ(r.city().buildings()[0].height_reference, HeightReference::down_to_ground);
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[0].z, 412.5);
}

/// The sides of a cube with an edge of 2e-5°, which is about 2 m, at 100 m.
std::string cube_sides() {
  const auto at = [](int corner) {
    return "[" + std::string(corner & 1 ? "8.40002" : "8.4") + "," + (corner & 2 ? "49.00002" : "49.0") + "," +
           (corner & 4 ? "102" : "100") + "]";
  };
  std::string sides;
  for (const auto& side : std::vector<std::vector<int>>{
           {0, 2, 3, 1, 0}, {4, 5, 7, 6, 4}, {0, 1, 5, 4, 0}, {1, 3, 7, 5, 1}, {3, 2, 6, 7, 3}, {2, 0, 4, 6, 2}}) {
    std::string ring;
    for (const int corner : side) ring += (ring.empty() ? "" : ",") + at(corner);
    sides += (sides.empty() ? "[[" : ",[[") + ring + "]]";
  }
  return "[" + sides + "]";
}

TEST(Footprints, BodiesInSpaceStandAsTheyAre) {
  const Reading r = read_features({feature(R"("name":"cube")", "MultiPolygon", cube_sides())});
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.city().buildings()[0].height_reference, HeightReference::elevation);
  EXPECT_EQ(r.city().facets().size(), 6u);
  EXPECT_FALSE(r.source.crs.heights_in_metres);
  for (const Point3d& p : r.city().points()) EXPECT_TRUE(p.z == 100 || p.z == 102);
}

TEST(Footprints, SurfacesOfFacesAreBodiesToo) {
  const std::string tetrahedron =
      "((0 0 5,0 8 5,8 0 5,0 0 5)),((0 0 5,8 0 5,0 0 9,0 0 5)),((8 0 5,0 8 5,0 0 9,8 0 5)),((0 8 5,0 0 5,0 0 9,0 8 5))";
  for (const char* type : {"TIN", "POLYHEDRALSURFACE", "MULTIPOLYGON"}) {
    const Reading r =
        read_text(std::string(type) + ".csv", "WKT,name\n\"" + std::string(type) + " Z (" + tetrahedron + ")\",x\n");
    EXPECT_EQ(r.city().facets().size(), 4u) << type;
    EXPECT_EQ(volume(r.city()), 8.0 * 8.0 * 4.0 / 6.0) << type;
  }
}

TEST(Footprints, DrapedOverTheTerrainAreNoBodies) {
  const std::string draped =
      "[[[[8.4,49,50],[8.4001,49,53],[8.4001,49.0001,55],[8.4,49,50]]],"
      "[[[8.41,49,50],[8.4101,49,51],[8.4101,49.0001,52],[8.41,49,50]]]]";
  const Reading r = read_features({feature(R"("height":3)", "MultiPolygon", draped)});
  EXPECT_EQ(r.city().buildings()[0].height_reference, HeightReference::on_ground);
  EXPECT_EQ(r.city().facets().size(), 10u);
  // A hut of 1 m on a cliff is steep, but still a footprint: one polygon makes no body
  const std::string hut = "[[[8.4,49,50],[8.40001,49,50],[8.40001,49.00001,57],[8.4,49,50]]]";
  const Reading cliff = read_text("b.geojson", collection({feature(R"("height":3)", "Polygon", hut)}));
  EXPECT_EQ(cliff.city().facets().size(), 5u);
}

TEST(Footprints, AreNotMixedWithBodies) {
  std::vector<std::string> features(100, feature(R"("height":3)", "Polygon", square));
  features.push_back(feature(R"("height":3,"id":"cube")", "MultiPolygon", cube_sides()));
  const Reading r = read_features(features);
  EXPECT_EQ(r.city().buildings().size(), 100u);
  ASSERT_EQ(r.report.count(ProblemCode::unsupported_geometry), 1u);
}

TEST(Footprints, HeightsInAllNotations) {
  EXPECT_EQ(length_m_from("17.5"), 17.5);
  EXPECT_EQ(length_m_from(" 17,5 m "), 17.5);
  EXPECT_EQ(length_m_from("57 ft"), 57 * 0.3048);
  EXPECT_EQ(length_m_from("57'"), 57 * 0.3048);
  EXPECT_EQ(length_m_from("10'6\""), 10.5 * 0.3048);
  EXPECT_EQ(length_m_from("-3"), -3.0);
  for (const char* text : {"", "high", "10-12", "10 storeys", "1.2.3", "nan", "inf", "5 6", "10'x"})
    EXPECT_EQ(length_m_from(text), std::nullopt) << text;
}

constexpr double foot_m = 0.3048;

/// One feature of a table: what its fields say, texts or numbers.
struct Feature {
  std::vector<std::pair<std::string, FieldValue>> fields;

  Feature& text(const std::string& name, const std::string& value) {
    fields.push_back({name, {std::nullopt, value, true}});
    return *this;
  }
  Feature& number(const std::string& name, double value) {
    fields.push_back({name, {value, {}, true}});
    return *this;
  }
  Feature& empty(const std::string& name) {
    fields.push_back({name, {}});
    return *this;
  }
  [[nodiscard]] std::variant<PrismExtent, Unraised> asked(const FootprintSettings& settings = {}) const {
    std::vector<std::string> names;
    for (const auto& [name, value] : fields) names.push_back(name);
    return FootprintHeights(names, settings).of([&](std::size_t field) { return fields[field].second; });
  }
  [[nodiscard]] PrismExtent extent(const FootprintSettings& settings = {}) const {
    const auto answer = asked(settings);
    EXPECT_TRUE(std::holds_alternative<PrismExtent>(answer)) << std::get<Unraised>(answer).detail;
    return std::get<PrismExtent>(answer);
  }
  [[nodiscard]] Unraised reason(const FootprintSettings& settings = {}) const {
    const auto answer = asked(settings);
    EXPECT_TRUE(std::holds_alternative<Unraised>(answer));
    return std::get<Unraised>(answer);
  }
};

TEST(FootprintHeights, AreTrustedInOneOrder) {
  FootprintSettings settings{.height_field = "Survey", .storeys_field = "Flats", .default_height_m = 5.0};
  Feature all =
      Feature().number("flats", 4).number("levels", 8).number("height", 20).number("building:height", 30).number("survey", 40);
  EXPECT_EQ(all.extent(settings).top_m, 40.0);
  // One after the other falls silent
  for (const auto& [silent, next_m] : std::vector<std::pair<std::string, double>>{
           {"survey", 30}, {"building:height", 20}, {"height", 4 * 3.0}, {"flats", 8 * 3.0}, {"levels", 5}}) {
    for (auto& [name, value] : all.fields)
      if (name == silent) value = {};
    EXPECT_EQ(all.extent(settings).top_m, next_m) << silent;
  }
  settings.default_height_m.reset();
  EXPECT_EQ(all.reason(settings).code, ProblemCode::no_height);
}

TEST(FootprintHeights, AFieldThatIsNamedForSomethingIsThatAlone) {
  EXPECT_EQ(Feature().number("Height", 4).extent({.storeys_field = "height"}).top_m, 12.0);
  EXPECT_EQ(Feature().number("height", 4).number("hoehe", 7).extent({.storeys_field = "height"}).top_m, 7.0);
  EXPECT_EQ(Feature().text("levels", "").number("height", 7).extent({.height_field = "levels"}).top_m, 7.0);
  EXPECT_EQ(Feature().number("levels", 9000).reason({.height_field = "levels"}).code, ProblemCode::absurd_height)
      << "no storeys of that name are left";
}

TEST(FootprintHeights, ATextThatIsNoLengthSaysNothing) {
  const Feature feature = Feature().text("height", "high").text("building:levels", "3");
  EXPECT_EQ(feature.extent().top_m, 9.0);
  EXPECT_EQ(Feature().text("height", "").text("building:levels", "1-3").reason().code, ProblemCode::no_height);
  EXPECT_EQ(Feature().number("height", std::numeric_limits<double>::quiet_NaN()).number("floors", 1).extent().top_m, 3.0);
}

TEST(FootprintHeights, StoreysAreAsHighAsToldAndThoseOfTheRoofCount) {
  FootprintSettings settings{.floor_height_m = 3.5};
  EXPECT_EQ(Feature().text("Building:Levels", "4").text("roof:levels", "2").extent(settings).top_m, 21.0);
  EXPECT_EQ(Feature().text("num_floors", "4").text("roof:levels", "2").extent(settings).top_m, 14.0) << "it counts them all";
  EXPECT_FALSE(FootprintHeights({"roof:levels", "name"}, settings).can_tell());
  EXPECT_TRUE(FootprintHeights({"name", "NUM_FLOORS"}, settings).can_tell());
}

TEST(FootprintHeights, AColumnsNameMayTellFeet) {
  FootprintSettings settings{.height_field = "roof_FT"};
  EXPECT_EQ(Feature().number("roof_ft", 100).extent(settings).top_m, 100 * foot_m);
  EXPECT_EQ(Feature().text("roof_ft", "100").extent(settings).top_m, 100 * foot_m);
  EXPECT_EQ(Feature().text("roof_ft", "30 m").extent(settings).top_m, 30.0);
  EXPECT_EQ(Feature().number("height_feet", 10).extent().top_m, 10 * foot_m);
  settings.height_field = "loft";
  EXPECT_EQ(Feature().number("loft", 100).extent(settings).top_m, 100.0);
}

TEST(FootprintHeights, APartThatHangsBeginsAboveItsBase) {
  const PrismExtent arch = Feature().number("height", 20).text("min_height", "12 m").extent();
  EXPECT_EQ(arch.base_m, 12.0);
  EXPECT_EQ(arch.top_m, 20.0);
  EXPECT_EQ(arch.height_reference, HeightReference::on_ground);
  EXPECT_EQ(Feature().text("building:levels", "5").text("building:min_level", "4").extent().base_m, 12.0);
  EXPECT_EQ(Feature().text("building:levels", "5").text("min_level", "1").extent().base_m, 0.0);
  EXPECT_EQ(Feature().number("height", 9).number("min_height", -3).extent().base_m, 0.0);
  EXPECT_EQ(Feature().number("height", 9).number("min_height", 9).reason().code, ProblemCode::height_not_positive);
  FootprintSettings settings{.base_field = "ground"};
  EXPECT_EQ(Feature().number("height", 20).number("min_height", 12).number("ground", 100).extent(settings).base_m, 112.0);
}

TEST(FootprintHeights, ARoofsElevationCountsFromTheBaseOrReachesDown) {
  FootprintSettings settings{.roof_field = "eaves"};
  const PrismExtent free = Feature().number("eaves", 120).number("height", 7).extent(settings);
  EXPECT_EQ(free.top_m, 120.0);
  EXPECT_EQ(free.base_m, 120.0 - provisional_height_m);
  EXPECT_EQ(free.height_reference, HeightReference::down_to_ground);
  EXPECT_EQ(Feature().empty("eaves").number("height", 7).extent(settings).top_m, 7.0);
  settings.base_field = "ground";
  const PrismExtent held = Feature().number("eaves", 120).number("ground", 100).extent(settings);
  EXPECT_EQ(held.base_m, 100.0);
  EXPECT_EQ(held.top_m, 120.0);
  EXPECT_EQ(held.height_reference, HeightReference::elevation);
  EXPECT_EQ(Feature().number("eaves", 99).number("ground", 100).reason(settings).code, ProblemCode::height_not_positive);
  EXPECT_EQ(Feature().number("eaves", 120).empty("ground").reason(settings).code, ProblemCode::no_height);
}

TEST(FootprintHeights, NumbersThatNoBuildingHasAreAbsurd) {
  for (const double absurd : {-9999.0, 9999.0, 99999.0, highest_building_m + 0.5})
    EXPECT_EQ(Feature().number("height", absurd).reason().code, ProblemCode::absurd_height) << absurd;
  EXPECT_EQ(Feature().number("height", highest_building_m).extent().top_m, highest_building_m);
  for (const double low : {0.0, -3.0})
    EXPECT_EQ(Feature().number("height", low).reason().code, ProblemCode::height_not_positive) << low;
  EXPECT_EQ(Feature().number("levels", 0).reason().code, ProblemCode::height_not_positive);
  EXPECT_EQ(Feature().number("levels", 9999).reason().code, ProblemCode::absurd_height);
}

TEST(FootprintHeights, ElevationsAreThoseOfTheEarth) {
  FootprintSettings settings{.roof_field = "roof"};
  EXPECT_EQ(Feature().number("roof", 4150).extent(settings).top_m, 4150.0);  // El Alto
  for (const double absurd : {-9999.0, highest_elevation_m + 1, lowest_elevation_m - 1})
    EXPECT_EQ(Feature().number("roof", absurd).reason(settings).code, ProblemCode::absurd_height) << absurd;
  settings.base_field = "ground";
  EXPECT_EQ(Feature().number("roof", 20).number("ground", -9999).reason(settings).code, ProblemCode::absurd_height);
  EXPECT_EQ(Feature().empty("roof").number("height", 9).number("ground", -9999).reason(settings).code,
            ProblemCode::absurd_height);
  EXPECT_EQ(Feature().number("roof", 3000).number("ground", 10).reason(settings).code, ProblemCode::absurd_height);
}

TEST(FootprintHeights, OfEqualNamesTheFirstCounts) {
  EXPECT_EQ(Feature().number("Height", 7).number("HEIGHT", 9).extent().top_m, 7.0);
}

TEST(FootprintHeights, ReasonsSayWhatTheTableSays) {
  EXPECT_EQ(Feature().text("height", "high").empty("levels").reason().detail, "height is \"high\", levels is empty");
  EXPECT_EQ(Feature().number("height", -3).reason().detail, "height is -3");
}

TEST(HeightText, ReadsWhatPeopleWrite) {
  EXPECT_EQ(length_m_from("~12"), 12.0);
  EXPECT_EQ(length_m_from(" ~ 12 m"), 12.0);
  EXPECT_EQ(length_m_from("56 ft"), 56 * foot_m);
  EXPECT_EQ(length_m_from("56", LengthUnit::foot), 56 * foot_m);
  EXPECT_EQ(length_m_from("10-12"), std::nullopt);
  EXPECT_EQ(length_m_from("~"), std::nullopt);
  EXPECT_EQ(number_from("2,5"), 2.5);
  EXPECT_EQ(number_from("~3 "), 3.0);
  for (const char* text : {"", "3 m", "2;3", "1-3", "three"}) EXPECT_EQ(number_from(text), std::nullopt) << text;
}

}  // namespace
}  // namespace farlod::ingest::test
