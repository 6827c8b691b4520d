// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/open_ends.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

namespace farlod {
namespace {

/// More open edges than this at one point are taken for open without comparing each with each.
constexpr std::size_t most_edges_compared = 64;

bool comes_first(const Point3d& a, const Point3d& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

struct EdgeEnd {
  Point3d point;
  std::uint32_t edge;
};

/// Edges of a point that lie on one line.
struct Bundle {
  std::uint32_t first_edge;
  std::size_t edge_count;
};

double distance_from_line_m(const Point3d& p, const Point3d& on_line, const Point3d& along) {
  const double length = norm(along);
  return length > 0.0 ? norm(cross(along, p - on_line)) / length : norm(p - on_line);
}

class OpenBorder {
 public:
  explicit OpenBorder(std::span<const Segment3d> edges) : edges_(edges), line_of_(edges.size()) {
    std::iota(line_of_.begin(), line_of_.end(), 0U);
    for (std::uint32_t n = 0; n < edges.size(); ++n) {
      ends_.push_back({edges[n].a, n});
      ends_.push_back({edges[n].b, n});
    }
    std::stable_sort(ends_.begin(), ends_.end(),
                     [](const EdgeEnd& a, const EdgeEnd& b) { return comes_first(a.point, b.point); });
  }

  std::vector<Point3d> ends() {
    for (std::size_t first = 0, last = 0; first < ends_.size(); first = last) {
      while (last < ends_.size() && ends_[last].point == ends_[first].point) ++last;
      visit_point(std::span(ends_).subspan(first, last - first));
    }
    add_points_of_bent_lines();
    std::sort(result_.begin(), result_.end(), comes_first);
    result_.erase(std::unique(result_.begin(), result_.end()), result_.end());
    return std::move(result_);
  }

 private:
  void visit_point(std::span<const EdgeEnd> ends) {
    const Point3d& point = ends.front().point;
    if (ends.size() > most_edges_compared) return result_.push_back(point);
    std::vector<Bundle> bundles;
    for (const EdgeEnd& end : ends) {
      const auto bundle = std::find_if(bundles.begin(), bundles.end(), [&](const Bundle& b) {
        return on_one_line(point, edges_[b.first_edge], edges_[end.edge]);
      });
      if (bundle == bundles.end()) {
        bundles.push_back({end.edge, 1});
        continue;
      }
      ++bundle->edge_count;
      line_of_[line_of(end.edge)] = line_of(bundle->first_edge);
    }
    for (const Bundle& b : bundles)
      if (b.edge_count % 2 == 1) result_.push_back(point);
  }

  /// Whether the end of the shorter of two edges of a point lies on the line of the longer.
  static bool on_one_line(const Point3d& point, const Segment3d& s, const Segment3d& t) {
    Point3d u = (s.a == point ? s.b : s.a) - point, v = (t.a == point ? t.b : t.a) - point;
    if (norm(u) < norm(v)) std::swap(u, v);
    return distance_from_line_m(v, {}, u) <= on_line_m;
  }

  std::uint32_t line_of(std::uint32_t edge) {
    while (line_of_[edge] != edge) edge = line_of_[edge] = line_of_[line_of_[edge]];
    return edge;
  }

  /// Steps that are straight one by one may lead round a circle: what does not lie on one line closes nothing.
  void add_points_of_bent_lines() {
    std::map<std::uint32_t, std::vector<Point3d>> points_of_lines;
    for (std::uint32_t n = 0; n < edges_.size(); ++n) {
      auto& points = points_of_lines[line_of(n)];
      points.insert(points.end(), {edges_[n].a, edges_[n].b});
    }
    for (const auto& [line, points] : points_of_lines)
      if (!lie_on_a_line(points)) result_.insert(result_.end(), points.begin(), points.end());
  }

  static bool lie_on_a_line(const std::vector<Point3d>& points) {
    const auto farthest_from = [&points](const Point3d& p) {
      return *std::max_element(points.begin(), points.end(),
                               [&p](const Point3d& a, const Point3d& b) { return norm(a - p) < norm(b - p); });
    };
    const Point3d one_end = farthest_from(points.front()), along = farthest_from(one_end) - one_end;
    return std::all_of(points.begin(), points.end(),
                       [&](const Point3d& p) { return distance_from_line_m(p, one_end, along) <= on_line_m; });
  }

  std::span<const Segment3d> edges_;
  std::vector<std::uint32_t> line_of_;  ///< a forest: edges on one line have one root
  std::vector<EdgeEnd> ends_;
  std::vector<Point3d> result_;
};

}  // namespace

std::vector<Point3d> open_ends(std::span<const Segment3d> open_edges) { return OpenBorder(open_edges).ends(); }

}  // namespace farlod
