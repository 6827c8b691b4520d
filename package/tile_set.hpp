// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/expects.hpp"
#include "base/grid.hpp"
#include "base/mesh_view.hpp"
#include "base/paging/paged_array.hpp"
#include "farlod/pack.hpp"
#include "farlod/surface_kind.hpp"
#include "package/far_terrain.hpp"
#include "package/horizon_edge.hpp"

namespace farlod {

/// What a tile has many of: elements of its own, or a view into the pages of the whole city (TilePages).
template <class T>
class TileArray {
 public:
  using value_type = T;

  TileArray() = default;
  TileArray(std::initializer_list<T> elements) : own_(elements) {}
  TileArray(std::vector<T> elements) : own_(std::move(elements)) {}
  /// The elements must outlive the array.
  [[nodiscard]] static TileArray view_of(std::span<const T> elements) {
    TileArray array;
    array.view_ = elements;
    return array;
  }
  operator std::vector<T>() const { return {begin(), end()}; }

  /// Not to a view.
  void push_back(const T& element) {
    FARLOD_EXPECTS(view_.empty());
    own_.push_back(element);
  }

  [[nodiscard]] const T* data() const { return view_.empty() ? own_.data() : view_.data(); }
  [[nodiscard]] std::size_t size() const { return view_.empty() ? own_.size() : view_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] const T* begin() const { return data(); }
  [[nodiscard]] const T* end() const { return data() + size(); }
  [[nodiscard]] const T& operator[](std::size_t n) const { return data()[n]; }

  friend bool operator==(const TileArray& a, const TileArray& b) { return std::ranges::equal(a, b); }

 private:
  std::vector<T> own_;
  std::span<const T> view_;
};

/// The geometry that one cell owns. Vertices are in the cell frame: x and y from the cell's south-west corner, heights
/// from TileSet::height_origin_m.
struct Tile {
  TileArray<Point3f> vertices;
  TileArray<Triangle> triangles;
  TileArray<std::uint32_t> triangle_surfaces;  ///< for each triangle, its number in TileSet::surfaces
  /// The edges of the ground and of buildings that can be silhouettes, cut at the cell's borders.
  TileArray<HorizonEdge> horizon_edges;
  float z_low_m = std::numeric_limits<float>::infinity();
  float z_high_m = -std::numeric_limits<float>::infinity();
  float ground_at_centre_m = 0.0F;
  /// How many triangles and edges, the last ones, are not stored, since readers make them (ReliefTiles).
  struct OfReaders {
    std::size_t triangles = 0, edges = 0;
  } of_readers;

  [[nodiscard]] std::span<const Triangle> stored_triangles() const {
    return {triangles.data(), triangles.size() - of_readers.triangles};
  }
  [[nodiscard]] std::span<const HorizonEdge> stored_edges() const {
    return {horizon_edges.data(), horizon_edges.size() - of_readers.edges};
  }
  [[nodiscard]] MeshView mesh() const { return {vertices, triangles}; }
  /// Adds a convex polygon as a fan of triangles.
  void add_polygon(const std::vector<Point3f>& polygon, std::uint32_t surface);
};

/// A whole surface of a building, or the ground. Its pieces may lie in several tiles.
struct Surface {
  std::uint32_t building = 0;  ///< place in TileSet::building_ids; `ground_building` for the ground
  std::uint32_t number = 0;    ///< within the building
  std::uint16_t part = 0;
  SurfaceKind kind = SurfaceKind::unknown;
  Point3d normal;  ///< outward, length 1, grid frame
  double area_m2 = 0.0;
  /// No receiver outside of the building has the surface overhead, and it hides nothing above the grounded horizon: the building
  /// has no lower borders above the ground, or the surface is a wall below grounded borders.
  bool grounded = true;
};

inline constexpr std::uint32_t ground_building = 0xFFFFFFFF;
/// The ground is the first surface of every tile set.
inline constexpr std::uint32_t ground_surface = 0;

/// What the tiles of a city hold, one tile after the other and block by block: a city has more of it than there is memory.
struct TilePages {
  PagedArray<Point3f> vertices;
  PagedArray<Triangle> triangles;
  PagedArray<std::uint32_t> triangle_surfaces;
  PagedArray<HorizonEdge> horizon_edges;

  void let_go() const;
};

/// Where the buildings of a city come from in its files.
struct TileSources {
  struct OfBuilding {
    std::uint32_t source = 0;  ///< place in LocatedCity::sources
    std::uint64_t bytes = 0;   ///< of its origin
  };
  PagedArray<OfBuilding> buildings;  ///< as TileSet::building_ids
  PagedArray<std::uint8_t> origins;  ///< CityModel::origin_of, one building after the other
};

/// The whole city, cut into the cells of the grid. The tiles are a partition of it.
struct TileSet {
  double height_origin_m = 0.0;
  CellRange cells;
  std::vector<Tile> tiles;                 ///< one for each cell, in the order of CellRange::index_of
  std::shared_ptr<const TilePages> pages;  ///< what the tiles view; none where each holds its own
  FarTerrain far_terrain;                  ///< beyond the cells; may be empty
  PagedArray<Surface> surfaces;
  std::vector<std::string> building_ids;
  TileSources sources;
  std::uint64_t polygon_count = 0;     ///< surfaces of buildings
  std::uint64_t foundation_count = 0;  ///< buildings whose lowest floor was closed down to the ground
  /// Squares of pixels, of two triangles each, that are left to readers, whether or not the tiles have them here.
  std::uint64_t squares_of_readers = 0;

  [[nodiscard]] const Tile& tile(Cell c) const { return tiles[cells.index_of(c)]; }
  [[nodiscard]] Tile& tile(Cell c) { return tiles[cells.index_of(c)]; }
  /// As a reader has them.
  [[nodiscard]] std::uint64_t triangle_count() const;
  /// Gives back the memory of what the tiles of one block hold, as far as it lies on disk, and that of the surfaces. What is
  /// asked for later is read again. May be called while others read.
  void let_go(const CellRange& block) const;
  /// The same for all tiles.
  void let_go() const;
};

}  // namespace farlod
