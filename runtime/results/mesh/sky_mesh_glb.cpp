// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/mesh/sky_mesh_glb.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <tuple>

#include "farlod/inspection.hpp"
#include "results/mesh/glb_file.hpp"
#include "results/picture/colour_map.hpp"
#include "results/table/sky_table_csv.hpp"

namespace farlod {
namespace {

Colour colour_of(const std::optional<double>& svf) { return svf ? colour_of_svf(*svf) : nodata_colour; }

/// Whole metres in the middle of the points that have a height, as low as the lowest of them.
Point3d origin_of(const PointRows& rows) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point3d low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (std::size_t n = 0; n < rows.count; ++n) {
    const PointRow row = rows.row(n);
    if (!row.height_m) continue;
    low = {std::min(low.x, row.p_projected.x), std::min(low.y, row.p_projected.y), std::min(low.z, *row.height_m)};
    high = {std::max(high.x, row.p_projected.x), std::max(high.y, row.p_projected.y), 0.0};
  }
  if (low.x > high.x) return {};
  return {std::round(0.5 * (low.x + high.x)), std::round(0.5 * (low.y + high.y)), std::floor(low.z)};
}

/// Whole metres in the middle of the city, at the height from which its heights count on disk.
Point3d origin_of(const Package& package) {
  const Box2d& outline = package.description().outline_projected;
  return {std::round(0.5 * (outline.low.x + outline.high.x)), std::round(0.5 * (outline.low.y + outline.high.y)),
          std::round(inventory_of(package).height_origin_m)};
}

/// Finds the mean of a surface by its building and its number.
class MeanOfSurface {
 public:
  explicit MeanOfSurface(std::span<const SurfaceMean> surfaces) {
    for (const SurfaceMean& surface : surfaces) ordered_.push_back(&surface);
    std::ranges::sort(ordered_, {}, key);
  }
  [[nodiscard]] std::optional<double> operator()(const std::string& building, std::uint32_t surface) const {
    const auto found = std::ranges::lower_bound(ordered_, std::tie(building, surface), {}, key);
    return found != ordered_.end() && key(*found) == std::tie(building, surface) ? (*found)->svf_mean : std::nullopt;
  }

 private:
  static std::tuple<const std::string&, const std::uint32_t&> key(const SurfaceMean* s) { return {s->building, s->surface}; }

  std::vector<const SurfaceMean*> ordered_;
};

void for_each_block(const PackageInventory& package, const std::function<void(const CellRectangle&)>& work) {
  const CellRectangle& all = package.cells;
  for (std::int32_t j = all.j_begin; j < all.j_end; j += package.block_edge)
    for (std::int32_t i = all.i_begin; i < all.i_end; i += package.block_edge)
      work({i, j, std::min(i + package.block_edge, all.i_end), std::min(j + package.block_edge, all.j_end)});
}

}  // namespace

void write_points_glb(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path) {
  GlbFile file(GlbPrimitive::points, origin_of(rows), frame, path);
  for (std::size_t n = 0; n < rows.count; ++n) {
    const PointRow row = rows.row(n);
    if (row.height_m) file.add({row.p_projected.x, row.p_projected.y, *row.height_m}, colour_of(row.svf));
  }
  file.commit();
}

std::vector<std::filesystem::path> SurfacesGlb::commit(std::span<const SurfaceMean> surfaces,
                                                       std::span<const BuildingMean> buildings) {
  const std::filesystem::path csv = std::filesystem::path(path_).replace_extension(".csv");
  std::vector<std::filesystem::path> files{path_, table_beside(csv, ".surfaces"), table_beside(csv, ".buildings")};
  write_surfaces_csv(surfaces, frame_.columns, files[1]);
  write_buildings_csv(buildings, frame_.columns, files[2]);
  write_mesh(surfaces);  // the file of -o appears last
  return files;
}

void SurfacesGlb::write_mesh(std::span<const SurfaceMean> surfaces) const {
  GlbFile file(GlbPrimitive::triangles, frame_.package != nullptr ? origin_of(*frame_.package) : Point3d{}, frame_, path_);
  const MeanOfSurface mean_of(surfaces);
  const auto add_block = [&](const CellRectangle& block) {
    for (const MeshPart& part : geometry_of(*frame_.package, block))
      for (const MeshTriangle& triangle : part.triangles) {
        if (!part.building) break;  // the ground is no surface that has a mean
        const Colour colour = colour_of(mean_of(part.id, triangle.surface));
        for (const std::uint32_t vertex : triangle.vertices) file.add(part.vertices_projected[vertex], colour);
      }
  };
  if (frame_.package != nullptr) for_each_block(inventory_of(*frame_.package), add_block);
  file.commit();
}

}  // namespace farlod
