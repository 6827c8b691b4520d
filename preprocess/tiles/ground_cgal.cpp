// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/paging/memory_bound.hpp"
#include "base/paging/paged_heap.hpp"
// The network of a large city has a hundred million faces. Its containers ask for memory through this name; see decision 0020
#define CGAL_ALLOCATOR(T) farlod::PagedAllocator<T>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_xy_3.h>
#include <CGAL/spatial_sort.h>

#include <limits>
#include <utility>

#include "base/expects.hpp"
#include "city/geometry.hpp"
#include "tiles/ground.hpp"
#include "tiles/modelled_ground.hpp"

namespace farlod::tiles {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// Types of this file alone: in others, containers of faces and vertices have another allocator.
struct Plan : CGAL::Projection_traits_xy_3<Kernel> {};
using Network = CGAL::Delaunay_triangulation_2<Plan>;

/// Points, faces or heights that are asked for between two looks at the memory.
constexpr std::size_t accesses_between_looks = 64;

/// Sorts the points by place and height, and keeps the lowest point of each place.
void keep_lowest(PagedArray<Point3d>& points) {
  std::sort(points.begin(), points.end(), comes_first);
  const Point3d* const end =
      std::unique(points.begin(), points.end(), [](const Point3d& a, const Point3d& b) { return a.x == b.x && a.y == b.y; });
  points.resize(static_cast<std::size_t>(end - points.begin()));
}

PagedArray<Kernel::Point_3> to_cgal(const PagedArray<Point3d>& points) {
  PagedArray<Kernel::Point_3> result;
  for (const Point3d& p : points) result.push_back({p.x, p.y, p.z});
  return result;
}

/// CGAL finds no nearest point while all points lie on a line. Such cities are rare and small: compare all points.
double height_of_nearest(const Network& network, Point2d p) {
  if (network.dimension() == 2) return network.nearest_vertex(Kernel::Point_3(p.x, p.y, 0.0))->point().z();
  double height = 0.0, least = std::numeric_limits<double>::infinity();
  for (auto v = network.finite_vertices_begin(); v != network.finite_vertices_end(); ++v) {
    const double distance = std::hypot(v->point().x() - p.x, v->point().y() - p.y);
    if (distance >= least) continue;
    least = distance;
    height = v->point().z();
  }
  return height;
}

/// What Network::insert does with a range, but for the copy that it makes of the points. Neighbors come one after the other, so
/// that what is in use of the network is a small part of it.
void insert_all(PagedArray<Kernel::Point_3> points, Network& network) {
  CGAL::spatial_sort(points.begin(), points.end(), network.geom_traits());
  Network::Face_handle hint;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (n % accesses_between_looks == 0) MemoryBound::look_now();
    hint = network.insert(points[n], hint)->face();
  }
}

Point3d from_cgal(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// Height at a place of the plane through three corners.
double height_in_plane(const std::array<Point3d, 3>& corners, Point2d p) {
  const auto& [a, b, c] = corners;
  const Point3d n = cross(b - a, c - a);
  return a.z - (n.x * (p.x - a.x) + n.y * (p.y - a.y)) / n.z;
}

/// Whether a place is within a triangle or no farther from it than rounding moves the points of a border.
bool is_within(const std::array<Point3d, 3>& corners, Point2d p) {
  constexpr double rounding_m = 1e-9;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point2d a = horizontal(corners[k]), along = horizontal(corners[(k + 1) % 3]) - a, to_p = p - a;
    const double left = along.x * to_p.y - along.y * to_p.x;
    if (left < 0.0 && left * left > rounding_m * rounding_m * dot(along, along)) return false;
  }
  return true;
}

}  // namespace

struct Ground::Impl {
  std::optional<ModelledGround> model;  ///< instead of the network
  Network network;
  Network::Face_handle last_found;
  std::size_t asked = 0;  ///< heights

  [[nodiscard]] static std::array<Point3d, 3> corners_of(Network::Face_handle face) {
    return {from_cgal(face->vertex(0)->point()), from_cgal(face->vertex(1)->point()), from_cgal(face->vertex(2)->point())};
  }
};

Ground::Ground(PagedArray<Point3d> points, const Box2d& rectangle, GroundExtent extent) : impl_(std::make_unique<Impl>()) {
  FARLOD_EXPECTS(!rectangle.empty());
  keep_lowest(points);
  PagedArray<Kernel::Point_3> input = to_cgal(points);
  points = PagedArray<Point3d>();
  Network& network = impl_->network;
  insert_all(std::move(input), network);
  if (extent == GroundExtent::points) return;
  // Compute all heights before the first insertion, so that no corner is the nearest point of another one. Corners inside the
  // network do not change it
  std::vector<Kernel::Point_3> corners;
  for (const Point2d c :
       {rectangle.low, Point2d{rectangle.high.x, rectangle.low.y}, rectangle.high, Point2d{rectangle.low.x, rectangle.high.y}})
    corners.emplace_back(c.x, c.y, height_at(c));
  // CGAL ignores a corner at the place of an existing point
  for (const Kernel::Point_3& corner : corners) network.insert(corner);
}
Ground::Ground(const TerrainRaster& surface_model, PixelSteps steps, const GridRotation& rotation)
    : impl_(std::make_unique<Impl>()) {
  impl_->model.emplace(surface_model, std::move(steps), rotation);
}
Ground::Ground(Ground&&) noexcept = default;
Ground& Ground::operator=(Ground&&) noexcept = default;
Ground::~Ground() = default;

