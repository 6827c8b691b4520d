// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/raster_receivers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <ostream>
#include <random>
#include <utility>
#include <vector>

#include "align/align.hpp"
#include "farlod/error.hpp"
#include "farlod/points.hpp"
#include "farlod/region.hpp"
#include "georeference/georeference.hpp"
#include "ingest/files/input_search.hpp"
#include "ingest/ingest.hpp"
#include "receivers/point_receivers.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"
#include "tests/scenes/test_data.hpp"
#include "tiles/tiles.hpp"

namespace farlod {
namespace {

TEST(RasterPlan, BeginsAtMultiplesOfTheStep) {
  const package::Manifest m;
  for (const double step_m : {0.5, 2.0, 30.0}) {
    const RasterPlan plan = plan_raster(m, step_m, Box2d{{-1003.3, 17.7}, {-950.1, 98.2}});
    EXPECT_EQ(std::remainder(plan.north_west_m.x, step_m), 0.0);
    EXPECT_EQ(std::remainder(plan.north_west_m.y, step_m), 0.0);
  }
}

TEST(RasterPlan, CoversWhatIsWantedAndNoPixelMore) {
  const package::Manifest m;
  for (const double step_m : {0.5, 2.0, 30.0}) {
    const Box2d wanted{{-1003.3, 17.7}, {-950.1, 98.2}};
    const RasterPlan plan = plan_raster(m, step_m, wanted);
    const double east = plan.north_west_m.x + static_cast<double>(plan.columns) * step_m;
    const double south = plan.north_west_m.y - static_cast<double>(plan.rows) * step_m;
    EXPECT_TRUE(plan.north_west_m.x <= wanted.low.x && wanted.low.x < plan.north_west_m.x + step_m);
    EXPECT_TRUE(plan.north_west_m.y >= wanted.high.y && wanted.high.y > plan.north_west_m.y - step_m);
    EXPECT_TRUE(east >= wanted.high.x && wanted.high.x > east - step_m);
    EXPECT_TRUE(south <= wanted.low.y && wanted.low.y < south + step_m);
  }
}

TEST(RasterPlan, RunsFromTheNorthWest) {
  const RasterPlan plan{{100.0, 200.0}, 2.0, 10, 10};
  EXPECT_EQ(plan.centre_m(0, 0), (Point2d{101.0, 199.0}));
  EXPECT_EQ(plan.centre_m(3, 4), (Point2d{107.0, 191.0}));
}

// Pixels are placed all at once, triangle by triangle. The judge looks at each of them alone.

std::map<std::size_t, Point3f> one_by_one(const PackageReader& package, const package::Manifest& manifest, const RasterPlan& plan,
                                          const PixelRange& range, Cell cell, HeightAbove above) {
  const PointLocator locator(package, cell);
  std::map<std::size_t, Point3f> result;
  for (std::size_t row = range.row_begin; row < range.row_end; ++row)
    for (std::size_t column = range.column_begin; column < range.column_end; ++column) {
      const Point2d p_grid = manifest.grid_from_projected(plan.centre_m(column, row));
      if (package.grid().cell_of(p_grid) != cell) continue;
      const Point2d p = p_grid - package.grid().corner_of(cell);
      if (const auto standing = stand(locator, static_cast<float>(p.x), static_cast<float>(p.y), above, 1.5F))
        result[row * plan.columns + column] = *standing;
    }
  return result;
}

/// A small town on a turned grid, somewhere in the output CRS.
class RasterOfATown : public testing::TestWithParam<double> {
 protected:
  RasterOfATown() : package_(packed(GetParam())), manifest_(package_.manifest()) { manifest_.origin_m = {1000.3, -2000.7}; }

  PackageReader packed(double bearing_deg) const {
    scenes::SceneBuilder builder;
    for (const double x : {0.0, 21.0, 43.0}) builder.add_box({{x, 0.5 * x}, {x + 11.0, 0.5 * x + 9.0}}, 0.0, 6.0);
    const Grid grid = scenes::grid_covering(builder.city(), Angle::degrees(bearing_deg), 16.0, 1, 2);
    scenes::pack_city(builder.city(), grid, folder_.path() / "town.farlod", scenes::box_maps(1, 1));
    return PackageReader(folder_.path() / "town.farlod");
  }

