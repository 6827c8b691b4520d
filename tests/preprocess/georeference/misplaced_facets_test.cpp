// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/implausible_model.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <limits>

#include "farlod/error.hpp"
#include "georeference/crs.hpp"
#include "georeference/georeference.hpp"
#include "ingest/files/file_format.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::georeference {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double nowhere = std::numeric_limits<double>::infinity();
/// Far enough for a gap of a whole square whichever way the squares lie.
constexpr double far_away_m = 3.0 * city_square_m;

class MisplacedFacetsOf : public testing::Test {
 protected:
  void add_facet(double x, double y, double edge_m = 10.0) {
    city.begin_facet(SurfaceKind::roof, next_surface_++);
    city.add_ring(std::vector<Point3d>{{x, y, 5}, {x + edge_m, y, 5}, {x + edge_m, y + edge_m, 5}});
  }
  /// A building of so many facets at one place.
  void add_building(const std::string& id, double x, double y, int facets = 4) {
    city.begin_building(id);
    for (int n = 0; n < facets; ++n) add_facet(x, y);
  }
  /// Ids of the buildings that are left, and how many facets each still has.
  [[nodiscard]] std::vector<std::pair<std::string, std::uint32_t>> kept() const {
    std::vector<std::pair<std::string, std::uint32_t>> rows;
    CityModel rest = city;
    leave_out(rest, find_misplaced(city));
    for (const Building& b : rest.buildings()) rows.emplace_back(b.id, b.facet_count);
    return rows;
  }
  using Kept = std::vector<std::pair<std::string, std::uint32_t>>;

  CityModel city;

 private:
  std::uint32_t next_surface_ = 0;
};

TEST_F(MisplacedFacetsOf, ACityAreNone) {
  for (int n = 0; n < 30; ++n) add_building("b", 0.9 * city_square_m * n, 0.0);  // a region of 270 km without a gap
  EXPECT_TRUE(find_misplaced(city).empty());
}

TEST_F(MisplacedFacetsOf, AStrayBuildingAreAllOfItsFacets) {
  add_building("a", 0, 0);
  add_building("b", 50, 0);
  add_building("c", 100, 0);
  add_building("stray", far_away_m, 0);
  const auto misplaced = find_misplaced(city);
  ASSERT_EQ(misplaced.size(), 1U);
  EXPECT_EQ(misplaced[0].building, 3U);
  EXPECT_TRUE(misplaced[0].all_of_it);
  EXPECT_EQ(misplaced[0].first_vertex, (Point3d{far_away_m, 0, 5}));
  EXPECT_EQ(kept(), (Kept{{"a", 4}, {"b", 4}, {"c", 4}}));
}

TEST_F(MisplacedFacetsOf, ATownFarAwayAreNone) {
  for (int n = 0; n < 40; ++n) add_building("city", 20.0 * n, 0);
  for (int n = 0; n < 11; ++n) add_building("town", far_away_m + 20.0 * n, 0);
  EXPECT_TRUE(find_misplaced(city).empty());
}

TEST_F(MisplacedFacetsOf, OfTwoBuildingsFarApartNeitherIsStray) {
  add_building("a", 0, 0);
  add_building("b", far_away_m, 0);
  EXPECT_TRUE(find_misplaced(city).empty());
}

TEST_F(MisplacedFacetsOf, ABuildingThatAreElsewhereLeaveItTheOthers) {
  add_building("a", 0, 0);
  add_building("b", 50, 0);
  add_facet(far_away_m, 0);
  add_facet(nowhere, nowhere);
  add_facet(far_away_m, 0, far_away_m);  // as wide as no facet is
  EXPECT_EQ(kept(), (Kept{{"a", 4}, {"b", 4}}));
  EXPECT_FALSE(find_misplaced(city)[0].all_of_it);
}

