// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/trees/plant_cover.hpp"

#include <cstddef>
#include <tuple>
#include <utility>

namespace farlod::ingest {
namespace {

using Ring = PlantCover::Ring;
using Face = PlantCover::Face;

/// Boxes in degrees are no larger.
constexpr double largest_in_degrees = 0.05;
/// No CRS has larger coordinates.
constexpr double farthest = 1e9;

/// Sums over a face in the plan: positive where it is seen counter-clockwise from above.
struct PlanSums {
  double area = 0.0, volume = 0.0;  ///< `volume`: between it and the height of the origin

  explicit PlanSums(const Face& face) : PlanSums(face, face[0][0]) {}
  PlanSums(const Face& face, const Point3d& origin) {
    for (const Ring& ring : face)
      for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
        const Point3d a = ring[0] - origin, b = ring[k] - origin, c = ring[k + 1] - origin;
        const double triangle = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        area += triangle;
        volume += triangle * (a.z + b.z + c.z) / 3.0;
      }
  }
};

Box2d box_of(const Face& face) {
  Box2d box;
  for (const Point3d& p : face[0]) box.add(horizontal(p));
  return box;
}

/// A wall has no area in the plan, but for what rounding leaves.
bool is_wall(const Face& face) {
  constexpr double rounding = 1e-6;
  const Box2d box = box_of(face);
  const Point2d size = box.high - box.low;
  return std::abs(PlanSums(face).area) <= rounding * dot(size, size);
}

/// Those that are seen from above; where all are upside down, the others.
std::vector<const Face*> upper_faces(const std::vector<Face>& faces) {
  std::vector<const Face*> up, down;
  for (const Face& face : faces)
    if (!is_wall(face)) (PlanSums(face).area > 0.0 ? up : down).push_back(&face);
  return up.empty() ? down : up;
}

/// The length of the outline in the plan: of the edges that belong to one face alone.
double rim_length(const std::vector<const Face*>& faces) {
  using Edge = std::tuple<double, double, double, double>;
  std::vector<Edge> edges;
  for (const Face* face : faces)
    for (const Ring& ring : *face)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point3d &a = ring[k], &b = ring[(k + 1) % ring.size()];
        edges.push_back(std::pair(a.x, a.y) < std::pair(b.x, b.y) ? Edge{a.x, a.y, b.x, b.y} : Edge{b.x, b.y, a.x, a.y});
      }
  std::sort(edges.begin(), edges.end());
  double length = 0.0;
  for (std::size_t n = 0; n < edges.size();) {
    const std::size_t begin = n;
    while (n < edges.size() && edges[n] == edges[begin]) ++n;
    const auto& [x0, y0, x1, y1] = edges[begin];
    if (n - begin == 1) length += std::hypot(x1 - x0, y1 - y0);
  }
  return length;
}

double edge_for(const std::vector<Face>& faces, Point2d size) {
  constexpr double least_m = 0.25, largest_m = 2.0, squares_across = 4.0, most_along = 2048.0, most = 1e5;
  const std::vector<const Face*> upper = upper_faces(faces);
  double area = 0.0;
  for (const Face* face : upper) area += std::abs(PlanSums(*face).area);
  // A long strip is as wide as twice its area over its outline
  const double rim = rim_length(upper), width = rim > 0.0 ? 2.0 * area / rim : 0.0;
  const double wished_m = std::clamp(width / squares_across, least_m, largest_m);
  return std::max({wished_m, std::max(size.x, size.y) / most_along, std::sqrt(area / most)});
}

/// Squares along the axes of the file, counted from the corner of a cover.
class Lattice {
 public:
  Lattice(const Box2d& box, double edge_m)
      : corner_(box.low),
        edge_m_(edge_m),
        columns_(count_of(box.high.x - box.low.x)),
        rows_(count_of(box.high.y - box.low.y)),
        covered_(columns_ * rows_) {}

