// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/convex_faces.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "base/expects.hpp"
#include "generator/plane_polygons.hpp"

namespace farlod {
namespace {

[[nodiscard]] Point3d as_double(const PointMm& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

/// The cross product of the edges that meet at corner k of the ring.
[[nodiscard]] Point3d turn_at(const FaceRing& ring, std::size_t k, std::span<const PointMm> vertices) {
  const std::size_t n = ring.size();
  const PointMm &before = vertices[ring[(k + n - 1) % n]], &here = vertices[ring[k]], &after = vertices[ring[(k + 1) % n]];
  return cross(as_double(here - before), as_double(after - here));
}

/// The re-entrant corner of the ring, if there is one.
[[nodiscard]] std::optional<std::size_t> reentrant_corner(const FaceRing& ring, std::span<const PointMm> vertices) {
  // Of the rings of the generator only hexagons can be concave. The sum of the turns is dominated by their five convex corners
  if (ring.size() != 6) return std::nullopt;
  Point3d sense;
  for (std::size_t k = 0; k < ring.size(); ++k) sense = sense + normalized(turn_at(ring, k, vertices));
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (dot(turn_at(ring, k, vertices), sense) < 0.0) return k;
  return std::nullopt;
}

/// Quadrilaterals between each edge of the ring and the opposite edge of the hole.
[[nodiscard]] std::vector<FaceRing> frame_around_hole(const GeneratedFacet& facet) {
  const std::size_t n = facet.outer.size();
  FARLOD_EXPECTS(facet.hole.size() == n);
  std::vector<FaceRing> faces;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    faces.push_back({facet.outer[k], facet.outer[next], facet.hole[(n - next) % n], facet.hole[(n - k) % n]});
  }
  return faces;
}

/// The corners of the facet without the coordinate in which its normal is largest, with an outer ring that is counter-clockwise.
[[nodiscard]] std::vector<GridPoint> in_its_plane(const GeneratedFacet& facet, std::span<const PointMm> vertices,
                                                  std::span<const std::uint32_t> numbers) {
  PointMm normal;
  for (std::size_t k = 1; k + 1 < facet.outer.size(); ++k)
    normal = normal +
             cross(vertices[facet.outer[k]] - vertices[facet.outer[0]], vertices[facet.outer[k + 1]] - vertices[facet.outer[0]]);
  const double x = std::abs(static_cast<double>(normal.x)), y = std::abs(static_cast<double>(normal.y)),
               z = std::abs(static_cast<double>(normal.z));
  std::vector<GridPoint> result;
  for (const std::uint32_t k : numbers) {
    const PointMm& p = vertices[k];
    if (x >= y && x >= z) {
      result.push_back(normal.x > 0 ? GridPoint{p.y, p.z} : GridPoint{-p.y, p.z});
    } else if (y >= z) {
      result.push_back(normal.y > 0 ? GridPoint{-p.x, p.z} : GridPoint{p.x, p.z});
    } else {
      result.push_back(normal.z > 0 ? GridPoint{p.x, p.y} : GridPoint{-p.x, p.y});
    }
  }
  return result;
}

[[nodiscard]] std::vector<FaceRing> triangles_around_openings(const GeneratedFacet& facet, std::span<const PointMm> vertices) {
  FARLOD_EXPECTS(facet.hole.empty());
  std::vector<std::uint32_t> numbers;
  std::vector<std::vector<std::uint32_t>> rings;
  const auto add = [&](const FaceRing& ring) {
    std::vector<std::uint32_t>& rows = rings.emplace_back();
    for (const std::uint32_t k : ring) {
      rows.push_back(static_cast<std::uint32_t>(numbers.size()));
      numbers.push_back(k);
    }
  };
  add(facet.outer);
  for (const FaceRing& opening : facet.openings) add(opening);
  std::vector<FaceRing> faces;
  for (const GridTriangle& t : triangles(in_its_plane(facet, vertices, numbers), std::move(rings)))
    faces.push_back({numbers[t[0]], numbers[t[1]], numbers[t[2]]});
  return faces;
}

}  // namespace

std::vector<FaceRing> convex_faces(const GeneratedFacet& facet, std::span<const PointMm> vertices) {
  if (!facet.openings.empty()) return triangles_around_openings(facet, vertices);
  if (!facet.hole.empty()) return frame_around_hole(facet);
  const std::optional<std::size_t> corner = reentrant_corner(facet.outer, vertices);
  if (!corner) return {facet.outer};
  // From the re-entrant corner of an L to the outer one: both halves are convex
  const auto at = [&](std::size_t k) { return facet.outer[(*corner + k) % 6]; };
  return {{at(0), at(1), at(2), at(3)}, {at(0), at(3), at(4), at(5)}};
}

}  // namespace farlod