/// With one corner elsewhere nobody knows what the building looks like.
TEST_F(MisplacedFacetsOf, ABuildingThatIsTornApartAreAllOfIt) {
  add_building("a", 0, 0);
  add_building("torn", 50, 0);
  city.begin_facet(SurfaceKind::wall, 99);
  city.add_ring(std::vector<Point3d>{{50, 0, 5}, {60, 0, 5}, {nowhere, nowhere, 5}});
  EXPECT_EQ(kept(), (Kept{{"a", 4}}));
}

class Model {
 public:
  explicit Model(std::string source = "town.city.json") {
    located_.advice = {ingest::advice_of(ingest::format_by_name(std::filesystem::path(source)))};
    located_.sources = {std::move(source)};
  }

  Model& box(Point3d low, Point3d size, HeightReference reference = HeightReference::elevation) {
    CityModel& city = located_.city;
    city.begin_building("b" + std::to_string(city.buildings().size()), reference);
    const auto at = [&](int x, int y, int z) { return low + Point3d{x * size.x, y * size.y, z * size.z}; };
    const auto add = [&](const std::vector<Point3d>& ring) {
      city.begin_facet(SurfaceKind::unknown, 0);
      city.add_ring(ring);
    };
    for (const int z : {0, 1}) add({at(0, 0, z), at(1, 0, z), at(1, 1, z), at(0, 1, z)});
    for (const int k : {0, 1}) {
      add({at(0, k, 0), at(1, k, 0), at(1, k, 1), at(0, k, 1)});
      add({at(k, 0, 0), at(k, 1, 0), at(k, 1, 1), at(k, 0, 1)});
    }
    return *this;
  }
  /// Some houses in rows, each of the same size, `step` of their width from each other.
  Model& town(int count, double width, double height, double step = 2.0) {
    for (int k = 0; k < count; ++k) box({step * width * (k % 5), step * width * (k / 5), 100}, {width, 0.8 * width, height});
    return *this;
  }
  [[nodiscard]] std::vector<int> codes() const {
    std::vector<int> codes;
    for (const Problem& p : problems()) codes.push_back(static_cast<int>(p.code));
    return codes;
  }
  [[nodiscard]] std::string detail() const {
    const auto all = problems();
    return all.empty() ? "" : all[0].detail;
  }
  [[nodiscard]] std::vector<Problem> problems() const {
    Report report;
    (void)report_implausible(located_, report);
    return report.problems();
  }
  [[nodiscard]] std::string refusal() const {
    Report report;
    return report_implausible(located_, report).value_or("");
  }

 private:
  LocatedCity located_;
};

