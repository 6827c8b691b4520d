// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "evaluate/verification.hpp"
#include "farlod/surface_kind.hpp"
#include "occlusion/crown_occluder.hpp"
#include "receivers/point_receivers.hpp"
#include "scene/canopy_around.hpp"
#include "scene/ray_scenes.hpp"
#include "tests/agreement/random_receivers.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/packed_once.hpp"
#include "tests/scenes/planted_crowns.hpp"

// View factors by class of a town with 60 trees a hectare: against the engine `exact`, and against single rays in random
// directions whose classes follow from the triangle that each meets.

namespace farlod {
namespace {

constexpr double viewed_town_m = 300.0;
constexpr std::size_t viewed_trees = 540;

PackageReader viewed_town() {
  const auto pack = [](const std::filesystem::path& folder) {
    const CityModel city = scenes::generated_town({.size_m = viewed_town_m, .lod = 2, .overhangs = true});
    scenes::pack_city(city, scenes::grid_covering(city, Angle::degrees(23.0), 50.0, 3), folder / "town.farlod");
    CrownsOfCity crowns = scenes::random_crowns(PackageReader(folder / "town.farlod"), viewed_trees);
    scenes::plant(crowns, folder / "town.farlod");
    return true;
  };
  return PackageReader(scenes::packed_once({"viewed_town", "", scenes::this_program()}, pack) / "town.farlod");
}

/// Of 200 receivers in streets, and as many on roofs and walls.
std::vector<CellReceivers> viewers(const PackageReader& package) {
  RandomSky random;
  std::vector<CellReceivers> all;
  std::size_t index = 0, found = 0;
  for (; index < 200; ++index) {
    all.push_back(random.receiver(package));
    all.back().receivers[0].index = index;
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(package.grid().cells.size()); ++n) {
    const Cell cell = package.grid().cells.cell_at(n);
    all.push_back({cell, {}});
    for (const SurfaceReceiver& r : surface_receivers(package, cell, SurfaceChoice::all, 6.0))
      if (!r.is_inside_building && ++found % 20 == 0) all.back().receivers.push_back({index++, r.p_cell, r.normal});
  }
  return all;
}

constexpr Quantities whole_views{.view_factors = true}, both_views{.view_factors = true, .view_factors_below = true};

struct ViewsOfAll {
  std::vector<float> svf, values;
  [[nodiscard]] std::vector<double> column(std::size_t n) const {
    std::vector<double> result;
    for (std::size_t at = n; at < values.size(); at += values.size() / svf.size())
      result.push_back(static_cast<double>(values[at]));
    return result;
  }
};

ViewsOfAll views_of(const PackageReader& package, const SkySettings& settings, const std::vector<CellReceivers>& places) {
  std::size_t count = 0;
  for (const CellReceivers& cell : places) count += cell.receivers.size();
  const SkyEvaluator evaluator(package, settings);
  ViewsOfAll views{std::vector<float>(count), std::vector<float>(count * evaluator.further_columns())};
  for (const CellReceivers& cell : places) evaluator.evaluate(cell, SkyAnswers(views.svf, {}, {}, views.values));
  return views;
}

TEST(ViewFactorsOfTown, OfAllEnginesAreThoseOfManyRays) {
  const PackageReader package = viewed_town();
  const std::vector<CellReceivers> places = viewers(package);
  SkySettings exact{.engine = Engine::exact, .rays = 20000, .directions = DirectionSet::fibonacci, .further = both_views};
  const ViewsOfAll expected = views_of(package, exact, places);
  ASSERT_GT(expected.svf.size(), 350U);
  const std::vector<std::string> names = columns_of(both_views);
  for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact}) {
    const ViewsOfAll got = views_of(package, {.engine = engine, .further = both_views}, places);
    for (std::size_t n = 0; n < names.size(); ++n) {
      const ErrorSummary errors = summarize_errors(got.column(n), expected.column(n));
      EXPECT_LE(errors.mean_abs_error, 0.003) << names[n];
      EXPECT_LE(errors.max_abs_error, 0.025) << names[n];
    }
    for (std::size_t r = 0; r < got.svf.size(); ++r) {
      double sum = 0.0;
      for (std::size_t n = 0; n < view_class_count; ++n) sum += static_cast<double>(got.values[r * names.size() + n]);
      EXPECT_NEAR(sum, 1.0, 1e-5);
      for (std::size_t n = 0; n < names.size(); ++n) EXPECT_GE(got.values[r * names.size() + n], 0.0F) << names[n];
    }
  }
}