  /// Every pixel in turn, without ranges.
  std::map<std::size_t, Point3f> one_by_one(const RasterPlan& plan, HeightAbove above) const {
    std::map<std::size_t, Point3f> all;
    const CellRange& cells = package_.grid().cells;
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n)
      all.merge(farlod::one_by_one(package_, manifest_, plan, {0, plan.columns, 0, plan.rows}, cells.cell_at(n), above));
    return all;
  }
  void expect_each_pixel_once(const RasterPlan& plan, HeightAbove above) const {
    const RasterReceivers receivers(manifest_, plan);
    std::map<std::size_t, Point3f> found;
    for (const Cell cell : receivers.cells())
      for (const Receiver& r : receivers.in_cell(package_, cell, above, 1.5F).receivers)
        EXPECT_TRUE(found.emplace(r.index, r.p_cell).second) << "pixel " << r.index << " twice";
    EXPECT_EQ(found, one_by_one(plan, above)) << plan.step_m;
  }

  scenes::TemporaryFolder folder_;
  PackageReader package_;
  package::Manifest manifest_;
};

TEST_P(RasterOfATown, CoversAllCells) {
  const RasterPlan plan = plan_raster(manifest_, 3.0, std::nullopt);
  const Box2d outline{{plan.north_west_m.x, plan.north_west_m.y - 3.0 * static_cast<double>(plan.rows)},
                      {plan.north_west_m.x + 3.0 * static_cast<double>(plan.columns), plan.north_west_m.y}};
  const CellRange& cells = package_.grid().cells;
  for (const Cell corner : {Cell{cells.i_begin, cells.j_begin},
                            {cells.i_end, cells.j_begin},
                            {cells.i_begin, cells.j_end},
                            {cells.i_end, cells.j_end}}) {
    const Point2d p_grid = package_.grid().corner_of(corner);
    EXPECT_TRUE(outline.contains(horizontal(manifest_.projected_from_grid({p_grid.x, p_grid.y, 0.0}))));
  }
}

TEST_P(RasterOfATown, EachPixelBelongsToExactlyOneCell) {
  for (const double step_m : {1.0, 3.7, 40.0})
    for (const HeightAbove above : {HeightAbove::ground, HeightAbove::highest_surface})
      expect_each_pixel_once(plan_raster(manifest_, step_m, std::nullopt), above);
  // Of the grids that are not turned, or by a right angle, borders run through the centres of pixels
  manifest_.origin_m = {};
  expect_each_pixel_once(plan_raster(manifest_, 32.0, std::nullopt), HeightAbove::highest_surface);
}

TEST_P(RasterOfATown, PixelsBeyondTheGridStandWherePointsDo) {
  manifest_ = package_.manifest();
  const Box2d outline = manifest_.projected_outline(package_.grid().rectangle());
  const RasterPlan plan = plan_raster(manifest_, 3.0, grown(outline, 1.5 * answered_beyond_grid_m));
  const RasterReceivers receivers(manifest_, plan, nullptr, BeyondGrid::is_answered);
  std::map<std::size_t, Point3f> found;
  for (const Cell cell : receivers.cells())
    for (const Receiver& r : receivers.in_cell(package_, cell, HeightAbove::ground, 1.5F).receivers) {
      EXPECT_TRUE(found.emplace(r.index, r.p_cell).second) << "pixel " << r.index << " twice";
      const PlaceOfReceiver place{plan.centre_m(r.index % plan.columns, r.index / plan.columns), {}};
      const std::array chosen{std::size_t{0}};
      const CellReceivers alone = receivers_at(package_, cell, {&place, 1}, chosen, HeightAbove::ground, 1.5F);
      ASSERT_EQ(alone.receivers.size(), 1U);
      EXPECT_NEAR(norm(alone.receivers[0].p_cell - r.p_cell), 0.0F, 1e-4F);
    }
  const Box2d answered = grown(outline, answered_beyond_grid_m);
  std::size_t beyond = 0;
  for (std::size_t row = 0; row < plan.rows; ++row)
    for (std::size_t column = 0; column < plan.columns; ++column) {
      const Point2d centre = plan.centre_m(column, row);
      const bool is_beyond = !package_.grid().cells.contains(package_.grid().cell_of(manifest_.grid_from_projected(centre)));
      beyond += is_beyond ? 1U : 0U;
      if (is_beyond && answered.contains(centre)) {
        EXPECT_TRUE(found.contains(row * plan.columns + column)) << row << "," << column;
      }
    }
  EXPECT_GT(beyond, 1000U);
  // The same in the cells of the grid
  for (const auto& [pixel, p_cell] : one_by_one(plan, HeightAbove::ground)) EXPECT_EQ(found.at(pixel), p_cell);
}

TEST_P(RasterOfATown, ARasterOfAnotherPlaceHasNoPixelsBeyondTheGrid) {
  manifest_ = package_.manifest();
  const Point2d high = manifest_.projected_outline(package_.grid().rectangle()).high;
  const RasterPlan plan = plan_raster(manifest_, 1.0, Box2d{high + Point2d{2.0, 2.0}, high + Point2d{9.0, 9.0}});
  EXPECT_TRUE(RasterReceivers(manifest_, plan, nullptr, BeyondGrid::is_answered).cells().empty());
}

TEST_P(RasterOfATown, PixelsBeyondTheGridAreThoseOfTheRegion) {
  manifest_ = package_.manifest();
  const Box2d outline = manifest_.projected_outline(package_.grid().rectangle());
  const RasterPlan plan = plan_raster(manifest_, 2.0, grown(outline, 60.0));
  const Point2d corner = outline.high;
  const Region region({{corner + Point2d{5.0, 5.0}, corner + Point2d{25.0, 5.0}, corner + Point2d{5.0, 25.0}}});
  const RasterReceivers receivers(manifest_, plan, &region, BeyondGrid::is_answered);
  std::size_t count = 0;
  for (const Cell cell : receivers.cells())
    for (const Receiver& r : receivers.in_cell(package_, cell, HeightAbove::ground, 1.5F).receivers) {
      EXPECT_TRUE(region.contains(plan.centre_m(r.index % plan.columns, r.index / plan.columns)));
      ++count;
    }
  std::size_t wanted = 0;
  for (std::size_t n = 0; n < plan.columns * plan.rows; ++n)
    wanted += region.contains(plan.centre_m(n % plan.columns, n / plan.columns)) ? 1U : 0U;
  EXPECT_EQ(count, wanted);
}

/// Some of the cells have more pixels than are placed at once.
TEST_P(RasterOfATown, FinePixelsAreListedPatchByPatch) {
  const Grid& grid = package_.grid();
  const Cell middle = grid.cells.cell_at(static_cast<std::size_t>(grid.cells.size()) / 2);
  const RasterPlan plan = plan_raster(manifest_, 0.08, manifest_.projected_outline(grid.square_of(middle)));
  const RasterReceivers receivers(manifest_, plan);
  const CellReceivers cell = receivers.in_cell(package_, middle, HeightAbove::highest_surface, 1.5F);
  EXPECT_GT(cell.receivers.size() + cell.left_out, 32'768U);
  const PixelRange range = receivers.range_of(middle);
  const auto place = [&](const Receiver& r) {
    const std::size_t row = r.index / plan.columns - range.row_begin, column = r.index % plan.columns - range.column_begin;
    return std::array{row / 4, column / 4, row % 4, column % 4};
  };
  const PointLocator locator(package_, middle);
  std::size_t in_order = 1;
  for (std::size_t k = 0; k < cell.receivers.size(); ++k) {
    const Receiver& r = cell.receivers[k];
    const auto alone = stand(locator, r.p_cell.x, r.p_cell.y, HeightAbove::highest_surface, 1.5F);
    ASSERT_TRUE(alone.has_value());
    ASSERT_EQ(r.p_cell, *alone);
    if (k > 0) in_order += place(cell.receivers[k - 1]) < place(r) ? 1U : 0U;
  }
  EXPECT_EQ(in_order, cell.receivers.size());
}

TEST_P(RasterOfATown, APartOfTheRasterHasTheSameReceivers) {
  const RasterPlan whole = plan_raster(manifest_, 2.0, std::nullopt);
  const Box2d wanted{whole.centre_m(5, 12), whole.centre_m(14, 4)};
  const RasterPlan part = plan_raster(manifest_, 2.0, wanted);
  const auto all = one_by_one(whole, HeightAbove::ground);
  const RasterReceivers receivers(manifest_, part);
  std::size_t count = 0;
  for (const Cell cell : receivers.cells())
    for (const Receiver& r : receivers.in_cell(package_, cell, HeightAbove::ground, 1.5F).receivers) {
      const std::size_t column = r.index % part.columns + 5, row = r.index / part.columns + 4;
      const auto same = all.find(row * whole.columns + column);
      ASSERT_NE(same, all.end());
      EXPECT_EQ(r.p_cell, same->second);
      ++count;
    }
  EXPECT_GT(count, 0U);
  EXPECT_EQ(std::pair(part.columns, part.rows), std::pair(std::size_t{10}, std::size_t{9}));
}

TEST_P(RasterOfATown, HousesHaveNoPixelsUnlessOneStandsOnThem) {
  const RasterPlan plan = plan_raster(manifest_, 1.0, std::nullopt);
  const auto street = one_by_one(plan, HeightAbove::ground), top = one_by_one(plan, HeightAbove::highest_surface);
  EXPECT_LT(street.size(), top.size());
  // A column's height is rounded a few times below 8 m
  constexpr float rounding_m = 4 * 8.0F * std::numeric_limits<float>::epsilon();
  for (const auto& [n, p_cell] : top) EXPECT_NEAR(p_cell.z, street.contains(n) ? 1.5F : 7.5F, rounding_m);
}

INSTANTIATE_TEST_SUITE_P(TurnedBy, RasterOfATown, testing::Values(0.0, 33.0, 90.0, -71.5));

/// Returns the number of receivers.
std::size_t expect_as_one_by_one(const PackageReader& package, double step_m) {
  const RasterPlan plan = plan_raster(package.manifest(), step_m, std::nullopt);
  const RasterReceivers receivers(package.manifest(), plan);
  std::size_t count = 0;
  for (const Cell cell : receivers.cells())
    for (const HeightAbove above : {HeightAbove::ground, HeightAbove::highest_surface}) {
      std::map<std::size_t, Point3f> found;
      for (const Receiver& r : receivers.in_cell(package, cell, above, 1.5F).receivers) found.emplace(r.index, r.p_cell);
      EXPECT_EQ(found, one_by_one(package, package.manifest(), plan, receivers.range_of(cell), cell, above))
          << cell.i << "," << cell.j;
      count += found.size();
    }
  return count;
}

struct Town {
  const char* name;
  CitySettings settings;
};
void PrintTo(const Town& town, std::ostream* out) { *out << town.name; }

Town town(const char* name, const std::function<void(CitySettings&)>& change) {
  CitySettings settings{.size_m = 220.0, .seed = 5, .rotation_deg = 33.0};
  change(settings);
  return {name, settings};
}

class RasterOfGeneratedTown : public testing::TestWithParam<Town> {};

TEST_P(RasterOfGeneratedTown, HasTheReceiversOfSinglePlaces) {
  const CityModel city = scenes::generated_town(GetParam().settings);
  for (const Assign assign : {Assign::clip, Assign::whole}) {
    const scenes::TemporaryFolder folder;
    const Grid grid = scenes::grid_covering(city, Angle::degrees(33.0), 40.0, 1);
    scenes::pack_city(city, grid, folder.path() / "town.farlod", scenes::box_maps(1, 1), assign);
    const PackageReader package(folder.path() / "town.farlod");
    EXPECT_GT(expect_as_one_by_one(package, 1.0), 30'000U);
    EXPECT_GT(expect_as_one_by_one(package, 7.3), 500U);
  }
}

INSTANTIATE_TEST_SUITE_P(Towns, RasterOfGeneratedTown,
                         testing::Values(town("Prisms", [](CitySettings& s) { s.lod = 1; }),
                                         town("Roofs",
                                              [](CitySettings& s) {
                                                s.lod = 2;
                                                s.eaves_m = 0.5;
                                                s.balconies = s.projecting_floors = s.overhangs = true;
                                              }),
                                         town("OpenShells", [](CitySettings& s) { s.open_shells = s.overhangs = true; }),
                                         town("Hillside", [](CitySettings& s) { s.hillside = s.overlapping_parts = true; }),
                                         town("Details",
                                              [](CitySettings& s) {
                                                s.lod = 2;
                                                s.terrain_relief_m = 30.0;
                                                s.facade_details = true;
                                                s.wrong_base_share = 0.2;
                                              })),
                         [](const auto& town) { return town.param.name; });

class RasterOfRealCity : public testing::TestWithParam<const char*> {};

TEST_P(RasterOfRealCity, HasTheReceiversOfSinglePlaces) {
  const std::filesystem::path file = scenes::test_data(GetParam());
  if (!std::filesystem::exists(file)) GTEST_SKIP() << scenes::absence_of(file);
  const scenes::TemporaryFolder folder;
  Report report;
  const std::vector inputs{file};
  LocatedCity located = georeference::georeference(ingest::ingest_all(ingest::find_input_files(inputs, report).files, {}, report),
                                                   georeference::GeoreferenceSettings(), report);
  const Grid grid = align::align(located, {}, report).grid;
  const TileSet tiles = tiles::cut_into_tiles(std::move(located), grid, Assign::clip, std::nullopt, report);
  scenes::pack_tiles(tiles, grid, folder.path() / "city.farlod", scenes::box_maps(1, 1));
  const PackageReader package(folder.path() / "city.farlod");
  EXPECT_GT(expect_as_one_by_one(package, 2.0), 10'000U);
}

INSTANTIATE_TEST_SUITE_P(Cities, RasterOfRealCity,
                         testing::Values("rotterdam/delfshaven.city.json", "tokyo/53392633_bldg_6697_2_op.gml"),
                         [](const auto& city) { return city.index == 0 ? "Rotterdam" : "Tokyo"; });

Region::Ring square(double low, double high) { return {{low, low}, {high, low}, {high, high}, {low, high}}; }

TEST(Region, HasHoles) {
  const Region region({square(0, 10), square(4, 6)});
  EXPECT_TRUE(region.contains({1, 1}));
  EXPECT_FALSE(region.contains({5, 5}));
  EXPECT_TRUE(region.contains({7, 5}));
  EXPECT_FALSE(region.contains({11, 5}));
  EXPECT_EQ(region.outline(), (Box2d{{0, 0}, {10, 10}}));
}

TEST(Region, GivesAPlaceOnASharedEdgeToOneOfTwoPolygons) {
  const Region west({{{0, 0}, {3, 1}, {2, 7}, {0, 8}}}), east({{{3, 1}, {9, 0}, {9, 8}, {2, 7}}});
  for (int n = 0; n <= 100; ++n) {
    const double share = n / 100.0;
    const Point2d p{3.0 - share, 1.0 + 6.0 * share};
    EXPECT_EQ(west.contains(p) + east.contains(p), 1) << n;
  }
}

TEST(Region, OfNothingHoldsNothing) {
  EXPECT_FALSE(Region({}).contains({0, 0}));
  EXPECT_FALSE(Region({{}, {{1, 1}}, {{1, 1}, {2, 2}}}).contains({1.5, 1.5}));
}

TEST(Region, IsThatOfAStarWithManyPoints) {
  // A ring whose radius is known at each azimuth, of so many edges that they are divided into bands
  constexpr int corners = 20000;
  const auto radius = [](double t) { return 100.0 + 40.0 * std::sin(7.0 * t) + 5.0 * std::sin(90.0 * t); };
  Region::Ring ring;
  for (int n = 0; n < corners; ++n) {
    const double t = 2.0 * std::numbers::pi * n / corners;
    ring.push_back({500000.0 + radius(t) * std::cos(t), 5e6 + radius(t) * std::sin(t)});
  }
  const Region region({ring});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-150.0, 150.0);
  int inside = 0;
  for (int n = 0; n < 20000; ++n) {
    const Point2d p{place(random), place(random)};
    const double distance = std::hypot(p.x, p.y), at = radius(std::atan2(p.y, p.x));
    if (std::abs(distance - at) < 0.5) continue;
    ASSERT_EQ(region.contains({500000.0 + p.x, 5e6 + p.y}), distance < at) << p.x << ", " << p.y;
    inside += distance < at ? 1 : 0;
  }
  EXPECT_GT(inside, 1000);
}

TEST(Region, OfPlacesNowhereIsRefused) {
  EXPECT_THROW(Region({{{0, 0}, {1, 0}, {std::numeric_limits<double>::quiet_NaN(), 1}}}), InvalidArgument);
  EXPECT_THROW(Region({{{0, 0}, {1, 0}, {1, 1e9}}}), InvalidArgument);
}

}  // namespace
}  // namespace farlod
