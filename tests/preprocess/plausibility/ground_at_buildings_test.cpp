// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "plausibility/ground_at_buildings.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "farlod/error.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::plausibility {
namespace {

using scenes::refusal_of;
using testing::HasSubstr;
using testing::IsEmpty;

using GroundAt = std::function<double(Point2d)>;

/// Where buildings of 12 m stand, 30 m from one to the next.
bool is_in_a_building(Point2d p) {
  return p.x - 30.0 * std::floor(p.x / 30.0) < 12.0 && p.y - 30.0 * std::floor(p.y / 30.0) < 12.0;
}

/// Buildings in rows of four, of which only the roofs are drawn, at this height above 500 m; each eighth at another one.
LocatedCity town(int count, double height_m, HeightReference reference = HeightReference::elevation,
                 std::optional<double> height_of_eighths_m = {}) {
  LocatedCity located;
  located.sources = {"town.gml"};
  for (int n = 0; n < count; ++n) {
    const double x = 30.0 * (n % 4), y = 30.0 * (n / 4),
                 z = 500.0 + (n % 8 == 3 ? height_of_eighths_m.value_or(height_m) : height_m);
    located.city.begin_building("house", reference);
    located.city.begin_facet(SurfaceKind::roof, 0);
    located.city.add_ring(std::array<Point3d, 4>{Point3d{x, y, z}, {x + 12.0, y, z}, {x + 12.0, y + 12.0, z}, {x, y + 12.0, z}});
  }
  return located;
}

SurveyedGround raster(const GroundAt& ground_m) { return {ground_m, {{-1e5, -1e5}, {1e5, 1e5}}, true}; }

std::string refusal_of_ground(const LocatedCity& city, const GroundAt& ground_m) {
  return refusal_of<InputError>([&] { require_ground_without_roofs(city, raster(ground_m)); });
}

TEST(GroundWithRoofs, IsRefusedOnSlopesToo) {
  for (const double slope : {0.0, 0.1, 0.3}) {
    const GroundAt surface_m = [=](Point2d p) { return 500.0 + slope * p.x + (is_in_a_building(p) ? 9.0 : 0.0); };
    EXPECT_THAT(refusal_of_ground(town(8, 9.0), surface_m),
                HasSubstr("nearly all of the 8 buildings stand on a bump of their own "
                          "size, of typically 9.0 m"));
  }
}

TEST(GroundWithRoofs, IsNoGroundThatSlopesOrHasAFewMounds) {
  const LocatedCity city = town(16, 9.0);
  const auto is_told = [&](const GroundAt& ground_m) {
    Report report;
    require_ground_without_roofs(city, raster(ground_m));
    return !report.problems().empty();
  };
  EXPECT_FALSE(is_told([](Point2d p) { return 500.0 + 0.5 * p.x + 0.3 * p.y; }));
  EXPECT_FALSE(is_told([](Point2d p) { return 500.0 + (is_in_a_building(p) ? 1.5 : 0.0); })) << "plinths";
  EXPECT_FALSE(is_told([](Point2d p) { return 500.0 + (is_in_a_building(p) && p.x < 60.0 ? 9.0 : 0.0); })) << "half of them";
  EXPECT_FALSE(is_told([](Point2d p) { return 500.0 + 10.0 * std::sin(p.x / 40.0); })) << "hills of many houses";
}

/// What is told of roofs without bases, above ground of this height.
std::string told(int count, double height_m, double ground_m) {
  Report report;
  report_roofs(town(count, height_m, HeightReference::down_to_ground), raster([=](Point2d) { return ground_m; }), report);
  return report.problems().empty() ? "" : report.problems().front().detail;
}

TEST(RoofsWithoutBases, AreToldFarAboveTheGround) {
  EXPECT_THAT(told(8, 12.0, 454.4), HasSubstr("all roofs are 30 m and more above the ground, typically 57.6 m"));
  EXPECT_THAT(told(8, 12.0, 495.0), IsEmpty());
  EXPECT_THAT(told(7, 40.0, 500.0), IsEmpty()) << "a few towers";
}

TEST(RoofsWithoutBases, AreRefusedBelowTheGround) {
  EXPECT_THAT(refusal_of<InputError>([] { (void)told(8, 12.0, 545.6); }),
              HasSubstr("town.gml: the roofs of most buildings are below the ground, typically 33.6 m"));
}

TEST(RoofsWithoutBases, AreToldWhereATenthIsBelowTheGround) {
  const auto told_with_eighths = [](double height_m, int count) {
    Report report;
    report_roofs(town(count, 9.0, HeightReference::down_to_ground, height_m), raster([](Point2d) { return 500.0; }), report);
    return report.problems().empty() ? "" : report.problems().front().detail;
  };
  EXPECT_THAT(told_with_eighths(-1.0, 16), HasSubstr("a tenth of the roofs and more are below the ground, typically 9.0 m"));
  EXPECT_THAT(told_with_eighths(2.2, 16), IsEmpty()) << "sheds";
  EXPECT_THAT(told_with_eighths(-1.0, 11), IsEmpty()) << "one of eleven";
}

}  // namespace
}  // namespace farlod::plausibility
