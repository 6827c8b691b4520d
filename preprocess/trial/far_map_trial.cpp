// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "trial/far_map_trial.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "package/package_reader.hpp"
#include "package/package_writer.hpp"
#include "package/tiles_writer.hpp"
#include "receivers/receiver.hpp"

namespace farlod {
namespace {

/// Receivers do not stand within what they stand on.
constexpr float off_surface_m = 0.02F;

/// The sequence of mt19937_64 is fixed by the standard; the distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  double uniform(double high) { return high * static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

package::Manifest manifest_of(const TileSet& tiles, const Grid& grid, Assign assign) {
  package::Manifest manifest;
  manifest.height_origin_m = tiles.height_origin_m;
  manifest.grid = grid;
  manifest.assign = assign == Assign::clip ? "clip" : "whole";
  manifest.far_map.kind = "horizon";
  manifest.triangles = tiles.triangle_count();
  for (const Block block : grid.blocks()) manifest.blocks.push_back({block, {}, {}});
  return manifest;
}

std::vector<CellReceivers> random_receivers(const PackageReader& package, const FarErrorSettings& settings) {
  const CellRange& cells = package.grid().cells;
  Random chosen(settings.seed);
  std::vector<CellReceivers> result;
  std::size_t index = 0;
  for (std::size_t c = 0; c < settings.cells; ++c) {
    const Cell cell = cells.cell_at(chosen.below(static_cast<std::size_t>(cells.size())));
    const PointLocator locator(package, cell);
    Random random(settings.seed + c);
    result.push_back({cell, {}});
    for (std::size_t n = 0; n < settings.receivers_per_cell; ++n) {
      const bool on_ground = n % 2 == 0;
      const auto x = static_cast<float>(random.uniform(package.grid().cell_edge_m));
      const auto y = static_cast<float>(random.uniform(package.grid().cell_edge_m));
      const std::optional<Point3f> p_cell =
          on_ground ? stand(locator, x, y, HeightAbove::ground, static_cast<float>(settings.eye_height_m))
                    : stand(locator, x, y, HeightAbove::highest_surface, off_surface_m);
      if (p_cell) result.back().receivers.push_back({index++, *p_cell});
    }
  }
  return result;
}

std::size_t count_receivers(std::span<const CellReceivers> cells) {
  std::size_t count = 0;
  for (const CellReceivers& cell : cells) count += cell.receivers.size();
  return count;
}

/// The answers of each receiver, by its index.
struct Answers {
  std::vector<float> svf, low, high;
  explicit Answers(std::size_t count) : svf(count), low(count), high(count) {}
};

Answers evaluate(const PackageReader& package, std::span<const CellReceivers> cells, Engine engine, std::size_t rays,
                 const std::stop_token& stop) {
  Answers answers(count_receivers(cells));
  SkySettings settings{engine, SkyWeight::cosine, rays};
  settings.bounds_of_same_rays = true;
  const SkyEvaluator evaluator(package, settings, stop);
  oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t n) {
    evaluator.evaluate(cells[n], SkyAnswers(answers.svf, answers.low, answers.high));
  });
  return answers;
}

FarErrorEstimate compare(const Answers& answers, const Answers& exact, std::size_t rays) {
  // Shares of the rays were rounded to floats: one ray more or less must be exactly one
  const auto free_rays = [rays](float svf) { return std::round(double{svf} * static_cast<double>(rays)); };
  const auto share = [rays](double ray_count) { return ray_count / static_cast<double>(rays); };
  FarErrorEstimate result;
  result.receivers = answers.svf.size();
  if (answers.svf.empty()) return result;
  const auto count = static_cast<double>(result.receivers);
  std::vector<double> half_widths;
  for (std::size_t n = 0; n < answers.svf.size(); ++n) {
    const double estimate = free_rays(answers.svf[n]);
    const double error = share(std::abs(estimate - free_rays(exact.svf[n])));
    result.mean_error += error / count;
    result.max_error = std::max(result.max_error, error);
    half_widths.push_back(share(std::max(free_rays(answers.high[n]) - estimate, estimate - free_rays(answers.low[n]))));
  }
  std::sort(half_widths.begin(), half_widths.end());
  result.p99_half_width = half_widths[static_cast<std::size_t>(std::ceil(0.99 * count)) - 1];
  return result;
}

