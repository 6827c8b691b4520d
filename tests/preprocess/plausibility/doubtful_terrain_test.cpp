// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "plausibility/doubtful_terrain.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "farlod/error.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::plausibility {
namespace {

using scenes::refusal_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

using HeightAt = std::function<double(Point2d)>;

/// Rows of eight houses of 12 m, 30 m from one to the next, with their bases at these heights.
LocatedCity town(const HeightAt& base_m, HeightReference reference = HeightReference::elevation) {
  LocatedCity located;
  located.sources = {"town.gml"};
  for (int n = 0; n < 64; ++n) {
    const double x = 30.0 * (n % 8), y = 30.0 * (n / 8);
    const double z = base_m({x + 6.0, y + 6.0});
    located.city.begin_building("house", reference);
    located.city.begin_facet(SurfaceKind::ground, 0);
    located.city.add_ring(std::array<Point3d, 4>{Point3d{x, y, z}, {x + 12.0, y, z}, {x + 12.0, y + 12.0, z}, {x, y + 12.0, z}});
  }
  return located;
}

/// What is told of the town above this ground, or why it is refused.
std::string told(const LocatedCity& city, const HeightAt& ground_m) {
  const SurveyedGround ground{ground_m, {{-1e5, -1e5}, {1e5, 1e5}}, true, 0.0, "dtm.tif"};
  Report report;
  const std::string refusal = refusal_of<InputError>([&] {
    report_standing(city, ground, report);
    throw InputError("");
  });
  std::string details = refusal;
  for (const Problem& p : report.problems())
    details += "\n" + std::to_string(static_cast<int>(p.code)) + " " + p.source + ": " + p.detail;
  return details;
}

double hills_m(Point2d p) { return 0.4 + 1.5 * std::sin(0.01 * p.x) + 0.02 * p.y; }
/// Cellars and plinths.
double rough_m(Point2d p) { return hills_m(p) + 0.4 * std::sin(7.0 * p.x + 3.0 * p.y); }

TEST(DoubtfulTerrain, CentimetresAreToldByTheBasesOfBuildings) {
  EXPECT_THAT(told(town(rough_m), hills_m), IsEmpty());
  EXPECT_THAT(told(town(rough_m), [](Point2d p) { return 100.0 * hills_m(p); }),
              AllOf(HasSubstr("dtm.tif: its heights, from "), HasSubstr("below 64 buildings on 222 m, vary "),
                    HasSubstr("times as much as the bases of the buildings, from "),
                    HasSubstr("is the terrain in centimetres? gdal_edit.py -scale 0.01 FILE"), HasSubstr("\n208 dtm.tif: ")));
}

/// A town of polders: what its bases do by themselves is as much as its relief.
TEST(DoubtfulTerrain, LittleReliefIsEnoughForCentimetres) {
  const auto polder_m = [](Point2d p) { return -0.2 + 0.3 * std::sin(0.02 * p.x); };
  const auto bases_m = [&](Point2d p) { return polder_m(p) + 0.3 * std::sin(7.0 * p.x + 3.0 * p.y); };
  EXPECT_THAT(told(town(bases_m), [&](Point2d p) { return 100.0 * polder_m(p); }), HasSubstr("is the terrain in centimetres?"));
  // Trees and roofs in a coarse terrain have nothing to do with bases
  EXPECT_THAT(told(town(bases_m), [](Point2d p) { return 4.0 + 3.0 * std::sin(5.0 * p.x + 11.0 * p.y); }),
              Not(HasSubstr("208 ")));
}

TEST(DoubtfulTerrain, FeetAndMillimetresAreToldSo) {
  const auto climbing_m = [](Point2d p) { return 100.0 + 0.1 * p.x; };
  EXPECT_THAT(told(town(climbing_m), [&](Point2d p) { return climbing_m(p) / 0.3048; }),
              HasSubstr("vary 3.28 times as much as the bases of the buildings, from 100.6 m to 121.6 m: is the terrain in feet? "
                        "gdal_edit.py -scale 0.3048 FILE"));
  EXPECT_THAT(told(town(climbing_m), [&](Point2d p) { return climbing_m(p) * 1000.0; }), HasSubstr("-scale 0.001 FILE"));
}

TEST(DoubtfulTerrain, ADatumIsNoUnit) {
  EXPECT_THAT(told(town(rough_m), [](Point2d p) { return hills_m(p) - 5.0; }), HasSubstr("all alike"));
  // A model that stands at 0, whatever its ground
  EXPECT_THAT(told(town([](Point2d) { return 0.0; }), [](Point2d p) { return 20.0 * hills_m(p); }), Not(HasSubstr("208 ")));
}

TEST(DoubtfulTerrain, OfFootprintsItIsToldByItsSlopes) {
  const auto flat = [](Point2d) { return 0.0; };
  EXPECT_THAT(told(town(flat, HeightReference::on_ground), [](Point2d p) { return 100.0 * hills_m(p); }),
              AllOf(HasSubstr("208 dtm.tif: its heights, from "), HasSubstr("on a metre below half of them, as below no town"),
                    HasSubstr("-scale 0.01 FILE")));
  EXPECT_THAT(told(town(flat, HeightReference::on_ground), [](Point2d p) { return 0.8 * p.x; }), IsEmpty()) << "a mountain";
}

}  // namespace
}  // namespace farlod::plausibility
