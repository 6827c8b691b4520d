// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/triangle_index.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/expects.hpp"

namespace farlod {
namespace {

Point3d middle_of(const TriangleIndex::Corners& t) { return (1.0 / 3.0) * (t[0] + t[1] + t[2]); }

/// How far a triangle reaches along a vector, and a box: the same products and sums in the same order, so that rounding leads no
/// box astray that a triangle in it is not.
double reach(const TriangleIndex::Corners& triangle, const Point3d& n) {
  return std::max({dot(n, triangle[0]), dot(n, triangle[1]), dot(n, triangle[2])});
}
struct RelativeBox {
  Point3d low, high;
};
double reach(const RelativeBox& box, const Point3d& n) {
  return dot(n,
             Point3d{n.x < 0.0 ? box.low.x : box.high.x, n.y < 0.0 ? box.low.y : box.high.y, n.z < 0.0 ? box.low.z : box.high.z});
}

}  // namespace

/// A sector, above a slope that rises; and who is told.
class TriangleIndex::Question {
 public:
  Question(const Sector& sector, double slope, const OnTriangles& on_triangles)
      : eye_(sector.eye),
        along_{sector.from.x, sector.from.y, 0.0},
        left_{-sector.from.y, sector.from.x, 0.0},
        right_(sector.tangent * along_ - left_),
        normal_(sector.normal),
        on_triangles_(on_triangles) {
    raise_to(slope);
  }
  [[nodiscard]] bool is_reached_by(const Box& box) const { return is_reached_by(seen(box)); }
  /// Greater for what begins nearer.
  [[nodiscard]] double nearness(const Box& box) const { return reach(seen(box), -1.0 * along_); }
  void tell(std::span<const Corners> leaf) {
    std::array<Corners, leaf_triangles> reaching;
    std::size_t count = 0;
    for (const auto& [a, b, c] : leaf) {
      reaching[count] = {a - eye_, b - eye_, c - eye_};
      count += is_reached_by(reaching[count]) ? 1 : 0;
    }
    if (count > 0) raise_to(on_triangles_(std::span(reaching).first(count)));
  }

 private:
  [[nodiscard]] RelativeBox seen(const Box& box) const { return {box.low - eye_, box.high - eye_}; }
  template <class Body>
  [[nodiscard]] bool is_reached_by(const Body& body) const {
    return reach(body, left_) >= 0.0 && reach(body, right_) >= 0.0 && reach(body, along_) >= 0.0 && reach(body, above_) > 0.0 &&
           reach(body, normal_) > 0.0;
  }
  /// Nothing is above an endless slope.
  void raise_to(double slope) { above_ = std::isinf(slope) ? Point3d{} : Point3d{-slope * along_.x, -slope * along_.y, 1.0}; }

  Point3d eye_, along_, left_, right_, normal_, above_;
  const OnTriangles& on_triangles_;
};

void TriangleIndex::Box::add(const Point3d& p) {
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

TriangleIndex::TriangleIndex(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
  FARLOD_EXPECTS(triangles_.size() <= std::numeric_limits<std::uint32_t>::max());
  if (!triangles_.empty()) add_node(0, static_cast<std::uint32_t>(triangles_.size()));
}

/// Halves the triangles where their middles reach farthest in the plan: wedges are upright.
void TriangleIndex::add_node(std::uint32_t first, std::uint32_t last) {
  const auto begin = triangles_.begin() + first, end = triangles_.begin() + last;
  Box box, middles;
  for (auto triangle = begin; triangle != end; ++triangle) {
    for (const Point3d& p : *triangle) box.add(p);
    middles.add(middle_of(*triangle));
  }
  const std::size_t number = nodes_.size();
  nodes_.push_back({box, first, last, 0});
  if (last - first <= leaf_triangles) return;
  const bool along_x = middles.high.x - middles.low.x > middles.high.y - middles.low.y;
  const auto place = [&](const Corners& t) { return along_x ? middle_of(t).x : middle_of(t).y; };
  const std::uint32_t half = first + (last - first) / 2;
  std::nth_element(begin, triangles_.begin() + half, end,
                   [&](const Corners& a, const Corners& b) { return place(a) < place(b); });
  add_node(first, half);
  nodes_[number].second_child = static_cast<std::uint32_t>(nodes_.size());
  add_node(half, last);
}

void TriangleIndex::find(const Sector& sector, double slope, const OnTriangles& on_triangles) const {
  if (nodes_.empty()) return;
  Question question(sector, slope, on_triangles);
  visit(0, question);
}

void TriangleIndex::visit(std::uint32_t number, Question& question) const {
  const Node& node = nodes_[number];
  if (!question.is_reached_by(node.box)) return;
  if (node.second_child == 0) {
    question.tell(triangles().subspan(node.first, node.last - node.first));
    return;
  }
  std::uint32_t near = number + 1, far = node.second_child;
  if (question.nearness(nodes_[far].box) > question.nearness(nodes_[near].box)) std::swap(near, far);
  visit(near, question);
  visit(far, question);
}

}  // namespace farlod
