// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/hemisphere.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "farlod/surfaces.hpp"
#include "farlod/version.hpp"
#include "tests/library/packed_sample.hpp"

namespace farlod::library {
namespace {

/// Some ten thousand receivers, each with an area and an answer that were rounded to floats.
constexpr double summation_error = 1e-6;
/// A height of hundreds of metres is rounded to a float, by less than .1 mm, and an answer changes by less than that over a
/// metre.
constexpr double height_rounding = 1e-4;
/// Of a few sums and quotients of doubles near 1.
constexpr double arithmetic_error = 1e-9;

/// A place or a normal that is rounded once more moves an edge across three of a thousand rays at the most.
constexpr double few_rays = 0.003 + 1e-6;

class Answers : public testing::Test {
 protected:
  Package package_{PackedSample::shared().folder()};
};

TEST_F(Answers, TheDescriptionIsThatOfThePacking) {
  const PackageDescription& opened = package_.description();
  const PackageDescription& packed = PackedSample::shared().result().package;
  EXPECT_EQ(opened.software, std::string("farlod-pack ") + software_version);
  EXPECT_GT(opened.buildings, 0U);
  EXPECT_EQ(opened.buildings, packed.buildings);
  EXPECT_EQ(opened.polygons, packed.polygons);
  EXPECT_EQ(opened.triangles, packed.triangles);
  EXPECT_EQ(opened.crs_wkt, packed.crs_wkt);
  EXPECT_EQ(opened.outline_projected, packed.outline_projected);
  EXPECT_EQ(opened.columns * opened.rows, packed.columns * packed.rows);
}

/// The pixels of a raster, asked for as points.
TEST_F(Answers, PointsAndPixelsAgree) {
  const RasterPlan plan = plan_raster(package_, 4.0);
  EvaluationSettings settings;
  settings.engine = Engine::exact;  // other engines answer 16 neighbors at once, which round alike only when they are the same
  settings.bounds = true;
  const Raster raster = evaluate_raster(package_, plan, {}, settings);
  std::vector<double> x, y;
  for (std::size_t row = 0; row < plan.rows; ++row)
    for (std::size_t column = 0; column < plan.columns; ++column) {
      x.push_back(plan.centre_m(column, row).x);
      y.push_back(plan.centre_m(column, row).y);
    }
  const PointAnswers points = evaluate_points(package_, {x, y}, {}, settings);
  ASSERT_EQ(points.svf.size(), raster.svf.size());
  std::size_t compared = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    if (std::isnan(raster.svf[n])) continue;
    EXPECT_EQ(points.svf[n], raster.svf[n]) << n;
    EXPECT_EQ(points.low[n], raster.low[n]) << n;
    ++compared;
  }
  EXPECT_EQ(compared, raster.summary.receivers);
  EXPECT_GT(compared, 100U);
  EXPECT_EQ(raster.summary.receivers + raster.summary.no_data + raster.summary.beyond_grid, plan.columns * plan.rows);
}

/// The directions of sky, weighted by what they count, are the answer of the same place.
TEST_F(Answers, TheHemisphereHasTheViewFactor) {
  const RasterPlan plan = plan_raster(package_, 9.0);
  std::size_t compared = 0;
  for (std::size_t n = 0; n < plan.columns * plan.rows; n += 7) {
    const auto seen = look_up(package_, plan.centre_m(n % plan.columns, n / plan.columns));
    if (!seen) continue;
    double svf = 0.0;
    for (std::size_t a = 0; a < seen->azimuths; ++a)
      for (std::size_t e = 0; e < seen->elevations; ++e) {
        const double part = 0.5 * std::numbers::pi / static_cast<double>(seen->elevations);
        const double low = std::sin(static_cast<double>(e) * part), high = std::sin(static_cast<double>(e + 1) * part);
        if (seen->part(a, e) == SkyPart::sky) svf += (high * high - low * low) / static_cast<double>(seen->azimuths);
      }
    EXPECT_NEAR(svf, seen->svf, 0.01) << n;
    ++compared;
  }
  EXPECT_GT(compared, 10U);
}

/// Some of everything.
Quantities many_quantities() {
  Quantities further;
  further.svf_solid = further.directional = further.hidden = true;
  further.horizons = 8;
  further.sky_patches = SkyPatchSet::tregenza;
  further.sun = {{Angle::degrees(180.0), Angle::degrees(40.0), 2.0}};
  return further;
}

TEST_F(Answers, FurtherQuantitiesOfPointsPixelsAndSurfacesAgree) {
  EvaluationSettings settings;
  settings.further = many_quantities();
  const std::size_t columns = columns_of(settings.further).size();
  EXPECT_EQ(columns, 1U + 4U + 2U + 8U + 145U + 1U);
  const RasterPlan plan = plan_raster(package_, 9.0);
  const Raster raster = evaluate_raster(package_, plan, {}, settings);
  ASSERT_EQ(raster.further.size(), columns);
  std::vector<double> x, y;
  for (std::size_t n = 0; n < plan.columns * plan.rows; ++n) {
    x.push_back(plan.centre_m(n % plan.columns, n / plan.columns).x);
    y.push_back(plan.centre_m(n % plan.columns, n / plan.columns).y);
  }
  const PointAnswers points = evaluate_points(package_, {x, y}, {}, settings);
  ASSERT_EQ(points.further.size(), columns * x.size());
  std::size_t compared = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    if (std::isnan(raster.svf[n])) continue;
    for (std::size_t c = 0; c < columns; ++c) EXPECT_NEAR(points.further[n * columns + c], raster.further[c][n], 0.002) << c;
    ++compared;
  }
  EXPECT_EQ(compared, raster.summary.receivers);
  // Means of a surface are those of its points
  std::vector<double> weighted(columns);
  double area_m2 = 0.0;
  const SurfaceMeans means =
      evaluate_surfaces(package_, {SurfaceChoice::roofs, 3.0}, settings, [&](std::size_t, std::span<const SurfacePoint> some) {
        for (const SurfacePoint& p : some) {
          ASSERT_EQ(p.further.size(), p.svf ? columns : 0U);
          area_m2 += p.svf ? p.area_m2 : 0.0;
          for (std::size_t c = 0; c < p.further.size(); ++c) weighted[c] += p.area_m2 * p.further[c];
        }
      });
  std::vector<double> of_means(columns);
  for (const SurfaceMean& mean : means.surfaces)
    for (std::size_t c = 0; c < mean.further_mean.size(); ++c) of_means[c] += mean.area_m2 * mean.further_mean[c];
  for (std::size_t c = 0; c < columns; ++c) EXPECT_NEAR(of_means[c], weighted[c], summation_error * area_m2 * 90.0) << c;
}