/// The far map as the runtime holds it once it has been written and read.
FarHorizon as_read(BakedHorizons& baked, std::uint32_t azimuth_bins) {
  BakedHorizon& map = baked.cells.front();
  round_as_stored(map);
  return {map.patches,
          AzimuthBins{azimuth_bins},
          map.low,
          map.estimate,
          map.high,
          map.overhang,
          {baked.edges, map.explicit_edges, {}}};
}

}  // namespace

struct FarMapTrial::Impl {
  const TileSet& tiles;
  Grid grid;
  FarErrorSettings settings;
  std::stop_token stop;
  package::Manifest manifest;
  std::vector<std::vector<std::byte>> tile_bytes;  ///< of each block
  std::vector<CellReceivers> receivers;
  Answers exact{0};

  Impl(const TileSet& t, const Grid& g, Assign assign, const FarErrorSettings& s, std::stop_token asked)
      : tiles(t), grid(g), settings(s), stop(std::move(asked)), manifest(manifest_of(t, g, assign)) {
    for (const Block block : grid.blocks()) tile_bytes.push_back(tiles_file_without_maps(tiles, grid, block));
    const PackageReader package(contents(grid.neighborhood, {}));
    receivers = random_receivers(package, settings);
    exact = evaluate(package, receivers, Engine::exact, settings.rays, stop);
  }

  [[nodiscard]] PackageInMemory contents(int neighborhood, std::map<Cell, FarHorizon> far_horizons) const {
    PackageInMemory result{manifest, {tile_bytes.begin(), tile_bytes.end()}, std::move(far_horizons), tiles.far_terrain.mesh()};
    result.manifest.grid.neighborhood = neighborhood;
    return result;
  }

  /// The cells with receivers, each once.
  [[nodiscard]] std::vector<Cell> chosen_cells() const {
    std::set<Cell> cells;
    for (const CellReceivers& cell : receivers) cells.insert(cell.cell);
    return {cells.begin(), cells.end()};
  }

  [[nodiscard]] double near_triangles_per_cell(const Grid& tried, std::span<const Cell> cells) const {
    std::size_t count = 0;
    for (const Cell cell : cells) {
      const CellRange near = tried.neighborhood_of(cell).intersection(tried.cells);
      for (std::size_t n = 0; n < static_cast<std::size_t>(near.size()); ++n)
        count += tiles.tile(near.cell_at(n)).triangles.size();
    }
    return static_cast<double>(count) / static_cast<double>(cells.size());
  }
};

FarMapTrial::FarMapTrial(const TileSet& tiles, const Grid& grid, Assign assign, const FarErrorSettings& settings,
                         std::stop_token stop)
    : impl_(std::make_unique<Impl>(tiles, grid, assign, settings, std::move(stop))) {}
FarMapTrial::~FarMapTrial() = default;

FarErrorEstimate FarMapTrial::run(int neighborhood, const HorizonMapSettings& far_map) const {
  Grid grid = impl_->grid;
  grid.neighborhood = neighborhood;
  const std::vector<Cell> cells = impl_->chosen_cells();
  if (cells.empty()) return {};
  // Bake the far map of each cell by itself: its edges are in its own frame
  const HorizonMapBaker baker(impl_->tiles, grid, far_map);
  std::vector<BakedHorizons> baked(cells.size());
  oneapi::tbb::parallel_for(std::size_t{0}, cells.size(),
                            [&](std::size_t n) { baked[n] = baker.bake(std::array{cells[n]}, impl_->stop); });
  std::map<Cell, FarHorizon> far_horizons;
  std::size_t explicit_edges = 0;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    far_horizons.emplace(cells[n], as_read(baked[n], far_map.azimuth_bins));
    explicit_edges += baked[n].cells.front().explicit_edges.size();
  }
  // Evaluate with the rays of the exact answers: what differs is due to the far maps
  const PackageReader package(impl_->contents(neighborhood, std::move(far_horizons)));
  FarErrorEstimate result = compare(evaluate(package, impl_->receivers, Engine::rays, impl_->settings.rays, impl_->stop),
                                    impl_->exact, impl_->settings.rays);
  result.explicit_edges_per_cell = static_cast<double>(explicit_edges) / static_cast<double>(cells.size());
  result.near_triangles_per_cell = impl_->near_triangles_per_cell(grid, cells);
  return result;
}

}  // namespace farlod
