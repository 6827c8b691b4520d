// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/stepped_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "city/geometry.hpp"
#include "tiles/pixel_steps.hpp"

namespace farlod::tiles {
namespace {

using Triangle3d = std::array<Point3d, 3>;

TerrainRaster raster_of(std::size_t columns, std::vector<std::optional<float>> height_m) {
  TerrainRaster raster;
  raster.first = {0.5, 0.5};
  raster.columns = columns;
  raster.rows = height_m.size() / columns;
  raster.height_m = std::move(height_m);
  raster.covers_pixels = true;
  return raster;
}

SteppedSurface surface_of(const TerrainRaster& raster) { return stepped_surface(raster, PixelSteps(raster), {}); }

double plan_area_m2(const Triangle3d& t) { return 0.5 * cross(t[1] - t[0], t[2] - t[0]).z; }

struct Areas {
  double plan_m2 = 0.0, wall_m2 = 0.0;
};
Areas areas_of(const SteppedSurface& surface) {
  Areas areas;
  for (const Triangle3d& t : surface.triangles) {
    const double plan_m2 = plan_area_m2(t);
    EXPECT_GE(plan_m2, 0.0);
    areas.plan_m2 += plan_m2;
    if (plan_m2 == 0.0) areas.wall_m2 += 0.5 * norm(cross(t[1] - t[0], t[2] - t[0]));
  }
  return areas;
}

TEST(SteppedSurface, ABlockOnLevelGroundHasFourWallsAndFourBorders) {
  std::vector<std::optional<float>> heights(7 * 7, 0.0F);
  for (std::size_t row = 2; row < 5; ++row)
    for (std::size_t column = 2; column < 5; ++column) heights[row * 7 + column] = 10.0F;
  const SteppedSurface surface = surface_of(raster_of(7, heights));
  const Areas areas = areas_of(surface);
  EXPECT_DOUBLE_EQ(areas.plan_m2, 49.0);
  EXPECT_DOUBLE_EQ(areas.wall_m2, 4.0 * 3.0 * 10.0);
  std::vector<double> roof, rim;
  for (const HorizonSegment& e : surface.edges) {
    EXPECT_EQ(e.segment.a.z, e.segment.b.z);
    (e.segment.a.z > 0.0 ? roof : rim).push_back(norm(e.segment.b - e.segment.a));
  }
  EXPECT_EQ(roof, std::vector<double>(4, 3.0));
  EXPECT_EQ(rim, std::vector<double>(4, 7.0));
}

TEST(SteppedSurface, StepsAreHigherThanBanksAndSteeperThanWhatGoesOn) {
  const auto steps_in_row = [](std::vector<std::optional<float>> heights) {
    const std::size_t columns = heights.size();
    return PixelSteps(raster_of(columns, std::move(heights))).count();
  };
  EXPECT_EQ(steps_in_row({0.0F, 0.0F, 8.0F, 8.0F}), 1U);
  EXPECT_EQ(steps_in_row({0.0F, 0.0F, 2.0F, 2.0F}), 0U);            // a bank
  EXPECT_EQ(steps_in_row({0.0F, 3.0F, 6.0F, 9.0F}), 0U);            // a slope
  EXPECT_EQ(steps_in_row({0.0F, 0.1F, 8.0F, 9.0F, 10.0F}), 1U);     // a wall below a roof of 45°
  EXPECT_EQ(steps_in_row({0.0F, 12.0F, 0.0F}), 2U);                 // a mast
  EXPECT_EQ(steps_in_row({0.0F, std::nullopt, 12.0F, 12.0F}), 0U);  // beside no data nothing is known
}

TEST(SteppedSurface, ThreePixelsBesideATowerStayInTheirPlane) {
  const SteppedSurface surface = surface_of(raster_of(2, {0.0F, 1.0F, 1.5F, 20.0F}));
  std::vector<double> at_corner;
  for (const Triangle3d& t : surface.triangles)
    for (const Point3d& p : t)
      if (p.x == 1.0 && p.y == 1.0 && plan_area_m2(t) > 0.0) at_corner.push_back(p.z);
  EXPECT_EQ(std::set<double>(at_corner.begin(), at_corner.end()), (std::set<double>{1.25, 20.0}));
}

/// Level ground, slopes, towers, single pixels and holes: of some rasters as much as can be, of others smooth ground with few of
/// them.
TerrainRaster random_raster(std::mt19937& random, bool is_smooth) {
  constexpr std::size_t columns = 9, rows = 8;
  std::uniform_real_distribution<float> noise(-0.4F, 0.4F);
  std::uniform_int_distribution<int> kind(is_smooth ? 4 : 0, 9), lot(0, is_smooth ? 9 : 2);
  std::vector<std::optional<float>> heights;
  for (std::size_t n = 0; n < columns * rows; ++n) {
    const int k = kind(random);
    const bool stands_out = lot(random) == 0;
    const float slope = 0.7F * static_cast<float>(n % columns) + noise(random);
    heights.emplace_back(k < 2 ? 0.0F : k < 4 ? 10.0F : !stands_out ? slope : k < 8 ? 12.0F + slope : 25.0F * noise(random));
    if (k == 9 && stands_out) heights.back().reset();
  }
  return raster_of(columns, std::move(heights));
}

class RandomSurface : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937 random{GetParam()};
  TerrainRaster raster = random_raster(random, GetParam() % 2 == 0);
  SteppedSurface surface = surface_of(raster);
};

TEST_P(RandomSurface, CoversEachPixelOnceThroughItsHeight) {
  const auto pixels = std::count_if(raster.height_m.begin(), raster.height_m.end(), [](const auto& h) { return h.has_value(); });
  EXPECT_NEAR(areas_of(surface).plan_m2, static_cast<double>(pixels), 1e-9);
  for (std::size_t n = 0; n < raster.height_m.size(); ++n) {
    const Point2d centre = raster.node(n % raster.columns, n / raster.columns);
    for (const Triangle3d& t : surface.triangles)
      for (const Point3d& corner : t) {
        if (corner.x != centre.x || corner.y != centre.y) continue;
        EXPECT_EQ(corner.z, raster.height_m[n].value());
      }
  }
}

/// Where the plane through the eye at an azimuth meets a segment, ahead of the eye.
std::optional<double> slope_seen(const Point3d& eye, Point2d ahead, const Point3d& a, const Point3d& b) {
  const Point2d left{-ahead.y, ahead.x}, to_a = horizontal(a - eye), to_b = horizontal(b - eye);
  const double da = dot(left, to_a), db = dot(left, to_b);
  if (da * db > 0.0 || da == db) return std::nullopt;
  const Point3d p = a + da / (da - db) * (b - a);
  const double run_m = dot(ahead, horizontal(p - eye));
  return run_m > 1e-9 ? std::optional((p.z - eye.z) / run_m) : std::nullopt;
}

TEST_P(RandomSurface, ItsEdgesHideWhatItsTrianglesHide) {
  std::uniform_real_distribution<double> x(0.0, 9.0), y(0.0, 8.0), turn(0.0, 6.28), above_m(0.01, 4.0);
  for (int n = 0; n < 400; ++n) {
    const Point2d place{x(random), y(random)};
    const auto pixel = static_cast<std::size_t>(place.y) * raster.columns + static_cast<std::size_t>(place.x);
    double ground_m = raster.height_m[pixel].value_or(0.0F);
    for (const Triangle3d& t : surface.triangles)  // above all that is near: within the surface there is no horizon
      for (const Point3d& p : t)
        if (norm(horizontal(p) - place) < 1.5) ground_m = std::max(ground_m, p.z);
    const Point3d eye{place.x, place.y, ground_m + above_m(random)};
    const double azimuth = turn(random);
    const Point2d ahead{std::sin(azimuth), std::cos(azimuth)};
    double by_triangles = 0.0, by_edges = 0.0;
    for (const Triangle3d& t : surface.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        by_triangles = std::max(by_triangles, slope_seen(eye, ahead, t[k], t[(k + 1) % 3]).value_or(0.0));
    for (const HorizonSegment& e : surface.edges)
      by_edges = std::max(by_edges, slope_seen(eye, ahead, e.segment.a, e.segment.b).value_or(0.0));
    // Edges that bend by less than angle_tolerance_rad are left out
    EXPECT_NEAR(by_edges, by_triangles, 1e-5) << n;
  }
}

/// The height of the surface at a place, but for its walls; none where it is not.
std::optional<double> height_at(const SteppedSurface& surface, Point2d p) {
  for (const Triangle3d& t : surface.triangles) {
    const double area_m2 = plan_area_m2(t);
    if (area_m2 == 0.0) continue;
    std::array<double, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2d a = horizontal(t[(k + 1) % 3]) - p, b = horizontal(t[(k + 2) % 3]) - p;
      weights[k] = 0.5 * (a.x * b.y - a.y * b.x) / area_m2;
    }
    if (*std::min_element(weights.begin(), weights.end()) >= 0.0)
      return weights[0] * t[0].z + weights[1] * t[1].z + weights[2] * t[2].z;
  }
  return std::nullopt;
}

/// On each side of a pixel, between what is a little beside it.
TEST_P(RandomSurface, ItsWallsCloseWhatIsOpen) {
  constexpr double beside_m = 1e-9;
  constexpr int places = 64;
  double open_m2 = 0.0;
  for (std::size_t n = 0; n < raster.height_m.size(); ++n)
    for (int place = 0; place < places; ++place) {
      const double along_m = (place + 0.5) / places - 0.5;
      for (const bool to_east : {true, false}) {
        const Point2d side =
            raster.node(n % raster.columns, n / raster.columns) + (to_east ? Point2d{0.5, along_m} : Point2d{along_m, 0.5});
        const Point2d off = to_east ? Point2d{beside_m, 0.0} : Point2d{0.0, beside_m};
        const auto here_m = height_at(surface, side - off), there_m = height_at(surface, side + off);
        if (here_m && there_m) open_m2 += std::abs(*here_m - *there_m) / places;
      }
    }
  // Where borders cross between two places, the sum is off by less than what stands between these
  EXPECT_NEAR(areas_of(surface).wall_m2, open_m2, 1e-3 * open_m2 + 1e-6);
}

INSTANTIATE_TEST_SUITE_P(SteppedSurface, RandomSurface, testing::Range(0U, 40U));

}  // namespace
}  // namespace farlod::tiles