/// What single rays meet in the whole city. The class of a triangle follows from its corners: which side is seen, and how it
/// lies; only ground is told by its kind.
class SingleRays {
 public:
  explicit SingleRays(const PackageReader& package)
      : package_(package), city_(package, {}), crowns_(city_.crowns({})), solid_(city_.city().occluder()) {
    const CellRange& cells = package.grid().cells;
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
      const TileView tile = package.tile(cells.cell_at(n));
      for (std::uint32_t t = 0; t < tile.mesh.triangles.size(); ++t) triangles_.push_back({tile, t});
    }
  }

  [[nodiscard]] std::size_t seen(const Point3f& from, const Point3d& towards) const {
    const Ray ray{
        from, {static_cast<float>(towards.x), static_cast<float>(towards.y), static_cast<float>(towards.z)}, least_distance_m};
    const auto hit = solid_.nearest(ray);
    Ray to_hit = ray;
    if (hit) to_hit.end = hit->distance;
    if (crowns_.light(to_hit).is_met()) return 7;
    if (!hit) return towards.z > 0.0 ? 0 : 1;
    return class_of_triangle(triangles_.at(hit->triangle), towards);
  }
  [[nodiscard]] Point3f place(const Receiver& r, Cell cell) const { return city_.city().scene_from_cell(r.p_cell, cell); }

 private:
  struct OfTile {
    TileView tile;
    std::uint32_t number;
  };
  [[nodiscard]] std::size_t class_of_triangle(const OfTile& triangle, const Point3d& towards) const {
    const SurfaceKind kind = triangle.tile.surface_of(triangle.number).kind();
    if (kind == SurfaceKind::ground) return 1;
    const Triangle& t = triangle.tile.mesh.triangles[triangle.number];
    const auto corner = [&](std::uint32_t n) {
      const Point3f& p = triangle.tile.mesh.vertices[n];
      return Point3d{p.x, p.y, p.z};
    };
    Point3d side = normalized(cross(corner(t.b) - corner(t.a), corner(t.c) - corner(t.a)));
    if (dot(side, towards) > 0.0) side = -1.0 * side;
    if (side.z < -0.26) return 8;
    if (side.z > 0.26) return 2;
    const Point3d city = package_.grid().rotation.city_from_grid(side);
    const double degrees =
        std::atan2(city.x, city.y) * 180.0 / std::numbers::pi + package_.manifest().convergence.degrees() + 720.0;
    return 3 + static_cast<std::size_t>((degrees + 45.0) / 90.0) % 4;
  }

  const PackageReader& package_;
  WholeCityOnDemand city_;
  const CrownOccluder& crowns_;
  const Occluder& solid_;
  std::vector<OfTile> triangles_;
};

TEST(ViewFactorsOfTown, AreWhatSingleRaysMeet) {
  const PackageReader package = viewed_town();
  const SingleRays rays(package);
  RandomSky random;
  constexpr std::size_t ray_count = 4000;
  std::vector<CellReceivers> places = viewers(package);
  std::array<double, view_class_count> sums{}, got_sums{};
  std::size_t compared = 0;
  for (std::size_t n = 0; n < places.size(); n += 7) {
    if (places[n].receivers.empty()) continue;
    Receiver r = places[n].receivers.front();
    r.index = 0;
    const ViewsOfAll got =
        views_of(package, {.engine = Engine::exact, .rays = 4000, .further = whole_views}, {{places[n].cell, {r}}});
    const Point3d up = normalized(Point3d{r.normal.x, r.normal.y, r.normal.z});
    std::array<double, view_class_count> shares{};
    double weight = 0.0;
    for (std::size_t k = 0; k < ray_count; ++k) {
      Point3d d = random.direction_above_horizon();
      if (random.uniform(0.0, 1.0) < 0.5) d.z = -d.z;
      const double cosine = dot(d, up);
      if (cosine <= 0.0) continue;
      weight += cosine;
      shares.at(rays.seen(rays.place(r, places[n].cell), d)) += cosine;
    }
    for (std::size_t c = 0; c < view_class_count; ++c) {
      // Five times the deviation of so many random rays
      EXPECT_NEAR(got.values[c], shares[c] / weight, 0.06) << c;
      sums[c] += shares[c] / weight;
      got_sums[c] += got.values[c];
    }
    ++compared;
  }
  ASSERT_GT(compared, 25U);
  for (std::size_t c = 0; c < view_class_count; ++c) EXPECT_NEAR(got_sums[c], sums[c], 0.01 * static_cast<double>(compared)) << c;
  for (std::size_t c = 0; c + 1 < view_class_count; ++c)
    EXPECT_GT(sums[c], 0.005 * static_cast<double>(compared)) << "class " << c << " is seen too little to tell";
}

}  // namespace
}  // namespace farlod
