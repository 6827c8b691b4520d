// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_xy_3.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "farlod/expects.hpp"
#include "tiles/ground.hpp"

namespace farlod {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Network = CGAL::Delaunay_triangulation_2<CGAL::Projection_traits_xy_3<Kernel>>;

/// By place, lowest first, so that the lowest of several at one place is the first of them.
void keep_lowest(std::vector<Point3d>& points) {
  std::sort(points.begin(), points.end(),
            [](const Point3d& a, const Point3d& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  points.erase(std::unique(points.begin(), points.end(), [](const Point3d& a, const Point3d& b) { return a.x == b.x && a.y == b.y; }),
               points.end());
}

double height_of_nearest(const std::vector<Point3d>& points, Point2d p) {
  const auto nearest = std::min_element(points.begin(), points.end(), [p](const Point3d& a, const Point3d& b) {
    return norm(horizontal(a) - p) < norm(horizontal(b) - p);
  });
  return nearest == points.end() ? 0.0 : nearest->z;
}

Point3d from_cgal(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

struct Ground::Impl {
  Network network;
  Box2d rectangle;
  Network::Face_handle last_found;
};

Ground::Ground(std::vector<Point3d> points, const Box2d& rectangle) : impl_(std::make_unique<Impl>()) {
  FARLOD_EXPECTS(!rectangle.empty());
  impl_->rectangle = rectangle;
  const std::array corners{rectangle.low, Point2d{rectangle.high.x, rectangle.low.y}, rectangle.high, Point2d{rectangle.low.x, rectangle.high.y}};
  std::array<double, 4> heights{};
  for (std::size_t k = 0; k < 4; ++k) heights[k] = height_of_nearest(points, corners[k]);
  for (std::size_t k = 0; k < 4; ++k) points.push_back({corners[k].x, corners[k].y, heights[k]});
  keep_lowest(points);
  std::vector<Kernel::Point_3> input;
  input.reserve(points.size());
  for (const Point3d& p : points) input.emplace_back(p.x, p.y, p.z);
  impl_->network.insert(input.begin(), input.end());
}
Ground::Ground(Ground&&) noexcept = default;
Ground& Ground::operator=(Ground&&) noexcept = default;
Ground::~Ground() = default;

double Ground::height_at(Point2d p) const {
  const Box2d& r = impl_->rectangle;
  const Kernel::Point_3 query(std::clamp(p.x, r.low.x, r.high.x), std::clamp(p.y, r.low.y, r.high.y), 0.0);
  const auto face = impl_->network.locate(query, impl_->last_found);
  FARLOD_EXPECTS(face != nullptr && !impl_->network.is_infinite(face));
  impl_->last_found = face;
  const Point3d a = from_cgal(face->vertex(0)->point()), b = from_cgal(face->vertex(1)->point()), c = from_cgal(face->vertex(2)->point());
  const Point3d n = cross(b - a, c - a);
  return a.z - (n.x * (query.x() - a.x) + n.y * (query.y() - a.y)) / n.z;
}

std::vector<std::array<Point3d, 3>> Ground::triangles() const {
  std::vector<std::array<Point3d, 3>> result;
  result.reserve(impl_->network.number_of_faces());
  for (auto face = impl_->network.finite_faces_begin(); face != impl_->network.finite_faces_end(); ++face)
    result.push_back({from_cgal(face->vertex(0)->point()), from_cgal(face->vertex(1)->point()), from_cgal(face->vertex(2)->point())});
  return result;
}

}  // namespace farlod