/// Besides the quantities, a run answers what it answers without them.
TEST_F(Answers, FurtherQuantitiesChangeNoSkyViewFactor) {
  EvaluationSettings plain, with_more;
  with_more.further = many_quantities();
  with_more.further.horizons = 0;  // which choose other azimuths
  const RasterPlan plan = plan_raster(package_, 5.0);
  const Raster a = evaluate_raster(package_, plan, {}, plain), b = evaluate_raster(package_, plan, {}, with_more);
  EXPECT_EQ(std::memcmp(a.svf.data(), b.svf.data(), a.svf.size() * sizeof(float)), 0);
}

TEST_F(Answers, TilesAreTheRaster) {
  const RasterPlan plan = plan_raster(package_, 1.0);
  const Raster raster = evaluate_raster(package_, plan);
  std::size_t pixels = 0;
  (void)evaluate_raster(package_, plan, {}, {}, [&](const RasterTile& tile) {
    for (std::size_t row = 0; row < pixels_of_tile(tile.place.row, plan.rows); ++row)
      for (std::size_t column = 0; column < pixels_of_tile(tile.place.column, plan.columns); ++column) {
        const float of_tile = tile.svf[row * raster_tile_edge + column];
        const std::size_t place =
            (tile.place.row * raster_tile_edge + row) * plan.columns + tile.place.column * raster_tile_edge + column;
        EXPECT_EQ(std::memcmp(&of_tile, &raster.svf[place], sizeof(float)), 0) << place;
        pixels += std::isnan(of_tile) ? 0 : 1;
      }
  });
  EXPECT_EQ(pixels, raster.summary.receivers);
}

