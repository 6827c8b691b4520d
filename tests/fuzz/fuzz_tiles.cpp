// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <span>
#include <vector>

#include "base/expects.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "farlod/error.hpp"
#include "package/layout.hpp"
#include "package/package_reader.hpp"
#include "receivers/point_receivers.hpp"
#include "scene/ray_scenes.hpp"
#include "scene/vertical_profile.hpp"
#include "tests/fuzz/fuzzed_package.hpp"

namespace farlod {
namespace {

/// Not of any size: most surfaces of a changed tile have as few receivers as before.
constexpr double surface_spacing_m = 1000.0, most_area_m2 = 1e8;

void visit_tile(const BlockTiles& block, const TileView& tile) {
  std::size_t edges = 0;
  tile.visit_edges([&](const HorizonEdge& e) { edges += std::isfinite(e.a.x) && std::isfinite(e.b.z) ? 1 : 0; });
  for (std::uint32_t t = 0; t < tile.mesh.triangles.size(); ++t) {
    const package::SurfaceRecord& surface = tile.surface_of(t);
    FARLOD_EXPECTS(std::isfinite(surface.normal().direction().z));
    if (surface.building != package::no_building) (void)block.id_of(tile.buildings[surface.building]).size();
  }
}

double area_of(const TileView& tile) {
  double area_m2 = 0.0;
  for (const Triangle& t : tile.mesh.triangles) {
    const Point3f a = tile.mesh.vertices[t.a];
    area_m2 += 0.5 * norm(cross(tile.mesh.vertices[t.b] - a, tile.mesh.vertices[t.c] - a));
  }
  return area_m2;
}

void evaluate(const PackageReader& package, Cell cell, Engine engine) {
  const SkyEvaluator evaluator(package, {engine, SkyWeight::cosine, 37, std::nullopt, DirectionSet::partition, 16});
  CellReceivers receivers{cell, {}};
  for (const float x : {1.0F, 12.5F, 24.0F, 49.0F})
    for (const float z : {-3.0F, 1.5F, 30.0F}) receivers.receivers.push_back({receivers.receivers.size(), {x, 25.0F, z}});
  std::vector<float> svf(receivers.receivers.size()), low(svf.size()), high(svf.size());
  evaluator.evaluate(receivers, SkyAnswers(svf, low, high));
  for (const float value : svf) FARLOD_EXPECTS(std::isnan(value) || (0.0F <= value && value <= 1.0F));
}

void query(const PackageReader& package, Cell cell) {
  const BlockTiles& block = package.block_tiles(cell);
  const TileView tile = block.tile(cell);
  visit_tile(block, tile);
  (void)near_scene(package, cell);
  (void)PointLocator(package, cell).at(12.5F, 25.0F);
  if (area_of(tile) < most_area_m2)
    expect_answer_or_refusal([&] { (void)surface_receivers(package, cell, SurfaceChoice::all, surface_spacing_m, {}); });
  for (const Engine engine : {Engine::automatic, Engine::horizon, Engine::rays, Engine::exact})
    expect_answer_or_refusal([&] { evaluate(package, cell, engine); });
}

/// The sample as it is, but for the tiles of its first block.
class Sample {
 public:
  Sample() : disk_(sample_packages()[0]) {
    for (const package::BlockFiles& files : disk_.manifest().blocks)
      tiles_.push_back(file_bytes(sample_packages()[0] / package::folder_of(files) / package::tiles_file));
  }
  [[nodiscard]] CellRange cells_of_first() const { return disk_.grid().cells_of(disk_.manifest().blocks[0].block); }
  /// Far maps have what the changed tiles say of them.
  [[nodiscard]] PackageInMemory with(std::span<const std::byte> bytes) const {
    PackageInMemory memory{disk_.manifest(), {tiles_.begin(), tiles_.end()}, {}};
    memory.tiles[0] = bytes;
    const BlockTiles block(bytes, cells_of_first(), "tiles.bin");
    if (!block.has_far_cells()) throw PackageDamaged("tiles.bin has no far cells");
    for (std::size_t n = 0; n < static_cast<std::size_t>(disk_.grid().cells.size()); ++n) {
      const Cell cell = disk_.grid().cells.cell_at(n);
      memory.far_horizons.emplace(cell, far_map_of(cell, block));
    }
    return memory;
  }

 private:
  [[nodiscard]] FarHorizon far_map_of(Cell cell, const BlockTiles& block) const {
    FarHorizon map = disk_.far_horizon(cell);
    if (!cells_of_first().contains(cell)) return map;
    const package::FarMapShape& shape = disk_.manifest().far_map;
    map.patches = ReceiverPatches(disk_.grid().cell_edge_m, shape.squares_per_edge, block.levels_m(cell, shape.layers));
    map.occluders = block.explicit_occluders(cell, disk_.grid().cell_edge_m);
    return map;
  }

  PackageReader disk_;
  std::vector<std::vector<std::byte>> tiles_;
};

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  static const Sample sample;
  const auto all = std::as_bytes(std::span(data, size));
  std::vector<std::byte> bytes(all.begin(), all.end());
  mend_tiles(bytes);
  expect_answer_or_refusal([&] {
    const PackageReader package(sample.with(bytes));
    const CellRange cells = sample.cells_of_first();
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) query(package, cells.cell_at(n));
  });
  return 0;
}