TEST(ImplausibleModel, IsNoneOfTheLargestThatThereAre) {
  EXPECT_THAT(Model().town(20, 12, 8).codes(), IsEmpty());
  EXPECT_THAT(Model().box({}, {160, 160, 828}).codes(), IsEmpty()) << "Burj Khalifa, alone";
  EXPECT_THAT(Model().box({}, {1500, 500, 45}).codes(), IsEmpty()) << "a factory or a terminal";
  EXPECT_THAT(Model().box({}, {38'000, 12, 60}).codes(), IsEmpty()) << "a bridge";
  EXPECT_THAT(Model().box({}, {9'000, 8, 14}).codes(), IsEmpty()) << "a city wall, an aqueduct";
  EXPECT_THAT(Model().town(12, 60, 380).codes(), IsEmpty()) << "a quarter of towers alone";
  EXPECT_THAT(Model().box({}, {0.8, 0.8, 20}).codes(), IsEmpty()) << "a mast";
}

TEST(ImplausibleModel, CountsInAnotherUnit) {
  EXPECT_THAT(Model().town(1, 8000, 7000).detail(),
              AllOf(HasSubstr("7000 m"), HasSubstr("in millimetres"), HasSubstr("\"transform\"")));
  EXPECT_THAT(Model().town(20, 1200, 800).detail(), AllOf(HasSubstr("in centimetres"), HasSubstr("12 m wide and 8 m high")));
  EXPECT_THAT(Model("a.obj").town(20, 0.012, 0.008).detail(),
              AllOf(HasSubstr("in kilometres"), HasSubstr("OBJ is read in metres")));
  EXPECT_THAT(
      Model("a.gml").town(20, 12, 800).detail(),
      AllOf(HasSubstr("are heights in centimetres? A typical one would be 8 m high. Convert"), HasSubstr("name the CRS")));
  for (const Model& model : {Model().town(1, 8000, 7000), Model().town(20, 1200, 800), Model().town(3, 0.012, 0.008)})
    EXPECT_THAT(model.codes(), ElementsAre(208));
}

TEST(ImplausibleModel, IsRefusedWhereNearlyAllBuildingsAreImpossible) {
  EXPECT_THAT(Model().town(1, 8000, 7000).refusal(),
              AllOf(HasSubstr("no building is this large"), HasSubstr("8000 m wide"), HasSubstr("\"scale\" of 0.001")));
  EXPECT_NE(Model().town(9, 8000, 2500, 1.1).box({}, {900, 900, 900}).refusal(), "") << "huts of 90 cm in millimetres";
  EXPECT_EQ(Model().town(3, 12, 8).box({}, {9'000, 2'000, 1'900}).refusal(), "") << "a mountain behind houses";
  EXPECT_EQ(Model().town(20, 1200, 800).refusal(), "") << "centimetres are told";
  EXPECT_EQ(Model().box({}, {38'000, 12, 60}).refusal(), "") << "a bridge alone";
  EXPECT_EQ(Model().box({}, {9'000, 9'000, 1'100}).refusal(), "") << "the mesh of a town between hills";
  EXPECT_EQ(Model().box({}, {12, 9, 9'900}).refusal(), "") << "one wrong vertex of the only building";
}

TEST(ImplausibleModel, HasOneSlip) {
  const Model model = Model().town(20, 12, 8).box({300, 0, 100}, {12, 9, 9'900});
  EXPECT_THAT(model.detail(),
              AllOf(HasSubstr("1 of 21 buildings"), HasSubstr("such as b20, 9900 m high"), HasSubstr("vertices wrong")));
  ASSERT_EQ(model.problems().size(), 1U);
  EXPECT_EQ(model.problems()[0].position->z, 10'000.0);
  EXPECT_EQ(model.problems()[0].place, "the whole file");
}

TEST(ImplausibleModel, LooksAtNoHeightThatIsNotKnownYet) {
  EXPECT_THAT(Model().box({}, {12, 9, 2600}, HeightReference::down_to_ground).codes(), IsEmpty());
}

TEST(ImplausibleModel, LiesOnItsSide) {
  Model town("a.obj"), slope, row;
  for (int k = 0; k < 100; ++k) {
    const double x = 40.0 * (k % 10), depth = 40.0 * (k / 10);
    town.box({x, 0, depth}, {12, 8, 10});
    slope.box({x, depth, 0.25 * depth}, {12, 10, 8});
    if (k < 12) row.box({25.0 * k, 0, 5.0 * k}, {12, 10, 8});
  }
  EXPECT_THAT(town.codes(), ElementsAre(209));
  EXPECT_THAT(town.detail(), AllOf(HasSubstr("lie on its side"), HasSubstr("Give --up y")));
  EXPECT_THAT(slope.codes(), IsEmpty()) << "a town on a slope of one in four";
  EXPECT_THAT(row.codes(), IsEmpty()) << "a row of houses on a slope of one in five";
}

constexpr Point2d origin_m{400000.0, 5500000.0};

/// Trees some metres or some ten thousandths of a degree apart.
SourceTrees inventory(const std::string& crs, Point2d first, Point2d step) {
  SourceTrees trees{"trees.geojson", {crs, true, true}, {}};
  for (int n = 0; n < 5; ++n) {
    Tree tree;
    tree.place = first + static_cast<double>(n) * step;
    trees.trees.push_back(tree);
  }
  return trees;
}
SourceTrees in_degrees(const std::string& crs) { return inventory(crs, {7.62, 49.645}, {1e-4, 1e-4}); }
SourceTrees in_metres(const std::string& crs) { return inventory(crs, {400100.0, 5500200.0}, {9.0, 9.0}); }

struct Located {
  SourceTrees trees;
  Report report;

  Located(SourceTrees source, const std::string& fallback) : trees(std::move(source)) {
    locate_trees(trees, fallback, georeference_around(origin_m, *Crs::find("EPSG:25832")), report);
  }
  [[nodiscard]] Point2d first() const { return trees.trees[0].place; }
  [[nodiscard]] std::vector<int> codes() const {
    std::vector<int> codes;
    for (const Problem& problem : report.problems()) codes.push_back(static_cast<int>(problem.code));
    return codes;
  }
};

TEST(TreePlaces, OfTheOutputCrsAreKept) {
  for (const std::string fallback : {"", "EPSG:25832"}) {
    EXPECT_EQ(Located(in_metres("EPSG:25832"), fallback).first(), (Point2d{100.0, 200.0}));
    EXPECT_EQ(Located(in_metres(""), fallback).first(), (Point2d{100.0, 200.0})) << "a file that says none";
  }
}

TEST(TreePlaces, AreProjected) {
  // 7.62° E, 49.645° N in UTM 32: from PROJ's cs2cs
  const Located located(in_degrees("EPSG:4326"), "");
  EXPECT_NEAR(located.first().x + origin_m.x, 400372.0, 50.0);
  EXPECT_NEAR(located.first().y + origin_m.y, 5500000.0, 400.0);
  EXPECT_EQ(Located(in_degrees(""), "EPSG:4326").first(), located.first());
  EXPECT_TRUE(located.report.problems().empty());
}

TEST(TreePlaces, AxesInTheOtherOrderAreTold) {
  SourceTrees swapped = in_degrees("EPSG:4326");
  for (Tree& tree : swapped.trees) tree.place = {tree.place.y, tree.place.x};
  const Located located(swapped, "");
  EXPECT_EQ(located.codes(), std::vector<int>{202});
  EXPECT_EQ(located.first(), Located(in_degrees("EPSG:4326"), "").first());
  EXPECT_TRUE(located.report.problems()[0].lon_lat_deg.has_value());
}

TEST(TreePlaces, GeoJsonInMetresNeedsACrs) {
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)Located(in_metres("EPSG:4326"), ""); }), HasSubstr("cannot be degrees"));
  const Located located(in_metres("EPSG:4326"), "EPSG:25832");
  EXPECT_EQ(located.codes(), std::vector<int>{203});
  EXPECT_EQ(located.first(), (Point2d{100.0, 200.0}));
}

TEST(TreePlaces, DegreesWithoutANameAreRefused) {
  EXPECT_THROW((void)Located(in_degrees(""), ""), InputError);
  EXPECT_THROW((void)Located(in_degrees("EPSG:25832"), ""), InputError);
}

TEST(TreePlaces, UnknownCrsNeedsAnother) {
  EXPECT_THROW((void)Located(in_metres("no such thing"), ""), InputError);
  EXPECT_THROW((void)Located(in_metres(""), "no such thing"), InputError);
  EXPECT_EQ(Located(in_metres("no such thing"), "EPSG:25832").codes(), std::vector<int>{204});
}

TEST(TreePlaces, ThoseWithoutAPlaceAreLeftOutTogether) {
  SourceTrees trees = in_degrees("EPSG:4326");
  Tree lost;
  lost.place = {-170.0, 95.0};
  trees.trees.push_back(lost);
  trees.trees.push_back(lost);
  const Located located(trees, "");
  EXPECT_EQ(located.trees.trees.size(), 5U);
  EXPECT_EQ(located.codes(), std::vector<int>{210});
  EXPECT_THAT(located.report.problems()[0].detail, HasSubstr("2 of 7 trees"));
  EXPECT_FALSE(located.report.problems()[0].position);
}

}  // namespace
}  // namespace farlod::georeference
