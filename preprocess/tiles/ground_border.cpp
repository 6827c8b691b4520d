// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/ground_border.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace farlod::tiles {
namespace {

/// Nodes are no closer: a house at the border would have ever more of them.
constexpr double least_spacing_m = 5.0;
/// Heights that differ by less are the same.
constexpr double level_m = 1e-3;

/// A place of the border, and what is nearest to it.
struct BorderPlace {
  Point2d p_grid;
  double along_m = 0.0;  ///< way along the border from its first corner
  std::optional<NearestHeight> nearest;
  bool is_corner = false;
};

/// Goes around the rectangle once.
class BorderWalk {
 public:
  BorderWalk(const Box2d& rectangle, const NearestHeightBeyond& nearest_beyond) : nearest_beyond_(nearest_beyond) {
    const auto& [low, high] = rectangle;
    const std::array<Point2d, 4> corners{low, Point2d{high.x, low.y}, high, Point2d{low.x, high.y}};
    for (std::size_t n = 0; n < corners.size(); ++n) {
      BorderPlace corner = place_at(corners[n], length_m_);
      corner.is_corner = true;
      length_m_ += norm(corners[(n + 1) % 4] - corners[n]);
      keep(corner);
      divide(corner, place_at(corners[(n + 1) % 4], length_m_));
    }
  }

  [[nodiscard]] const std::vector<BorderPlace>& places() const { return places_; }

  /// Promise (2) of border_nodes.
  [[nodiscard]] double smooth_height_m(std::size_t place) const {
    const NearestHeight& here = *places_[place].nearest;
    double weights = share_m(place), differences = 0.0;
    for (const bool forward : {true, false})
      for (std::size_t n = beside(place, forward); n != place; n = beside(n, forward)) {
        const double way_m = this->way_m(forward ? place : n, forward ? n : place);
        if (way_m >= here.distance_m || 2.0 * way_m > length_m_) break;
        const double weight = share_m(n) * (1.0 - way_m / here.distance_m);
        weights += weight;
        differences += weight * (places_[n].nearest->height_m - here.height_m);
      }
    return weights > 0.0 ? here.height_m + differences / weights : here.height_m;
  }

 private:
  [[nodiscard]] BorderPlace place_at(Point2d p, double along_m) const { return {p, along_m, nearest_beyond_(p)}; }

  void keep(const BorderPlace& place) {
    if (place.nearest) places_.push_back(place);
  }

  /// Halves a part of a side until nothing known is nearer to its middle than twice its length.
  void divide(const BorderPlace& from, const BorderPlace& to) {
    const double length_m = to.along_m - from.along_m;
    if (length_m < 2.0 * least_spacing_m || (!from.nearest && !to.nearest)) return;  // what is known is convex
    const BorderPlace middle = place_at(0.5 * (from.p_grid + to.p_grid), 0.5 * (from.along_m + to.along_m));
    if (middle.nearest && middle.nearest->distance_m >= 2.0 * length_m) return;
    divide(from, middle);
    keep(middle);
    divide(middle, to);
  }

  [[nodiscard]] std::size_t beside(std::size_t n, bool forward) const {
    return (n + (forward ? 1 : places_.size() - 1)) % places_.size();
  }
  [[nodiscard]] double way_m(std::size_t from, std::size_t to) const {
    const double way_m = places_[to].along_m - places_[from].along_m;
    return way_m < 0.0 ? way_m + length_m_ : way_m;
  }
  /// The part of the border that a place stands for.
  [[nodiscard]] double share_m(std::size_t n) const { return 0.5 * (way_m(beside(n, false), n) + way_m(n, beside(n, true))); }

  const NearestHeightBeyond& nearest_beyond_;
  std::vector<BorderPlace> places_;
  double length_m_ = 0.0;
};

}  // namespace

std::vector<Point3d> border_nodes(const Box2d& rectangle, const NearestHeightBeyond& nearest_beyond) {
  const BorderWalk border(rectangle, nearest_beyond);
  const std::vector<BorderPlace>& places = border.places();
  std::vector<double> height_m;
  for (std::size_t n = 0; n < places.size(); ++n) height_m.push_back(border.smooth_height_m(n));
  const auto is_level = [&](std::size_t n) {
    const std::size_t all = places.size(), before = (n + all - 1) % all, after = (n + 1) % all;
    return std::abs(height_m[before] - height_m[n]) < level_m && std::abs(height_m[after] - height_m[n]) < level_m;
  };
  std::vector<Point3d> nodes;
  for (std::size_t n = 0; n < places.size(); ++n)
    if (places[n].is_corner || !is_level(n)) nodes.push_back({places[n].p_grid.x, places[n].p_grid.y, height_m[n]});
  return nodes;
}

}  // namespace farlod::tiles
