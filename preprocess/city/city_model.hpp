// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/expects.hpp"
#include "base/paging/paged_array.hpp"
#include "farlod/point.hpp"
#include "farlod/surface_kind.hpp"

namespace farlod {

/// A planar polygon with holes. Rings are not closed (the last point is not the first again).
struct Facet {
  std::uint64_t first_ring = 0;
  std::uint32_t ring_count = 0;  ///< the first is the outer one, the others are holes
  /// The surface it belongs to, counted within its building. Polygons of a file are surfaces of their own;
  /// the coplanar triangles of a mesh share one.
  std::uint32_t surface = 0;
  std::uint16_t part = 0;  ///< the closed part (BuildingPart) of the building, for the question "inside?"
  SurfaceKind kind = SurfaceKind::unknown;
};

/// The reference of a building's heights.
enum class HeightReference : std::uint8_t {
  elevation,       ///< the zero of the CRS: the file gives elevations
  on_ground,       ///< the ground below the building, which only a terrain gives
  down_to_ground,  ///< the roof has an elevation; the points nearer to the base than to the roof still have to move to the ground
};

struct Building {
  std::string id;
  std::uint64_t first_facet = 0;
  std::uint32_t facet_count = 0;
  HeightReference height_reference = HeightReference::elevation;
  std::uint32_t source = 0;  ///< place in LocatedCity::sources of the file that it comes from
  std::uint64_t first_origin_byte = 0;
  std::uint64_t origin_bytes = 0;  ///< 0: nothing is known of the places of its surfaces in a file
};

/// All buildings of a city, as flat arrays: a city has millions of rings, and a vector for each would double it.
/// Coordinates are in the frame of the stage that made it.
class CityModel {
 public:
  [[nodiscard]] std::span<const Building> buildings() const { return buildings_; }
  [[nodiscard]] std::span<const Facet> facets() const { return facets_; }
  [[nodiscard]] std::span<const Facet> facets_of(const Building& b) const {
    return std::span(facets_).subspan(b.first_facet, b.facet_count);
  }
  /// Ring `k` of a facet: 0 is the outer one.
  [[nodiscard]] std::span<const Point3d> ring(const Facet& f, std::uint32_t k) const {
    FARLOD_EXPECTS(k < f.ring_count);
    return points_of_ring(f.first_ring + k);
  }
  [[nodiscard]] std::span<const std::uint8_t> origin_of(const Building& b) const {
    return std::span(origins_).subspan(b.first_origin_byte, b.origin_bytes);
  }
  [[nodiscard]] std::span<const Point3d> points_of(const Building& b) const;
  [[nodiscard]] std::span<Point3d> points_of(const Building& b);
  [[nodiscard]] std::span<const Point3d> points() const { return points_; }
  [[nodiscard]] std::span<Point3d> points() { return points_; }

  /// Building up: a building, then its facets, each with its rings, outer ring first.
  void begin_building(std::string id, HeightReference height_reference = HeightReference::elevation, std::uint32_t source = 0);
  void begin_facet(SurfaceKind kind, std::uint32_t surface, std::uint16_t part = 0);
  void add_ring(std::span<const Point3d> points);
  /// Where the building begun last comes from in its file, as package::append_origin writes it. Facets that are dropped leave it
  /// as it is: it counts by the numbers of surfaces.
  void set_origin(std::span<const std::uint8_t> origin);
  /// Removes the building begun last with all its facets.
  void drop_last_building();
  /// Removes the facets for which `is_dropped` is true, and buildings without other facets.
  void drop_facets(const std::vector<bool>& is_dropped);
  void set_source(std::uint32_t source);  ///< of all buildings
  /// Appends the buildings of another model; takes it over whole where there is nothing yet.
  void append(CityModel&& other);

  /// Calls visit(n, building) for each building in order. Of what lies on disk (PagedArray), only that of the last few buildings
  /// takes memory.
  template <class Visit>
  void for_each_building(const Visit& visit) const {
    for (std::size_t n = 0; n < buildings_.size(); ++n) {
      visit(n, buildings_[n]);
      if (n % buildings_held == buildings_held - 1) let_go_before(n);
    }
    let_go_before(buildings_.size());
  }
  static constexpr std::size_t buildings_held = 4096;
  /// Gives back the memory of the buildings before this one, as far as they lie on disk: they are read again when somebody asks
  /// for them. May be called while others read.
  void let_go_before(std::size_t building) const;

 private:
  [[nodiscard]] std::span<const Point3d> points_of_ring(std::uint64_t r) const {
    return std::span(points_).subspan(ring_begin(r), ring_end_[r] - ring_begin(r));
  }

  std::vector<Building> buildings_;
  [[nodiscard]] std::uint64_t ring_begin(std::uint64_t r) const { return r == 0 ? 0 : ring_end_[r - 1]; }

  PagedArray<Facet> facets_;
  PagedArray<std::uint64_t> ring_end_;  ///< one past the last point of each ring
  PagedArray<Point3d> points_;
  PagedArray<std::uint8_t> origins_;  ///< one building after the other
};

}  // namespace farlod
