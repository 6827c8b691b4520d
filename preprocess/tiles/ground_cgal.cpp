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

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/expects.hpp"
#include "city/geometry.hpp"
#include "tiles/ground.hpp"
#include "tiles/ground_border.hpp"
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
NearestHeight nearest_height(const Network& network, Point2d p) {
  const auto distance_m = [p](const Kernel::Point_3& q) { return std::hypot(q.x() - p.x, q.y() - p.y); };
  if (network.dimension() == 2) {
    const Kernel::Point_3& nearest = network.nearest_vertex(Kernel::Point_3(p.x, p.y, 0.0))->point();
    return {nearest.z(), distance_m(nearest)};
  }
  NearestHeight nearest{0.0, std::numeric_limits<double>::infinity()};
  for (auto v = network.finite_vertices_begin(); v != network.finite_vertices_end(); ++v)
    if (const double distance = distance_m(v->point()); distance < nearest.distance_m) nearest = {v->point().z(), distance};
  return nearest;
}

Point3d from_cgal(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

using Hull = std::vector<std::pair<Point3d, Point3d>>;
Hull hull_of(const Network& network) {
  Hull edges;
  Network::Face_circulator face = network.incident_faces(network.infinite_vertex());
  const Network::Face_circulator first = face;
  do {
    const int n = face->index(network.infinite_vertex());
    edges.emplace_back(from_cgal(face->vertex(Network::cw(n))->point()), from_cgal(face->vertex(Network::ccw(n))->point()));
  } while (++face != first);
  return edges;
}

/// The height of the nearest place of the hull, between two points of it, too.
NearestHeight nearest_of_hull(const Hull& hull, Point2d p) {
  NearestHeight nearest{0.0, std::numeric_limits<double>::infinity()};
  for (const auto& [a, b] : hull) {
    const Point2d along = horizontal(b) - horizontal(a);
    const double share = std::clamp(dot(p - horizontal(a), along) / dot(along, along), 0.0, 1.0);
    const double distance_m = norm(horizontal(a) + share * along - p);
    if (distance_m < nearest.distance_m) nearest = {a.z + share * (b.z - a.z), distance_m};
  }
  return nearest;
}

/// Nodes along the border of the rectangle. All are computed before the first is inserted, so that none is the nearest point of
/// another one.
std::vector<Point3d> nodes_beyond(const Network& network, const Box2d& rectangle) {
  const Hull hull = network.dimension() == 2 ? hull_of(network) : Hull();
  Network::Face_handle last;
  const auto nearest_beyond = [&](Point2d p) -> std::optional<NearestHeight> {
    if (network.dimension() < 2) return nearest_height(network, p);
    last = network.locate(Kernel::Point_3(p.x, p.y, 0.0), last);
    if (!network.is_infinite(last)) return std::nullopt;
    return nearest_of_hull(hull, p);
  };
  return border_nodes(rectangle, nearest_beyond);
}

/// A network that goes on beyond the hull of its points. Its faces between them stay as they are, where Network::insert would
/// flip edges of the hull: a constrained Delaunay triangulation, of which these edges are the constraints.
class NetworkBeyond {
 public:
  explicit NetworkBeyond(Network& network) : network_(network) {}

  void insert(const Point3d& node) {
    const auto before = network_.number_of_vertices();
    const Network::Vertex_handle v = static_cast<CGAL::Triangulation_2<Plan>&>(network_).insert({node.x, node.y, node.z});
    // There may be a point at this place
    if (network_.number_of_vertices() == before) return;
    nodes_.insert(v);
    if (network_.dimension() < 2) return;
    std::vector<Network::Face_handle> faces;
    Network::Face_circulator face = network_.incident_faces(v);
    const Network::Face_circulator first = face;
    do faces.push_back(face);
    while (++face != first);
    for (const Network::Face_handle f : faces) flip_as_far_as_needed(f, v);
  }

 private:
  /// Lies beyond the hull, which is convex: one of its vertices does.
  [[nodiscard]] bool is_beyond(Network::Face_handle face) const {
    return !network_.is_infinite(face) &&
           (nodes_.contains(face->vertex(0)) || nodes_.contains(face->vertex(1)) || nodes_.contains(face->vertex(2)));
  }
  /// Flips the edge opposite to a new vertex if the circle around the face behind it contains that, and then the next ones.
  void flip_as_far_as_needed(Network::Face_handle face, Network::Vertex_handle v) {
    const int n = face->index(v);
    const Network::Face_handle behind = face->neighbor(n);
    if (!is_beyond(face) || !is_beyond(behind)) return;
    if (network_.side_of_oriented_circle(behind, v->point(), true) != CGAL::ON_POSITIVE_SIDE) return;
    network_.flip(face, n);
    flip_as_far_as_needed(face, v);
    flip_as_far_as_needed(behind, v);
  }

  Network& network_;
  std::set<Network::Vertex_handle> nodes_;
};

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
  NetworkBeyond beyond(network);
  for (const Point3d& node : nodes_beyond(network, rectangle)) beyond.insert(node);
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
  if (face == nullptr || network.is_infinite(face)) return nearest_height(network, p).height_m;
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
