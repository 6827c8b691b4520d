// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/grid.hpp"
#include "base/mesh_view.hpp"
#include "package/far_map.hpp"
#include "package/layout.hpp"
#include "package/package_folder.hpp"

namespace farlod {

/// The geometry of one cell, still in the mapped file, or kept by its mesh. Vertices are in the cell frame.
struct TileView {
  const package::CellRecord* cell = nullptr;
  MeshView mesh;
  std::span<const package::SurfaceRun> surface_runs;  ///< cover the triangles, in order
  std::span<const package::SurfaceRecord> surfaces;   ///< of the whole block
  std::span<const package::BuildingRecord> buildings;
  std::array<std::span<const package::TileEdge>, edge_role_count> edge_sides;  ///< for each role; see visit_edges
  std::span<const HorizonEdge> loose_edges;                                    ///< the rest of the edges

  [[nodiscard]] const package::SurfaceRecord& surface_of(std::uint32_t triangle) const {
    const auto run = std::upper_bound(surface_runs.begin(), surface_runs.end(), triangle,
                                      [](std::uint32_t t, const package::SurfaceRun& r) { return t < r.end; });
    return surfaces[run->surface];
  }
  /// Calls `visit` with each HorizonEdge, cell frame. In no particular order, running either way.
  template <class Visitor>
  void visit_edges(const Visitor& visit) const {
    for (std::size_t role = 0; role < edge_role_count; ++role) {
      std::size_t side = 0;  // numbered through all triangles
      for (const package::TileEdge& e : edge_sides[role]) {
        side += e.sides_skipped;
        if (e.sides_skipped == package::TileEdge::skip_only) continue;
        const Triangle& t = mesh.triangles[side / 3];
        const std::size_t corner = side % 3;
        visit(HorizonEdge{mesh.vertices[t.corner(corner)], mesh.vertices[t.corner(corner + 1)], e.adjacent,
                          static_cast<EdgeRole>(role)});
        ++side;
      }
    }
    for (const HorizonEdge& e : loose_edges) visit(e);
  }
  /// Number within the city of a surface's building; no_building for the ground.
  [[nodiscard]] std::uint32_t building_number(const package::SurfaceRecord& surface) const {
    return surface.building == package::no_building ? package::no_building : buildings[surface.building].number;
  }
};

/// A checked view of the bytes of a `tiles.bin`. Whatever it hands out lies inside the bytes and refers only to what exists:
/// the constructor checks everything once, and nothing afterwards checks again.
class BlockTiles {
 public:
  /// `name` is for messages. `cells` are the cells that the block must hold. The bytes must outlive the view.
  /// Throws PackageDamaged naming the first rule that is broken, PackageUnusable for another version of the format.
  BlockTiles(std::span<const std::byte> bytes, const CellRange& cells, std::string name);

  /// The records of its cells alone, of whose bytes only the header is checked, and no others are read.
  [[nodiscard]] static std::span<const package::CellRecord> records_of_cells(std::span<const std::byte> bytes, std::string name);

  [[nodiscard]] TileView tile(Cell cell) const;  ///< `cell` must be one of the block's
  /// What the far map of a cell names, and the levels of its layers. Only where far maps are of the kind `horizon`:
  /// has_far_cells().
  [[nodiscard]] ExplicitOccluders explicit_occluders(Cell cell, double cell_edge_m) const;
  [[nodiscard]] std::vector<float> levels_m(Cell cell, std::uint32_t layers) const;
  [[nodiscard]] bool has_far_cells() const { return !far_cells_.empty(); }
  [[nodiscard]] std::span<const package::SurfaceRecord> surfaces() const { return surfaces_; }
  [[nodiscard]] std::span<const package::BuildingRecord> buildings() const { return buildings_; }
  [[nodiscard]] std::string_view id_of(const package::BuildingRecord& building) const {
    return text_.substr(building.text_offset, building.text_bytes);
  }

 private:
  BlockTiles(std::span<const std::byte> bytes, std::string name);
  void check_header() const;
  void find_sections();
  void check_cells() const;
  void place_tiles();
  template <class T>
  [[nodiscard]] std::span<const T> cut_off(std::span<const T>& rest, std::size_t count, const char* what) const;
  [[nodiscard]] std::size_t run_count(std::span<const package::SurfaceRun> runs, std::uint32_t triangle_count) const;
  void check_tile(const TileView& tile) const;
  void check_edges(const TileView& tile) const;
  void check_places(std::span<const HorizonEdge> edges) const;
  void check_surfaces() const;
  void check_far_cells() const;
  void check_far_places() const;
  template <class T>
  [[nodiscard]] std::span<const T> section(package::SectionKind kind) const;
  void require(bool rule, const char* what) const { require_whole(rule, name_, what); }

  std::span<const std::byte> bytes_;
  CellRange range_;
  std::string name_;
  std::span<const package::Section> sections_;
  std::span<const package::CellRecord> cells_;
  std::span<const package::SurfaceRecord> surfaces_;
  std::span<const package::BuildingRecord> buildings_;
  std::string_view text_;
  std::vector<TileView> tiles_;  ///< as many and in the same order as cells_
  std::span<const package::FarCellRecord> far_cells_;
  std::span<const HorizonEdge> far_edges_;
  std::span<const package::ExplicitOccluder> explicit_edges_;
};

}  // namespace farlod
