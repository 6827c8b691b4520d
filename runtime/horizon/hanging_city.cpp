// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/hanging_city.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace farlod {
namespace {

/// A receiver this near to the outline of a triangle may count as below it: ten times the rounding of a coordinate in a cell.
constexpr float outline_width_m = 0.001F;

bool is_before(const Point3f& a, const Point3f& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// Distance to the left of the line from a to b, times the line's length.
float left_of(const Point3f& a, const Point3f& b, float x, float y) { return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x); }

bool covers(const HangingCity::TriangleCorners& t, float x, float y) {
  int left = 0, right = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3f &a = t[n], &b = t[(n + 1) % 3];
    const float slack = outline_width_m * (std::abs(b.x - a.x) + std::abs(b.y - a.y)), side = left_of(a, b, x, y);
    left += side >= -slack ? 1 : 0;
    right += side <= slack ? 1 : 0;
  }
  return left == 3 || right == 3;
}

struct Box {
  Point3f low, high;
};

Box box_of(const HangingCity::TriangleCorners& t) {
  Box box{t[0], t[0]};
  for (const Point3f& p : t) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

}  // namespace

HangingCity::HangingCity(std::span<const TriangleCorners> triangles) : triangles_(triangles.begin(), triangles.end()) {
  std::vector<HorizonEdge> all;
  for (const TriangleCorners& t : triangles)
    for (std::size_t n = 0; n < 3; ++n) {
      const Point3f &a = t[n], &b = t[(n + 1) % 3];
      all.push_back(is_before(a, b) ? HorizonEdge{a, b, {}} : HorizonEdge{b, a, {}});
    }
  std::sort(all.begin(), all.end(), [](const HorizonEdge& e, const HorizonEdge& f) {
    return std::tie(e.a.x, e.a.y, e.a.z, e.b.x, e.b.y, e.b.z) < std::tie(f.a.x, f.a.y, f.a.z, f.b.x, f.b.y, f.b.z);
  });
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (const HorizonEdge& e : all) edges_.add(e);
}

Occluder HangingCity::scene() const {
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
  for (const TriangleCorners& t : triangles_) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), t.begin(), t.end());
    triangles.push_back({first, first + 1, first + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

std::uint32_t HangingCity::covered(const ReceiverPacket& r) const {
  const auto [west, east] = std::minmax_element(r.x.begin(), r.x.end());
  const auto [south, north] = std::minmax_element(r.y.begin(), r.y.end());
  const float lowest_z = r.lowest_z();
  std::uint32_t bits = 0;
  for (const TriangleCorners& t : triangles_) {
    const Box box = box_of(t);
    if (box.high.z <= lowest_z || box.high.x < *west - outline_width_m || box.low.x > *east + outline_width_m ||
        box.high.y < *south - outline_width_m || box.low.y > *north + outline_width_m)
      continue;
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      if (box.high.z > r.z[l] && covers(t, r.x[l], r.y[l])) bits |= 1U << l;
  }
  return bits;
}

}  // namespace farlod
