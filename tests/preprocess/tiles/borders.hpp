// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/grid.hpp"
#include "tests/preprocess/tiles/bodies.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tiles/contacts.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/tiles.hpp"

namespace farlod::tiles::test {

/// Faces as fans of triangles: what diagonals they get, no test depends on. A face that is seen counter-clockwise from above
/// looks up.
inline EdgeTable table_of(const std::vector<Face>& faces) {
  EdgeTable table;
  for (const Face& face : faces) {
    double twice_area = 0.0;
    for (std::size_t n = 0; n < face.size(); ++n) {
      const Point3d &a = face[n], &b = face[(n + 1) % face.size()];
      twice_area += a.x * b.y - a.y * b.x;
    }
    const FacetLook look = twice_area > 0.0 ? FacetLook::up : FacetLook::down;
    for (std::size_t n = 2; n < face.size(); ++n) table.add_triangle(face[0], face[n - 1], face[n], look);
  }
  return table;
}

/// Each from its lesser end, sorted: in what order borders come, and from which end, means nothing.
inline std::vector<Segment3d> as_set(std::vector<Segment3d> edges) {
  const auto place = [](const Point3d& p) { return std::tie(p.x, p.y, p.z); };
  for (Segment3d& e : edges)
    if (place(e.b) < place(e.a)) std::swap(e.a, e.b);
  std::sort(edges.begin(), edges.end(), [&](const Segment3d& s, const Segment3d& t) {
    return std::pair(place(s.a), place(s.b)) < std::pair(place(t.a), place(t.b));
  });
  return edges;
}

/// Whether a segment lies on others, all of it, within the rounding of cells.
inline bool covers(const std::vector<Segment3d>& others, const Segment3d& segment) {
  constexpr int steps = 20;
  constexpr double rounding_m = 1e-4;
  const auto is_on = [&](const Point3d& p) {
    return std::any_of(others.begin(), others.end(), [&](const Segment3d& s) {
      const Point3d along = s.b - s.a;
      const double share = std::clamp(dot(p - s.a, along) / dot(along, along), 0.0, 1.0);
      return norm(p - point_at(s, share)) <= rounding_m;
    });
  };
  for (int k = 0; k <= steps; ++k)
    if (!is_on(point_at(segment, static_cast<double>(k) / steps))) return false;
  return true;
}

/// Whether one of the segments has these ends, within the rounding of cells.
inline bool has_near(const std::vector<Segment3d>& segments, const Segment3d& wanted) {
  constexpr double rounding_m = 1e-5;
  return std::any_of(segments.begin(), segments.end(), [&](const Segment3d& s) {
    return (norm(s.a - wanted.a) <= rounding_m && norm(s.b - wanted.b) <= rounding_m) ||
           (norm(s.a - wanted.b) <= rounding_m && norm(s.b - wanted.a) <= rounding_m);
  });
}

inline std::vector<Segment3d> segments_of(const std::vector<HorizonSegment>& edges) {
  std::vector<Segment3d> segments;
  for (const HorizonSegment& e : edges) segments.push_back(e.segment);
  return segments;
}

inline double area_m2(const std::vector<ClosingTriangle>& triangles) {
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) sum += 0.5 * norm(cross(b - a, c - a));
  return sum;
}

/// Level ground at 0 m, far beyond cells of 50 m.
inline TerrainRaster level_terrain() { return {{-200, -200}, {200, 200}, 3, 3, std::vector<std::optional<float>>(9, 0.0F)}; }

/// A town of buildings on level ground at 0 m, in one cell of 50 m; number 0 is a kerbstone in its south-west corner.
class SmallTown {
 public:
  SmallTown() { add_building(city_, "stone", box(0, 0, 0.5, 0.5, 0, 0.1)); }
  void add(const std::string& id, const std::vector<Face>& faces) { add_building(city_, id, faces); }
  [[nodiscard]] const CityModel& city() const { return city_; }
  [[nodiscard]] TileSet tiles(Assign assign = Assign::clip) const {
    Report ignored;
    return cut_into_tiles({city_, {}}, scenes::grid_covering(city_, {}, 50, 3), assign, level_terrain(), ignored);
  }

 private:
  CityModel city_;
};

/// The edges of a role in the first cell that do not lie on the ground.
inline std::vector<Segment3d> edges_of(const TileSet& tiles, EdgeRole role) {
  const auto exactly = [](const Point3f& p) { return Point3d{p.x, p.y, p.z}; };
  std::vector<Segment3d> edges;
  for (const HorizonEdge& e : tiles.tile({0, 0}).horizon_edges)
    if (e.role == role && std::max(e.a.z, e.b.z) > 0.1F) edges.push_back({exactly(e.a), exactly(e.b)});
  return as_set(std::move(edges));
}

/// Whether all surfaces of the building with this number are grounded.
inline bool is_grounded(const TileSet& tiles, std::uint32_t building) {
  return std::all_of(tiles.surfaces.begin(), tiles.surfaces.end(),
                     [&](const Surface& s) { return s.building != building || s.grounded; });
}

}  // namespace farlod::tiles::test
