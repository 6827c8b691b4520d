// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/surface_shapes.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "results/table/blocks_of_city.hpp"

namespace farlod {
namespace {

bool has_receivers(SurfaceKind kind) { return kind == SurfaceKind::roof || kind == SurfaceKind::wall; }

}  // namespace

// The receivers of the same result may have a spool file, too
SurfaceShapes::SurfaceShapes(const Package& package, std::span<const BuildingMean> buildings, const std::filesystem::path& result)
    : file_(result.string() + ".shapes") {
  for (std::uint32_t row = 0; row < buildings.size(); ++row) numbers_.emplace(buildings[row].building, row);
  for_each_block(inventory_of(package), [&](const CellRectangle& block) {
    for (const MeshPart& part : geometry_of(package, block)) add(part);
  });
  std::ranges::stable_sort(pieces_, {}, place_of);
}

void SurfaceShapes::add(const MeshPart& part) {
  const auto number = part.building ? numbers_.find(part.id) : numbers_.end();
  if (number == numbers_.end()) return;
  std::vector<SpaceTriangle> triangles;
  for (auto begin = part.triangles.begin(); begin != part.triangles.end();) {
    const auto end =
        std::find_if(begin, part.triangles.end(), [&](const MeshTriangle& t) { return t.surface != begin->surface; });
    triangles.clear();
    for (auto t = begin; t != end && has_receivers(t->kind); ++t)
      triangles.push_back({part.vertices_projected[t->vertices[0]], part.vertices_projected[t->vertices[1]],
                           part.vertices_projected[t->vertices[2]]});
    if (!triangles.empty())
      pieces_.push_back({number->second, begin->surface, static_cast<std::uint32_t>(triangles.size()),
                         file_.append(std::as_bytes(std::span(triangles)))});
    begin = end;
  }
}

std::vector<SurfacePolygon> SurfaceShapes::of(std::string_view building, std::uint32_t surface) {
  const auto number = numbers_.find(building);
  if (number == numbers_.end()) return {};
  std::vector<SpaceTriangle> triangles;
  const std::pair wanted{number->second, surface};
  // clang 14 knows no ranges::equal_range of libstdc++ 12
  for (auto piece = std::ranges::lower_bound(pieces_, wanted, {}, place_of); piece != pieces_.end() && place_of(*piece) == wanted;
       ++piece) {
    const std::size_t before = triangles.size();
    triangles.resize(before + piece->triangles);
    file_.read(piece->begin, std::as_writable_bytes(std::span(triangles).subspan(before)));
  }
  return polygons_of(triangles);
}

}  // namespace farlod