double Ground::height_at(Point2d p) const {
  if (impl_->model) return impl_->model->height_at(p);
  const Network& network = impl_->network;
  if (++impl_->asked % accesses_between_looks == 0) MemoryBound::look_now();
  const Kernel::Point_3 query(p.x, p.y, 0.0);
  const auto face = network.dimension() == 2 ? network.locate(query, impl_->last_found) : nullptr;
  if (face == nullptr || network.is_infinite(face)) return height_of_nearest(network, p);
  impl_->last_found = face;
  return height_in_plane(Impl::corners_of(face), p);
}

bool Ground::is_above(const Point3d& p, double height_m) const {
  if (impl_->model) return p.z > height_at(horizontal(p)) + height_m;
  // Beside the triangle that was found last, the ground is as high as at its border, up to what lies within the millimetre
  constexpr double certain_m = 1e-3;
  if (const Network::Face_handle last = impl_->last_found; last != nullptr)
    for (const Network::Face_handle face : {last, last->neighbor(0), last->neighbor(1), last->neighbor(2)}) {
      if (impl_->network.is_infinite(face)) continue;
      const std::array<Point3d, 3> corners = Impl::corners_of(face);
      if (!is_within(corners, horizontal(p))) continue;
      impl_->last_found = face;
      const double above_m = p.z - height_in_plane(corners, horizontal(p)) - height_m;
      if (std::abs(above_m) > certain_m) return above_m > 0.0;
      break;
    }
  return p.z > height_at(horizontal(p)) + height_m;
}

std::optional<double> Ground::lowest_m() const {
  if (impl_->model) return impl_->model->lowest_m();
  const Network& network = impl_->network;
  if (network.dimension() < 2) return std::nullopt;
  double lowest_m = std::numeric_limits<double>::infinity();
  for (auto v = network.finite_vertices_begin(); v != network.finite_vertices_end(); ++v)
    lowest_m = std::min(lowest_m, v->point().z());
  return lowest_m;
}

const SteppedSurface* Ground::surface() const { return impl_->model ? &impl_->model->surface() : nullptr; }

std::uint64_t Ground::leave_out_squares(const Grid& grid, SquaresOfReaders squares,
                                        const std::function<bool(std::uint64_t)>& are_enough) {
  FARLOD_EXPECTS(impl_->model.has_value());
  return impl_->model->leave_out_squares(grid, squares, are_enough);
}

const PixelSteps& Ground::pixel_steps() const {
  FARLOD_EXPECTS(impl_->model.has_value());
  return impl_->model->steps();
}

std::vector<HorizonSegment> GroundFace::horizon_edges() const {
  std::vector<HorizonSegment> result;
  for (std::size_t opposite = 0; opposite < 3; ++opposite) {
    const Point3d &a = corners[(opposite + 1) % 3], &b = corners[(opposite + 2) % 3];
    const std::optional<Point3d>& neighbor = beyond[opposite];
    if (neighbor && std::pair(b.x, b.y) < std::pair(a.x, a.y)) continue;  // added by the other face
    EdgeSides edge(a, b);
    edge.add(corners[opposite], FacetLook::up);
    if (neighbor) edge.add(*neighbor, FacetLook::up);
    if (edge.can_be_horizon()) result.push_back({edge.edge(), edge.adjacent()});
  }
  return result;
}

// It goes over faces: finite_edges chooses between the two faces of an edge by their addresses, which differ from run to run
struct GroundFaces::Impl {
  const Network& network;
  const SteppedSurface* surface = nullptr;  ///< instead of the network
  Network::Finite_faces_iterator face = network.finite_faces_begin();
  std::size_t triangle = 0;  ///< of the surface
};

GroundFaces::GroundFaces(const Ground& ground)
    : impl_(new Impl{ground.impl_->network, ground.impl_->model ? &ground.impl_->model->surface() : nullptr}) {}
GroundFaces::GroundFaces(GroundFaces&&) noexcept = default;
GroundFaces::~GroundFaces() = default;

std::vector<GroundFace> GroundFaces::next(std::size_t most) {
  auto& [network, surface, face, triangle] = *impl_;
  std::vector<GroundFace> faces;
  faces.reserve(most);
  if (surface != nullptr) {
    while (faces.size() < most && triangle < surface->triangles.size()) faces.push_back({surface->triangles[triangle++]});
    return faces;
  }
  for (; faces.size() < most && face != network.finite_faces_end(); ++face) {
    if (faces.size() % accesses_between_looks == 0) MemoryBound::look_now();
    GroundFace& found = faces.emplace_back();
    for (int n = 0; n < 3; ++n) {
      const auto place = static_cast<std::size_t>(n);
      found.corners[place] = from_cgal(face->vertex(n)->point());
      const auto [beyond, third] = network.mirror_edge({face, n});
      if (!network.is_infinite(beyond)) found.beyond[place] = from_cgal(beyond->vertex(third)->point());
    }
  }
  return faces;
}

}  // namespace farlod::tiles
