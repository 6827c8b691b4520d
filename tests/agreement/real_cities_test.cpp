// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>
#include <vector>

#include "align/align.hpp"
#include "evaluate/sky_directions.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "georeference/georeference.hpp"
#include "ingest/files/input_search.hpp"
#include "ingest/ingest.hpp"
#include "receivers/point_receivers.hpp"
#include "scene/ray_scenes.hpp"
#include "tests/agreement/random_receivers.hpp"
#include "tests/agreement/ray_oracle.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/test_data.hpp"
#include "tiles/tiles.hpp"

// Cities as they are, against CGAL's AABB tree: facets as they were before anything was turned, cut or rounded.

namespace farlod {
namespace {

constexpr std::size_t rays = 1000, receivers_of_kind = 120;

/// A city from its file to its package, and its oracle.
class CityWithOracle {
 public:
  CityWithOracle(const std::filesystem::path& file, const std::filesystem::path& folder) {
    Report report;
    const std::vector inputs{file};
    georeference::GeoreferenceSettings georeference_settings;
    LocatedCity located = georeference::georeference(
        ingest::ingest_all(ingest::find_input_files(inputs, report).files, {}, report), georeference_settings, report);
    const Grid grid = align::align(located, {}, report).grid;
    const CityModel city = located.city;
    const TileSet tiles = tiles::cut_into_tiles(std::move(located), grid, Assign::clip, std::nullopt, report);
    scenes::pack_tiles(tiles, grid, folder, {});
    package_.emplace(folder);
    oracle_.emplace(city, ground_of(tiles, grid));
  }

  [[nodiscard]] const PackageReader& package() const { return *package_; }
  /// The share of a receiver's rays that meet nothing.
  [[nodiscard]] double free_share(Cell cell, const Receiver& r, std::span<const Point3d> directions_grid, std::size_t all) const {
    const Grid& grid = package_->grid();
    const Point2d corner = grid.corner_of(cell);
    const Point3d p_city = grid.rotation.city_from_grid(
        Point3d{corner.x + r.p_cell.x, corner.y + r.p_cell.y, r.p_cell.z + package_->manifest().height_origin_m});
    std::size_t free = 0;
    for (const Point3d& d : directions_grid) free += oracle_->blocks(p_city, grid.rotation.city_from_grid(d)) ? 0 : 1;
    return static_cast<double>(free) / static_cast<double>(all);
  }

 private:
  /// The ground between the buildings, and what closes their feet, are of the package's making.
  static std::vector<RayOracle::Corners> ground_of(const TileSet& tiles, const Grid& grid) {
    std::vector<RayOracle::Corners> ground;
    for (std::size_t n = 0; n < tiles.tiles.size(); ++n) {
      const Tile& tile = tiles.tiles[n];
      const Point2d corner = grid.corner_of(grid.cells.cell_at(n));
      const auto place = [&](std::uint32_t v) {
        const Point3f& p = tile.vertices[v];
        return grid.rotation.city_from_grid(Point3d{corner.x + p.x, corner.y + p.y, p.z + tiles.height_origin_m});
      };
      for (std::size_t t = 0; t < tile.triangles.size(); ++t) {
        const SurfaceKind kind = tiles.surfaces[tile.triangle_surfaces[t]].kind;
        if (kind != SurfaceKind::ground && kind != SurfaceKind::foundation) continue;
        const Triangle& c = tile.triangles[t];
        ground.push_back({place(c.a), place(c.b), place(c.c)});
      }
    }
    return ground;
  }

  std::optional<PackageReader> package_;
  std::optional<RayOracle> oracle_;
};

/// Receivers of a kind, spread over the city.
struct Chosen {
  std::vector<CellReceivers> cells;
};
Chosen some_of_ground(const PackageReader& package) {
  RandomSky random;
  Chosen chosen;
  for (std::size_t n = 0; n < receivers_of_kind; ++n) chosen.cells.push_back(random.receiver(package));
  return chosen;
}
Chosen some_of_surfaces(const PackageReader& package, SurfaceChoice choice) {
  std::vector<CellReceivers> all;
  const CellRange& cells = package.grid().cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n)
    for (const SurfaceReceiver& r : surface_receivers(package, cells.cell_at(n), choice, 4.0))
      if (!r.is_inside_building) all.push_back({cells.cell_at(n), {{0, r.p_cell, r.normal}}});
  Chosen chosen;
  const std::size_t step = std::max<std::size_t>(1, all.size() / receivers_of_kind);
  for (std::size_t n = 0; n < all.size(); n += step) chosen.cells.push_back(all[n]);
  return chosen;
}

void expect_agreement(const CityWithOracle& city, const Chosen& chosen, const std::string& kind) {
  const PackageReader& package = city.package();
  SkySettings exact, horizons;
  exact.engine = Engine::exact;
  exact.rays = horizons.rays = rays;
  horizons.azimuths = 1024;
  const SkyEvaluator exactly(package, exact), by_horizons(package, horizons);
  const SkyDirections directions(SkyWeight::cosine, rays, package.grid().rotation);
  // Rays that pass an edge within the rounding of a place may be counted either way: one in a hundred at the most
  constexpr double grazing = 0.01;
  const double sampling = sampling_error_of(exact) + sampling_error_of(horizons);
  std::vector<double> errors;
  for (const CellReceivers& r : chosen.cells) {
    const Point3f& n = r.receivers[0].normal;
    const std::vector<Point3d> around = directions.facing(normalized(Point3d{n.x, n.y, n.z}));
    const double expected = city.free_share(r.cell, r.receivers[0], around, directions.ray_count());
    std::array<float, 1> by_exact{}, by_auto{};
    exactly.evaluate(r, by_exact);
    by_horizons.evaluate(r, by_auto);
    const Point3f& p = r.receivers[0].p_cell;
    EXPECT_NEAR(by_exact[0], expected, grazing)
        << kind << " of cell " << r.cell.i << "," << r.cell.j << " at " << p.x << " " << p.y << " " << p.z;
    EXPECT_NEAR(by_auto[0], expected, sampling)
        << kind << " of cell " << r.cell.i << "," << r.cell.j << " at " << p.x << " " << p.y << " " << p.z;
    errors.push_back(std::abs(by_auto[0] - expected));
  }
  ASSERT_GE(errors.size(), receivers_of_kind);
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  EXPECT_LT(mean, 0.2 * sampling) << kind;
}

class RealCityAgreement : public testing::TestWithParam<const char*> {};

TEST_P(RealCityAgreement, EnginesSeeWhatCgalSees) {
  const std::filesystem::path file = scenes::test_data(GetParam());
  if (!std::filesystem::exists(file)) GTEST_SKIP() << scenes::absence_of(file);
  const scenes::TemporaryFolder folder;
  const CityWithOracle city(file, folder.path() / "city.farlod");
  expect_agreement(city, some_of_ground(city.package()), "ground");
  expect_agreement(city, some_of_surfaces(city.package(), SurfaceChoice::roofs), "roof");
  expect_agreement(city, some_of_surfaces(city.package(), SurfaceChoice::walls), "wall");
}

INSTANTIATE_TEST_SUITE_P(Cities, RealCityAgreement,
                         testing::Values("rotterdam/delfshaven.city.json", "tokyo/53392633_bldg_6697_2_op.gml"),
                         [](const auto& city) { return city.index == 0 ? "Rotterdam" : "Tokyo"; });

}  // namespace
}  // namespace farlod