TEST_F(Answers, MeansOfSurfacesAreThoseOfTheirPoints) {
  double area_m2 = 0.0, weighted = 0.0;
  std::size_t points_taken = 0;
  const SurfaceMeans means =
      evaluate_surfaces(package_, {SurfaceChoice::roofs, 1.0}, {}, [&](std::size_t, std::span<const SurfacePoint> points) {
        for (const SurfacePoint& p : points) {
          EXPECT_EQ(p.kind, SurfaceKind::roof);
          ++points_taken;
          if (!p.svf) continue;
          area_m2 += p.area_m2;
          weighted += p.area_m2 * *p.svf;
        }
      });
  double area_of_means_m2 = 0.0, weighted_of_means = 0.0;
  for (const BuildingMean& b : means.buildings) {
    area_of_means_m2 += b.roof_area_m2;
    weighted_of_means += b.roof_area_m2 * b.svf_roofs.value_or(0.0);
  }
  EXPECT_EQ(points_taken, means.summary.receivers + means.summary.no_data);
  EXPECT_GT(area_m2, 0.0);
  EXPECT_NEAR(area_of_means_m2, area_m2, summation_error * area_m2);
  EXPECT_NEAR(weighted_of_means, weighted, summation_error * weighted);
}

TEST_F(Answers, HeightsAboveSeaLevelAreThoseOfTheAnswers) {
  const Point2d p = middle_of(package_);
  const std::vector<double> x{p.x, p.x + 20.0, p.x - 20.0}, y{p.y, p.y + 5.0, p.y - 5.0};
  const PointAnswers on_ground = evaluate_points(package_, {x, y}, {HeightAbove::highest_surface, 2.0});
  const PointAnswers at_height = evaluate_points(package_, {x, y, on_ground.height_m});
  for (std::size_t n = 0; n < x.size(); ++n) {
    ASSERT_FALSE(std::isnan(on_ground.svf[n]));
    EXPECT_NEAR(at_height.svf[n], on_ground.svf[n], height_rounding);
    const PointAnswers by_placing = evaluate_points(package_, {std::span(x).subspan(n, 1), std::span(y).subspan(n, 1)},
                                                    {HeightAbove::sea_level, on_ground.height_m[n]});
    EXPECT_NEAR(by_placing.svf[0], on_ground.svf[n], height_rounding);
  }
}

/// The receivers of surfaces, asked for as points.
TEST_F(Answers, PointsWithNormalsAreTheReceiversOfSurfaces) {
  EvaluationSettings settings;
  settings.engine = Engine::exact;  // other engines answer 16 neighbors at once, which round alike only when they are the same
  std::vector<double> x, y, z;
  std::vector<Angle> azimuth, tilt;
  std::vector<std::optional<double>> svf;
  (void)evaluate_surfaces(package_, {SurfaceChoice::all, 3.0}, settings, [&](std::size_t, std::span<const SurfacePoint> points) {
    for (const SurfacePoint& p : points) {
      x.push_back(p.p_projected.x);
      y.push_back(p.p_projected.y);
      z.push_back(p.p_projected.z);
      azimuth.push_back(p.azimuth);
      tilt.push_back(p.tilt);
      svf.push_back(p.svf);
    }
  });
  const PointAnswers points = evaluate_points(package_, {x, y, z, azimuth, tilt}, {}, settings);
  std::size_t compared = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    if (!svf[n] || std::isnan(points.svf[n])) continue;
    EXPECT_NEAR(points.svf[n], *svf[n], few_rays) << n;
    ++compared;
  }
  EXPECT_GT(compared, x.size() / 2);
}

