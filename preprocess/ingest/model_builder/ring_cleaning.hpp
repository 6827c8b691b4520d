// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::ingest {

using Ring = std::vector<Point3d>;
/// A polygon: the outer ring first, then its holes.
using Rings = std::vector<Ring>;

/// How a format closes a ring: it repeats the first point (GML, OGR), or leaves the last edge out (OBJ, CityJSON).
enum class RingEnd { repeats_first, implied };

enum class RingState { usable, too_few_points, unreadable_coordinate };

struct RingFindings {
  RingState state = RingState::usable;
  std::size_t repeated_vertices = 0;  ///< number of vertices removed
  bool was_open = false;              ///< the ring did not repeat its first point although the format requires it
  double gap = 0.0;                   ///< from the last vertex of an open ring to its first
};

/// No CRS of the Earth has larger coordinates, in metres or in feet.
inline constexpr double farthest_coordinate = 1e9;

/// Whether all coordinates are numbers, and none lies beyond the Earth.
[[nodiscard]] bool is_readable(const Point3d& p);

/// The first vertex with readable coordinates.
[[nodiscard]] std::optional<Point3d> first_readable(std::span<const Ring> rings);

/// Brings a ring into the form that CityModel promises: the first point is not repeated at the end, no vertex comes twice in a
/// row, and at least three points differ. Rings of all formats are checked here alone. An unusable ring may be left partly
/// changed.
[[nodiscard]] RingFindings clean_ring(Ring& ring, RingEnd end);

/// Which polygons count as the same.
enum class SamePolygon {
  corners,  ///< those with the same corners in any order: a surface that is in a file twice may face both ways
  rings     ///< those whose rings have the same corners in the same cyclic order: the two sides of a wall differ
};

/// Finds polygons that are repeated in the same part of a building. Stores a hash and a number for each polygon. The caller keeps
/// the polygons and gives access to them by number, so that a large mesh is in memory once.
class PolygonDeduplicator {
 public:
  /// Returns the rings of the polygon with a number.
  using PolygonAt = std::function<std::vector<std::span<const Point3d>>(std::uint64_t number)>;

  explicit PolygonDeduplicator(SamePolygon criterion) : criterion_(criterion) {}

  /// The number of the same polygon in this part, if it was inserted.
  [[nodiscard]] std::optional<std::uint64_t> find(const Rings& rings, std::uint16_t part, const PolygonAt& polygon_at) const;
  /// As `find`. If there is none, inserts the polygon with `number`.
  std::optional<std::uint64_t> find_or_insert(const Rings& rings, std::uint16_t part, std::uint64_t number,
                                              const PolygonAt& polygon_at);
  void clear() { entries_by_hash_.clear(); }

 private:
  struct Entry {
    std::uint64_t number = 0;
    std::uint16_t part = 0;
  };

  [[nodiscard]] std::uint64_t hash_of(const Rings& rings, std::uint16_t part) const;
  [[nodiscard]] std::optional<std::uint64_t> find_hashed(std::uint64_t hash, const Rings& rings, std::uint16_t part,
                                                         const PolygonAt& polygon_at) const;

  SamePolygon criterion_;
  std::unordered_multimap<std::uint64_t, Entry> entries_by_hash_;
};

/// The rings of a polygon as PolygonAt returns them.
[[nodiscard]] std::vector<std::span<const Point3d>> spans_of(const Rings& rings);

}  // namespace farlod::ingest
