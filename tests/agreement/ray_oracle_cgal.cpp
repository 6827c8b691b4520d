// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

// CGAL 6 has these by new names, and warns of the old ones
#if __has_include(<CGAL/AABB_traits_3.h>)
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <vector>

#include "tests/agreement/ray_oracle.hpp"
#include "tiles/facet_triangulation.hpp"

namespace farlod {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
#if __has_include(<CGAL/AABB_traits_3.h>)
using Traits = CGAL::AABB_traits_3<Kernel, CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>>;
#else
using Traits = CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>;
#endif
using TriangleTree = CGAL::AABB_tree<Traits>;

Triangles triangles_of(const CityModel& city) {
  Triangles triangles;
  for (const Facet& facet : city.facets()) {
    std::vector<std::span<const Point3d>> rings;
    for (std::uint32_t k = 0; k < facet.ring_count; ++k) rings.push_back(city.ring(facet, k));
    const tiles::Triangulation t = tiles::triangulate(rings);
    const auto corner = [&t](std::uint32_t n) { return Kernel::Point_3(t.points[n].x, t.points[n].y, t.points[n].z); };
    for (const Triangle& c : t.triangles) triangles.emplace_back(corner(c.a), corner(c.b), corner(c.c));
  }
  return triangles;
}

}  // namespace

struct RayOracle::Impl {
  Triangles triangles;
  TriangleTree tree;
  explicit Impl(Triangles t) : triangles(std::move(t)), tree(triangles.cbegin(), triangles.cend()) {}
};

RayOracle::RayOracle(const CityModel& city, std::span<const Corners> ground) {
  Triangles triangles = triangles_of(city);
  const auto exactly = [](const Point3d& p) { return Kernel::Point_3(p.x, p.y, p.z); };
  for (const Corners& t : ground) triangles.emplace_back(exactly(t[0]), exactly(t[1]), exactly(t[2]));
  impl_ = std::make_unique<Impl>(std::move(triangles));
}
RayOracle::~RayOracle() = default;

bool RayOracle::blocks(const Point3d& o, const Point3d& d) const {
  return impl_->tree.do_intersect(Kernel::Ray_3({o.x, o.y, o.z}, Kernel::Vector_3(d.x, d.y, d.z)));
}

}  // namespace farlod
