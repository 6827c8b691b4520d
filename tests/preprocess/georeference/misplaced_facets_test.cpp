// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "georeference/misplaced_facets.hpp"

namespace farlod::georeference {
namespace {

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

}  // namespace
}  // namespace farlod::georeference