  /// Those whose centres are in a face in the plan: between its first and its second crossing with their row, and so on.
  void cover(const Face& face) {
    const Box2d box = box_of(face);
    const std::size_t row_end = std::min(first_behind(box.high.y - corner_.y), rows_);
    for (std::size_t row = first_behind(box.low.y - corner_.y); row < row_end; ++row) {
      const std::vector<double> crossings = crossings_of(face, centre(0, row).y);
      for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
        const std::size_t end = std::min(first_behind(crossings[k + 1] - corner_.x), columns_);
        for (std::size_t column = first_behind(crossings[k] - corner_.x); column < end; ++column)
          covered_[row * columns_ + column] = true;
      }
    }
  }
  /// `use(centre)` for each square that is covered; returns how many there are.
  template <class Use>
  std::size_t for_each(const Use& use) const {
    std::size_t count = 0;
    for (std::size_t n = 0; n < covered_.size(); ++n)
      if (covered_[n]) {
        use(centre(n % columns_, n / columns_));
        ++count;
      }
    return count;
  }
  [[nodiscard]] double edge_m() const { return edge_m_; }

 private:
  [[nodiscard]] std::size_t count_of(double length_m) const {
    return static_cast<std::size_t>(std::ceil(length_m / edge_m_)) + 1;
  }
  /// The number of the first square whose centre is not before it.
  [[nodiscard]] std::size_t first_behind(double along_m) const {
    return static_cast<std::size_t>(std::max(0.0, std::ceil(along_m / edge_m_ - 0.5)));
  }
  [[nodiscard]] Point2d centre(std::size_t column, std::size_t row) const {
    return corner_ + edge_m_ * Point2d{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
  }
  static std::vector<double> crossings_of(const Face& face, double y) {
    std::vector<double> crossings;
    for (const Ring& ring : face)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point3d &a = ring[k], &b = ring[(k + 1) % ring.size()];
        if ((a.y <= y) != (b.y <= y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
      }
    std::sort(crossings.begin(), crossings.end());
    return crossings;
  }

  Point2d corner_;
  double edge_m_;
  std::size_t columns_, rows_;
  std::vector<bool> covered_;
};

}  // namespace

void PlantCover::begin_geometry(int level_of_detail, bool is_solid) {
  is_wanted_ = level_of_detail >= level_of_detail_;
  if (!is_wanted_) return;
  if (level_of_detail > level_of_detail_) faces_.clear();
  is_solid_ = is_solid;
  level_of_detail_ = level_of_detail;
}

void PlantCover::add_face(Face face) {
  for (Ring& ring : face) {
    // Not of a number that is none
    const auto is_near = [](const Point3d& p) {
      return std::abs(p.x) <= farthest && std::abs(p.y) <= farthest && std::abs(p.z) <= farthest;
    };
    if (!std::all_of(ring.begin(), ring.end(), is_near)) return;
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  }
  const auto is_line = [](const Ring& ring) { return ring.size() < 3; };
  if (!is_wanted_ || face.empty() || is_line(face[0])) return;
  std::erase_if(face, is_line);
  faces_.push_back(std::move(face));
}

std::optional<double> PlantCover::height_m() const {
  if (average_height_m || !is_solid_ || faces_.empty()) return average_height_m;
  double volume = 0.0, area = 0.0;
  for (const Face& face : faces_) {
    const PlanSums sums(face, faces_[0][0][0]);
    volume += sums.volume;
    area += 0.5 * std::abs(sums.area);
  }
  return area > 0.0 ? std::optional(std::abs(volume) / area) : std::nullopt;
}

namespace {

/// A lower one is ground cover: it is not above the eyes of a pedestrian, and rasters of canopies are usually cut there, too.
constexpr double lowest_plant_cover_m = 2.0;

}  // namespace

void PlantCover::hand_over(TreeCollector& trees) const {
  const std::optional<double> height = height_m();
  // Many files write 0, or a negative number, for what they do not know
  if (!height || !(*height > 0.0)) return trees.skip("PlantCover without a height");
  if (*height < lowest_plant_cover_m) return trees.skip("PlantCover lower than 2 m");
  if (*height > highest_tree_m) return trees.note(ProblemCode::absurd_tree_size, name, "a PlantCover higher than any tree");
  Box2d box;
  for (const Face& face : faces_)
    for (const Point3d& p : face[0]) box.add(horizontal(p));
  if (box.empty()) return trees.note(ProblemCode::no_geometry, name, "it has no surface");
  const Point2d size = box.high - box.low;
  if (std::max(size.x, size.y) <= largest_in_degrees) return trees.skip("PlantCover in degrees");
  Lattice lattice(box, edge_for(faces_, size));
  for (const Face& face : faces_)
    if (!is_wall(face)) lattice.cover(face);
  const auto add = [&](Point2d centre) { trees.add_square(centre, lattice.edge_m(), *height); };
  if (lattice.for_each(add) == 0) trees.note(ProblemCode::not_an_area, name, "it covers no ground");
}

}  // namespace farlod::ingest