TEST_F(Answers, APointLooksUpUnlessItHasANormal) {
  const Point2d p = middle_of(package_);
  const std::vector<double> x(4, p.x), y(4, p.y), z(4, 1e4);  // far above the roofs
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Angle> azimuth{Angle::degrees(nan), Angle::degrees(20.0), Angle::degrees(-90.0), Angle::degrees(360.0)};
  const std::vector<Angle> tilt{Angle::degrees(nan), Angle{}, Angle::degrees(90.0), Angle::degrees(180.0)};
  const PointAnswers answers = evaluate_points(package_, {x, y, z, azimuth, tilt});
  EXPECT_EQ(answers.svf[0], 1.0F);
  EXPECT_EQ(answers.svf[1], 1.0F);
  EXPECT_NEAR(answers.svf[2], 0.5F, few_rays);
  EXPECT_NEAR(answers.svf[3], 0.0F, few_rays);
}

TEST_F(Answers, NoPointsAreNoMistake) {
  const PointAnswers answers = evaluate_points(package_, {});
  EXPECT_TRUE(answers.svf.empty());
  EXPECT_EQ(answers.summary.receivers, 0U);
}

TEST_F(Answers, SayWhatTheSettingsCameTo) {
  EvaluationSettings settings;
  settings.max_error = 0.01;
  settings.verify = 20;
  const Raster raster = evaluate_raster(package_, plan_raster(package_, 8.0), {}, settings);
  const Accuracy& accuracy = raster.summary.accuracy;
  EXPECT_EQ(accuracy.sampling_error, 0.0);
  EXPECT_EQ(accuracy.far_error_allowed, 0.01);
  ASSERT_TRUE(raster.summary.errors);
  EXPECT_EQ(raster.summary.errors->count, 20U);
  EXPECT_LE(raster.summary.errors->max_abs_error, 0.01);
  EXPECT_GE(raster.summary.errors->rays, 20'000U);
}

TEST_F(Answers, TellTheReceiversOfAVerification) {
  EvaluationSettings settings;
  settings.verify = 20;
  const RasterPlan plan = plan_raster(package_, 8.0);
  RunSettings one_thread;
  one_thread.threads = 1;
  const Raster raster = evaluate_raster(package_, plan, {}, settings),
               same = evaluate_raster(package_, plan, {}, settings, one_thread);
  ASSERT_EQ(raster.summary.verified.size(), 20U);
  double error_sum = 0.0;
  for (std::size_t n = 0; n < 20; ++n) {
    const VerifiedReceiver& r = raster.summary.verified[n];
    const auto column = static_cast<std::size_t>((r.p_projected.x - plan.north_west_m.x) / plan.step_m),
               row = static_cast<std::size_t>((plan.north_west_m.y - r.p_projected.y) / plan.step_m);
    EXPECT_EQ(r.svf, raster.svf[row * plan.columns + column]);
    EXPECT_EQ(r.exact, same.summary.verified[n].exact);
    EXPECT_EQ(r.p_projected.x, same.summary.verified[n].p_projected.x);
    const double x = r.p_projected.x, y = r.p_projected.y, z = r.p_projected.z;
    EXPECT_NEAR(evaluate_points(package_, {{&x, 1}, {&y, 1}, {&z, 1}}).svf.front(), r.svf, 0.01);
    error_sum += std::abs(static_cast<double>(r.svf) - static_cast<double>(r.exact));
  }
  EXPECT_NEAR(raster.summary.errors->mean_abs_error, error_sum / 20.0, arithmetic_error);
  settings.verify = 0;
  EXPECT_TRUE(evaluate_raster(package_, plan, {}, settings).summary.verified.empty());
}

/// Rays answer from box maps, whatever the engine: the error is theirs. Beyond the grid, horizons see all of a small city.
TEST_F(Answers, SayTheErrorOfWhatAnswered) {
  EvaluationSettings horizons;
  horizons.engine = Engine::horizon;
  EvaluationSettings rays;
  rays.engine = Engine::exact;
  const double of_rays = accuracy_of(rays).sampling_error;
  ASSERT_LT(accuracy_of(horizons).sampling_error, of_rays);
  const Point2d beyond = package_.description().outline_projected.high;
  const std::vector<double> x{beyond.x + 150.0}, y{beyond.y + 150.0};
  const PointAnswers outside = evaluate_points(package_, {x, y}, {}, horizons);
  ASSERT_EQ(outside.summary.outside_of_grid, 1U);
  EXPECT_EQ(outside.summary.accuracy.sampling_error, accuracy_of(horizons).sampling_error);
  EXPECT_EQ(evaluate_points(package_, {x, y}, {}, rays).summary.accuracy.sampling_error, of_rays);
  const PackedSample boxes(FarMapKind::box);
  const Package package(boxes.folder());
  EXPECT_EQ(evaluate_raster(package, plan_raster(package, 8.0), {}, horizons).summary.accuracy.sampling_error, of_rays);
}

TEST(RasterTiles, HavePixelsWithinTheRasterOnly) {
  EXPECT_EQ(pixels_of_tile(0, 300), 256U);
  EXPECT_EQ(pixels_of_tile(1, 300), 44U);
  EXPECT_EQ(pixels_of_tile(2, 300), 0U);
  EXPECT_EQ(pixels_of_tile(1, 256), 0U);
  EXPECT_EQ(pixels_of_tile(std::numeric_limits<std::size_t>::max() / 2, 300), 0U);
}

/// A caller may close the package in his callback; the run ends as if he had not.
TEST_F(Answers, ARunOutlivesItsPackage) {
  const RasterPlan plan = plan_raster(package_, 4.0);
  const Raster whole = evaluate_raster(package_, plan);
  RunSettings run;
  run.on_progress = [this](const Progress&) { package_.close(); };
  const Raster closed = evaluate_raster(package_, plan, {}, {}, run);
  EXPECT_FALSE(package_.is_open());
  EXPECT_EQ(std::memcmp(closed.svf.data(), whole.svf.data(), whole.svf.size() * sizeof(float)), 0);
}

/// Far maps for the cells in the middle: the figures of the library say which receivers have none.
TEST_F(Answers, ReceiversWithoutAFarMapAreCountedAndExact) {
  const scenes::TemporaryFolder folder;
  PackSettings packing = PackedSample::shared().settings();
  packing.output = folder.path() / "part.farlod";
  const Point2d middle = middle_of(package_);
  packing.area = Box2d{middle, middle + Point2d{1.0, 1.0}};
  Report report;
  const PackResult packed = pack(packing, report);
  const Package part(packing.output);
  EXPECT_EQ(packed.package.cells_with_far_map, part.description().cells_with_far_map);
  EXPECT_LT(part.description().cells_with_far_map,
            static_cast<std::uint64_t>(part.description().columns * part.description().rows));
  EXPECT_EQ(package_.description().cells_with_far_map,
            static_cast<std::uint64_t>(package_.description().columns * package_.description().rows));
  const RasterPlan plan = plan_raster(part, 4.0);
  const Raster raster = evaluate_raster(part, plan);
  EvaluationSettings settings;
  EXPECT_GT(raster.summary.without_far_map, 0U);
  EXPECT_LT(raster.summary.without_far_map, raster.summary.receivers);
  EXPECT_EQ(evaluate_raster(package_, plan).summary.without_far_map, 0U);
  // Each pixel has the answer of one of the two
  settings.engine = Engine::exact;
  const Raster exact = evaluate_raster(part, plan, {}, settings), whole = evaluate_raster(package_, plan);
  std::size_t exact_alone = 0;
  for (std::size_t n = 0; n < raster.svf.size(); ++n) {
    if (std::isnan(raster.svf[n])) continue;
    EXPECT_TRUE(raster.svf[n] == exact.svf[n] || raster.svf[n] == whole.svf[n]) << n;
    exact_alone += raster.svf[n] != whole.svf[n] ? 1 : 0;
  }
  EXPECT_LE(exact_alone, raster.summary.without_far_map);
  EXPECT_GT(exact_alone, raster.summary.without_far_map / 2);
  settings.engine = Engine::horizon;
  EXPECT_THROW((void)evaluate_raster(part, plan, {}, settings), PackageUnusable);
}

}  // namespace
}  // namespace farlod::library
