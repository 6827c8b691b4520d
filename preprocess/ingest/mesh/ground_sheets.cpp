// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/mesh/ground_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "farlod/box.hpp"

namespace farlod::ingest {
namespace {

/// The cosine of 78°.
constexpr double steepest_ground = 0.2;
constexpr std::size_t fewest_on_ground = 3;
/// Enough of the buildings on a sheet to know that it is their ground.
constexpr std::size_t most_to_ask = 200;
/// A file has its ground in a few pieces. Where all of its faces are buildings of their own, not all are asked.
constexpr std::size_t most_sheets = 16;

/// What a building covers.
struct Cover {
  Box2d plan;
  double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
  double area = 0.0, steep_area = 0.0, plan_area = 0.0;

  [[nodiscard]] Point3d middle() const {
    const Point2d p = 0.5 * (plan.low + plan.high);
    return {p.x, p.y, 0.5 * (lowest + highest)};
  }
};

bool is_point(const Point3d& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// The corners of a face that are points.
std::vector<Point3d> face_points(const Mesh& mesh, UpAxis up, std::uint32_t face) {
  std::vector<Point3d> corners;
  for (const std::int64_t corner :
       std::span(mesh.corners).subspan(mesh.faces[face].first_corner, mesh.faces[face].corner_count)) {
    if (corner < 0 || corner >= static_cast<std::int64_t>(mesh.vertices.size())) continue;
    const Point3d p = upright(up, mesh.vertices[static_cast<std::size_t>(corner)]);
    if (is_point(p)) corners.push_back(p);
  }
  return corners;
}

std::span<const std::uint32_t> faces_of(const FacesOfBuildings& buildings, std::size_t b) {
  return buildings.faces.subspan(buildings.begin[b], buildings.begin[b + 1] - buildings.begin[b]);
}

Cover cover_of(const Mesh& mesh, UpAxis up, std::span<const std::uint32_t> faces) {
  Cover cover;
  for (const std::uint32_t face : faces) {
    const std::vector<Point3d> corners = face_points(mesh, up, face);
    Point3d normal;
    for (std::size_t k = 2; k < corners.size(); ++k)
      normal = normal + 0.5 * cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
    const double area = norm(normal);
    cover.area += area;
    cover.plan_area += std::abs(normal.z);
    if (std::abs(normal.z) < steepest_ground * area) cover.steep_area += area;
    for (const Point3d& p : corners) {
      cover.plan.add(horizontal(p));
      cover.lowest = std::min(cover.lowest, p.z);
      cover.highest = std::max(cover.highest, p.z);
    }
  }
  return cover;
}

/// Rules (1) and (2).
bool is_sheet(const Cover& cover) {
  constexpr double most_steep = 0.1, rounding = 1.01;
  const Point2d size = cover.plan.high - cover.plan.low;
  return cover.area > 0.0 && cover.steep_area < most_steep * cover.area && cover.plan_area <= rounding * size.x * size.y;
}

/// The height of the corner that is nearest in the plan to each point.
std::vector<double> heights_near(const Mesh& mesh, UpAxis up, std::span<const std::uint32_t> faces,
                                 const std::vector<Point3d>& points) {
  std::vector<double> nearest(points.size(), std::numeric_limits<double>::infinity()), heights(points.size());
  for (const std::uint32_t face : faces)
    for (const Point3d& corner : face_points(mesh, up, face))
      for (std::size_t n = 0; n < points.size(); ++n) {
        const double distance = std::hypot(corner.x - points[n].x, corner.y - points[n].y);
        if (distance >= nearest[n]) continue;
        nearest[n] = distance;
        heights[n] = corner.z;
      }
  return heights;
}

/// Rules (3) and (4).
bool lies_below_others(const Mesh& mesh, UpAxis up, std::span<const std::uint32_t> faces, std::size_t sheet,
                       const std::vector<Cover>& covers) {
  std::vector<Point3d> middles;
  for (std::size_t b = 0; b < covers.size(); ++b)
    if (b != sheet && covers[b].area > 0.0 && covers[sheet].plan.contains(horizontal(covers[b].middle())))
      middles.push_back(covers[b].middle());
  if (middles.size() < fewest_on_ground || 2 * middles.size() < covers.size() - 1) return false;
  const std::size_t step = (middles.size() + most_to_ask - 1) / most_to_ask;
  std::vector<Point3d> asked;
  for (std::size_t n = 0; n < middles.size(); n += step) asked.push_back(middles[n]);
  const std::vector<double> heights = heights_near(mesh, up, faces, asked);
  std::size_t above = 0;
  for (std::size_t n = 0; n < asked.size(); ++n) above += asked[n].z > heights[n] ? 1 : 0;
  return 2 * above > asked.size();
}

/// The largest ones.
std::vector<std::size_t> sheets_among(const std::vector<Cover>& covers) {
  const auto size = [&](std::size_t b) {
    const Point2d edges = covers[b].plan.high - covers[b].plan.low;
    return edges.x * edges.y;
  };
  std::vector<std::size_t> sheets;
  for (std::size_t b = 0; b < covers.size(); ++b)
    if (is_sheet(covers[b])) sheets.push_back(b);
  const auto larger = [&](std::size_t a, std::size_t b) { return size(a) != size(b) ? size(a) > size(b) : a < b; };
  const std::size_t kept = std::min(sheets.size(), most_sheets);
  std::partial_sort(sheets.begin(), sheets.begin() + static_cast<std::ptrdiff_t>(kept), sheets.end(), larger);
  sheets.resize(kept);
  return sheets;
}

}  // namespace

std::vector<std::size_t> find_ground_sheets(const Mesh& mesh, UpAxis up, const FacesOfBuildings& buildings) {
  std::vector<std::size_t> sheets;
  // Nothing has three others on it
  if (buildings.begin.size() < fewest_on_ground + 2) return sheets;
  std::vector<Cover> covers;
  for (std::size_t b = 0; b + 1 < buildings.begin.size(); ++b) covers.push_back(cover_of(mesh, up, faces_of(buildings, b)));
  for (const std::size_t b : sheets_among(covers))
    if (lies_below_others(mesh, up, faces_of(buildings, b), b, covers)) sheets.push_back(b);
  return sheets;
}

}  // namespace farlod::ingest
