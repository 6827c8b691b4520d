// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/far_error_estimate.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "farmap/city_occluder.hpp"
#include "farmap/horizon_map_baker.hpp"
#include "horizon/sky_partition.hpp"
#include "tests/oracles/far_view.hpp"

namespace farlod {
namespace {

/// Receivers do not stand within what they stand on.
constexpr float off_surface_m = 0.02F;
constexpr float least_distance_m = 0.001F;

/// The sequence of mt19937_64 is fixed by the standard; the distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  double uniform(double high) { return high * static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

struct Shares {
  double error = 0.0, doubt = 0.0;
};

struct CellVerdict {
  std::vector<Shares> receivers;
  std::size_t named = 0, near_triangles = 0;
};

class Judge {
 public:
  Judge(const TileSet& tiles, const Grid& grid, const HorizonMapSettings& settings, const FarErrorSettings& how)
      : tiles_(tiles),
        grid_(grid),
        settings_(settings),
        how_(how),
        city_(tiles, grid),
        baker_(tiles, grid, settings),
        directions_(SkyPartition(SkyWeight::cosine, how.rays).directions()),
        fan_(directions_) {}

  [[nodiscard]] CellVerdict judge(Cell cell, std::uint64_t seed) const {
    const BakedHorizons baked = baker_.bake(std::array{cell});
    const BakedHorizon& map = baked.cells.front();
    const FarHorizon far{map.patches,  AzimuthBins{settings_.azimuth_bins}, map.low, map.estimate, map.high,
                         map.overhang, {baked.edges, map.explicit_edges, {}}};
    FarView view(fan_, far);
    CellVerdict verdict;
    verdict.named = map.explicit_edges.size();
    verdict.near_triangles = near_triangles(cell);
    Random random(seed);
    for (std::size_t n = 0; n < how_.receivers_per_cell; ++n)
      if (const auto p_cell = stand(cell, random, n % 2 == 0)) verdict.receivers.push_back(look(cell, *p_cell, view));
    return verdict;
  }

 private:
  [[nodiscard]] std::size_t near_triangles(Cell cell) const {
    const CellRange near = grid_.neighborhood_of(cell).intersection(grid_.cells);
    std::size_t count = 0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(near.size()); ++n)
      count += tiles_.tile(near.cell_at(n)).triangles.size();
    return count;
  }

  /// A place on the ground or on top; none where the ground is built over.
  [[nodiscard]] std::optional<Point3f> stand(Cell cell, Random& random, bool on_ground) const {
    const Point2d p{random.uniform(grid_.cell_edge_m), random.uniform(grid_.cell_edge_m)};
    const Tile& tile = tiles_.tile(cell);
    const float above_all_m = tile.z_high_m + 1.0F;
    if (tile.triangles.empty()) return std::nullopt;
    const Point3f from = city_.frame_from_grid(grid_.corner_of(cell) + p, above_all_m);
    const auto hit = city_.occluder().nearest({from, {0.0F, 0.0F, -1.0F}});
    if (!hit) return std::nullopt;
    const float height_m = above_all_m - hit->distance;
    const bool is_ground = city_.surface_of(hit->triangle).building == ground_building;
    if (on_ground && !is_ground) return std::nullopt;
    const float up_m = on_ground ? static_cast<float>(how_.eye_height_m) : off_surface_m;
    return Point3f{static_cast<float>(p.x), static_cast<float>(p.y), height_m + up_m};
  }

  /// Near geometry is exact: only where it leaves the sky open does the far map count.
  [[nodiscard]] Shares look(Cell cell, const Point3f& p_cell, FarView& view) const {
    std::vector<FarVerdict> verdicts(fan_.size());
    view.judge(p_cell, verdicts);
    const Point3f eye = city_.frame_from_grid(grid_.corner_of(cell) + Point2d{p_cell.x, p_cell.y}, p_cell.z);
    int difference = 0, doubt_up = 0, doubt_down = 0;
    for (std::size_t n = 0; n < fan_.size(); ++n) {
      const Point3d& d = directions_[fan_.place()[n]];
      const Ray ray{eye, {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}, least_distance_m};
      const auto hit = city_.occluder().nearest(ray);
      if (hit && grid_.neighborhood_of(cell).contains(city_.cell_of_triangle(hit->triangle))) continue;
      const bool open = verdicts[n] <= FarVerdict::estimated_free;
      difference += (open ? 1 : 0) - (hit ? 0 : 1);
      doubt_up += verdicts[n] == FarVerdict::estimated_blocked ? 1 : 0;
      doubt_down += verdicts[n] == FarVerdict::estimated_free ? 1 : 0;
    }
    const auto rays = static_cast<double>(fan_.size());
    return {std::abs(difference) / rays, std::max(doubt_up, doubt_down) / rays};
  }

  const TileSet& tiles_;
  const Grid& grid_;
  HorizonMapSettings settings_;
  FarErrorSettings how_;
  CityOccluder city_;
  HorizonMapBaker baker_;
  std::vector<Point3d> directions_;
  AzimuthFan fan_;
};

FarErrorEstimate summarize(const std::vector<CellVerdict>& cells) {
  FarErrorEstimate all;
  std::vector<double> doubts;
  for (const CellVerdict& cell : cells) {
    all.explicit_per_cell += static_cast<double>(cell.named) / static_cast<double>(cells.size());
    all.near_triangles_per_cell += static_cast<double>(cell.near_triangles) / static_cast<double>(cells.size());
    for (const Shares& s : cell.receivers) {
      all.mean_error += s.error;
      all.max_error = std::max(all.max_error, s.error);
      doubts.push_back(s.doubt);
    }
  }
  all.receivers = doubts.size();
  if (doubts.empty()) return all;
  all.mean_error /= static_cast<double>(doubts.size());
  std::sort(doubts.begin(), doubts.end());
  all.p99_doubt = doubts[static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(doubts.size()))) - 1];
  return all;
}

}  // namespace

FarErrorEstimate estimate_far_error(const TileSet& tiles, const Grid& grid, const HorizonMapSettings& settings,
                             const FarErrorSettings& how) {
  const Judge judge(tiles, grid, settings, how);
  Random random(how.seed);
  std::vector<std::pair<Cell, std::uint64_t>> chosen;
  for (std::size_t n = 0; n < how.cells; ++n)
    chosen.emplace_back(grid.cells.cell_at(random.below(static_cast<std::size_t>(grid.cells.size()))), how.seed + n);
  std::vector<CellVerdict> verdicts(chosen.size());
  oneapi::tbb::parallel_for(std::size_t{0}, chosen.size(),
                            [&](std::size_t n) { verdicts[n] = judge.judge(chosen[n].first, chosen[n].second); });
  return summarize(verdicts);
}

}  // namespace farlod
