// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "farlod/expects.hpp"
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

/// What the heights of a building count from.
enum class HeightReference : std::uint8_t {
  elevation,       ///< the zero of the CRS: the file knows where the building stands
  on_ground,       ///< the ground, which only a terrain can tell
  down_to_ground,  ///< the roof has an elevation; what is nearer to the foot than to the roof has yet to be put on the ground
};

struct Building {
  std::string id;
  std::uint64_t first_facet = 0;
  std::uint32_t facet_count = 0;
  HeightReference footing = HeightReference::elevation;
  std::uint32_t source = 0;  ///< place in LocatedCity::sources of the file that it comes from
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
  [[nodiscard]] std::span<const Point3d> points_of(const Building& b) const;
  [[nodiscard]] std::span<Point3d> points_of(const Building& b);
  [[nodiscard]] std::span<const Point3d> points() const { return points_; }
  [[nodiscard]] std::span<Point3d> points() { return points_; }
  /// Distinct surfaces over all buildings: what users call polygons.
  [[nodiscard]] std::uint64_t surface_count() const;

  /// Building up: a building, then its facets, each with its rings, outer ring first.
  void begin_building(std::string id, HeightReference footing = HeightReference::elevation, std::uint32_t source = 0);
  void begin_facet(SurfaceKind kind, std::uint32_t surface, std::uint16_t part = 0);
  void add_ring(std::span<const Point3d> points);
  /// Takes back the building begun last, with all that it has.
  void drop_last_building();
  /// Takes back facets, with `is_dropped` for each of them, and buildings that have no others.
  void drop_facets(const std::vector<bool>& is_dropped);
  void set_source(std::uint32_t source);  ///< of all buildings
  /// Appends the buildings of another model; takes it over whole where there is nothing yet.
  void append(CityModel&& other);

 private:
  [[nodiscard]] std::span<const Point3d> points_of_ring(std::uint64_t r) const {
    return std::span(points_).subspan(ring_begin_[r], ring_begin_[r + 1] - ring_begin_[r]);
  }

  std::vector<Building> buildings_;
  std::vector<Facet> facets_;
  std::vector<std::uint64_t> ring_begin_{0};  ///< first point of each ring, and one past the last
  std::vector<Point3d> points_;
};

}  // namespace farlod
