// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <numbers>
#include <ostream>
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

PackageReader viewed_town(int turned_deg = 0) {
  const auto pack = [=](const std::filesystem::path& folder) {
    const CityModel city = scenes::generated_town(
        {.size_m = viewed_town_m, .rotation_deg = static_cast<double>(turned_deg), .lod = 2, .overhangs = true});
    scenes::pack_city(city, scenes::grid_covering(city, Angle::degrees(23.0), 50.0, 3), folder / "town.farlod");
    CrownsOfCity crowns = scenes::random_crowns(PackageReader(folder / "town.farlod"), viewed_trees);
    scenes::plant(crowns, folder / "town.farlod");
    return true;
  };
  return PackageReader(scenes::packed_once({"viewed_town", std::to_string(turned_deg), scenes::this_program()}, pack) /
                       "town.farlod");
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

constexpr Quantities all_views{.view_factors = true,
                               .view_factors_below = true,
                               .view_cube = true,
                               .view_sphere = true,
                               .view_eye = true,
                               .wall_sectors = 8};

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
  // The faces of a cube are view factors of six receivers more, which single rays tell below
  Quantities asked = all_views;
  asked.view_cube = false;
  SkySettings exact{.engine = Engine::exact, .rays = 20000, .directions = DirectionSet::fibonacci, .further = asked};
  const ViewsOfAll expected = views_of(package, exact, places);
  ASSERT_GT(expected.svf.size(), 350U);
  const std::vector<std::string> names = columns_of(asked);
  for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact}) {
    const ViewsOfAll got = views_of(package, {.engine = engine, .further = asked}, places);
    for (std::size_t n = 0; n < names.size(); ++n) {
      const ErrorSummary errors = summarize_errors(got.column(n), expected.column(n));
      EXPECT_LE(errors.mean_abs_error, 0.003) << names[n];
      EXPECT_LE(errors.max_abs_error, 0.025) << names[n];
    }
    for (std::size_t r = 0; r < got.svf.size(); ++r) {
      // Each of the three quantities beside the one below the horizontal adds up to 1
      double sum = 0.0;
      for (std::size_t n = 0; n < names.size(); ++n)
        if (!names[n].ends_with("_below")) sum += static_cast<double>(got.values[r * names.size() + n]);
      EXPECT_NEAR(sum, 3.0, 3e-5);
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

  /// A column of a view, with walls by so many azimuths.
  [[nodiscard]] std::size_t seen(const Point3f& from, const Point3d& towards, std::size_t sectors) const {
    const Ray ray{
        from, {static_cast<float>(towards.x), static_cast<float>(towards.y), static_cast<float>(towards.z)}, least_distance_m};
    const auto hit = solid_.nearest(ray);
    Ray to_hit = ray;
    if (hit) to_hit.end = hit->distance;
    if (crowns_.light(to_hit).is_met()) return 3 + sectors;
    if (!hit) return towards.z > 0.0 ? 0 : 1;
    return column_of_triangle(triangles_.at(hit->triangle), towards, sectors);
  }
  [[nodiscard]] Point3f place(const Receiver& r, Cell cell) const { return city_.city().scene_from_cell(r.p_cell, cell); }

 private:
  struct OfTile {
    TileView tile;
    std::uint32_t number;
  };
  [[nodiscard]] std::size_t column_of_triangle(const OfTile& triangle, const Point3d& towards, std::size_t sectors) const {
    const SurfaceKind kind = triangle.tile.surface_of(triangle.number).kind();
    if (kind == SurfaceKind::ground) return 1;
    const Triangle& t = triangle.tile.mesh.triangles[triangle.number];
    const auto corner = [&](std::uint32_t n) {
      const Point3f& p = triangle.tile.mesh.vertices[n];
      return Point3d{p.x, p.y, p.z};
    };
    Point3d side = normalized(cross(corner(t.b) - corner(t.a), corner(t.c) - corner(t.a)));
    if (dot(side, towards) > 0.0) side = -1.0 * side;
    if (side.z < -0.26) return 4 + sectors;
    if (side.z > 0.26) return 2;
    const Point3d city = package_.grid().rotation.city_from_grid(side);
    const double degrees =
        std::atan2(city.x, city.y) * 180.0 / std::numbers::pi + package_.manifest().convergence.degrees() + 720.0;
    const double width_deg = 360.0 / static_cast<double>(sectors);
    return 3 + static_cast<std::size_t>((degrees + 0.5 * width_deg) / width_deg) % sectors;
  }

  const PackageReader& package_;
  WholeCityOnDemand city_;
  const CrownOccluder& crowns_;
  const Occluder& solid_;
  std::vector<OfTile> triangles_;
};

/// A view of a receiver among its columns, and how it weights directions.
struct WeightedView {
  Quantity quantity;
  std::size_t face = 0;
  std::function<double(const Point3d&)> weight;
  std::vector<double> shares = {};
  double all = 0.0;

  void add(const Point3d& direction, std::size_t column) {
    const double w = std::max(0.0, weight(direction));
    shares[column] += w;
    all += w;
  }
};

std::vector<WeightedView> views_with_weights(const PackageReader& package, const Point3d& normal, std::size_t columns) {
  const auto facing = [](const Point3d& n) { return [n](const Point3d& d) { return dot(n, d); }; };
  const auto towards = [&](double azimuth_deg) {
    const Angle azimuth = Angle::degrees(azimuth_deg) - package.manifest().convergence;
    return facing(package.grid().rotation.grid_from_city(Point3d{sin(azimuth), cos(azimuth), 0.0}));
  };
  std::vector<WeightedView> views{{Quantity::view_factors, 0, facing(normal)},
                                  {Quantity::view_sphere, 0, [](const Point3d&) { return 1.0; }},
                                  {Quantity::view_eye, 0, [](const Point3d& d) { return std::abs(d.z) < 0.5 ? 1.0 : 0.0; }},
                                  {Quantity::view_cube, 0, facing({0.0, 0.0, 1.0})},
                                  {Quantity::view_cube, 1, facing({0.0, 0.0, -1.0})}};
  for (const std::size_t n : {0U, 1U, 2U, 3U})
    views.push_back({Quantity::view_cube, 2 + n, towards(90.0 * static_cast<double>(n))});
  for (WeightedView& view : views) view.shares.resize(columns);
  return views;
}

struct Sectors {
  std::size_t count;
  int town_turned_deg;  ///< walls of the generated town face four azimuths
};
void PrintTo(const Sectors& sectors, std::ostream* out) { *out << sectors.count << ", " << sectors.town_turned_deg; }

class ViewsOfTownBySectors : public testing::TestWithParam<Sectors> {};

TEST_P(ViewsOfTownBySectors, AreWhatSingleRaysMeet) {
  const auto [sectors, turned_deg] = GetParam();
  const PackageReader package = viewed_town(turned_deg);
  const SingleRays rays(package);
  RandomSky random;
  constexpr std::size_t ray_count = 8000;
  Quantities asked = all_views;
  asked.wall_sectors = sectors;
  const std::size_t columns = 5 + sectors;
  std::vector<double> sums(columns), got_sums(columns);
  std::size_t compared = 0;
  const std::vector<CellReceivers> places = viewers(package);
  for (std::size_t n = 0; n < places.size(); n += 7) {
    if (places[n].receivers.empty()) continue;
    Receiver r = places[n].receivers.front();
    r.index = 0;
    const ViewsOfAll got = views_of(package, {.engine = Engine::exact, .rays = 4000, .further = asked}, {{places[n].cell, {r}}});
    std::vector<WeightedView> views =
        views_with_weights(package, normalized(Point3d{r.normal.x, r.normal.y, r.normal.z}), columns);
    for (std::size_t k = 0; k < ray_count; ++k) {
      Point3d d = random.direction_above_horizon();
      if (random.uniform(0.0, 1.0) < 0.5) d.z = -d.z;
      const std::size_t column = rays.seen(rays.place(r, places[n].cell), d, sectors);
      for (WeightedView& view : views) view.add(d, column);
    }
    for (const WeightedView& view : views)
      for (std::size_t c = 0; c < columns; ++c) {
        const double value = got.values[range_of(view.quantity, asked).first + view.face * columns + c];
        // Five times the deviation of so many random rays
        EXPECT_NEAR(value, view.shares[c] / view.all, 0.06) << static_cast<int>(view.quantity) << ' ' << view.face << ' ' << c;
        sums[c] += view.shares[c] / view.all;
        got_sums[c] += value;
      }
    compared += views.size();
  }
  ASSERT_GT(compared, 225U);
  for (std::size_t c = 0; c < columns; ++c)
    EXPECT_NEAR(got_sums[c], sums[c], 0.01 * static_cast<double>(compared)) << "class " << c;
  // Sky, ground, roofs, walls of four azimuths, and crowns
  EXPECT_GE(std::ranges::count_if(sums, [&](double sum) { return sum > 0.005 * static_cast<double>(compared); }), 8);
}

INSTANTIATE_TEST_SUITE_P(OfTheTurn, ViewsOfTownBySectors, testing::Values(Sectors{4, 0}, Sectors{8, 0}, Sectors{8, 30}));

}  // namespace
}  // namespace farlod
