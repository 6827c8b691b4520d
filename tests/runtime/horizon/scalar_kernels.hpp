// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "farlod/point.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_partition.hpp"
#include "package/horizon_edge.hpp"

/// What the kernels (horizon/kernels.hpp) compute, for one receiver and one azimuth at a time: without lanes, culling or slots.
/// The operations on floats come in the same order, so that the results must be equal bit for bit.
namespace farlod::scalar {

inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// A receiver's azimuth: a unit vector in the plan.
struct Azimuth {
  float x, y;
};

// --- Edges
// -----------------------------------------------------------------------------------------------------------------------

/// The upper bound of the slope at which any receiver in the bounds sees the edge: −1 for none, infinite for a nearby edge.
inline float max_slope_of(const HorizonEdge& e, const PacketBounds& packet) {
  const CenteredBox& box = packet.box;
  const auto depth = [&](const Point3f& p) { return packet.normal_x * p.x + packet.normal_y * p.y + packet.normal_z * p.z; };
  const float rise = max(e.a.z, e.b.z) - box.low_z, in_front = max(depth(e.a), depth(e.b)) - packet.depth;
  if (min(rise, in_front) <= 0.0F) return -1.0F;
  // The nearest point of the edge to the box's centre
  const float px = e.a.x - box.x, py = e.a.y - box.y, along_x = e.b.x - box.x - px, along_y = e.b.y - box.y - py;
  const float square = along_x * along_x + along_y * along_y;
  const float s = min(max(-(px * along_x + py * along_y) / (square > 0.0F ? square : 1.0F), 0.0F), 1.0F);
  const float x = px + s * along_x, y = py + s * along_y, distance = std::sqrt(x * x + y * y);
  // The clearance of the box from it, times the distance
  const float clearance = x * x + y * y - std::abs(x) * box.half_x - std::abs(y) * box.half_y;
  if (clearance <= 0.01F * distance) return infinity;
  return rise * distance / max(clearance, 0.01F * 0.01F) * (1.0F + 1e-4F) + 1e-4F;
}

struct Crossing {
  float inside, slope;
};
/// u = (p × d) / (p × q), v = (d × q) / (p × q), slope = p_z v + q_z u; inside the edge if u ≥ 0 and v ≥ 0.
inline Crossing crossing(const Point3f& p, const Point3f& q, float inverse_cross, float max_slope, Azimuth d) {
  const float u = (p.x * d.y - p.y * d.x) * inverse_cross, v = (q.y * d.x - q.x * d.y) * inverse_cross;
  return {min(u, v), min(p.z * v + q.z * u, max_slope)};
}

/// 1 / (p × q) of an edge clear of the packet.
inline float inverse_cross(const Point3f& p, const Point3f& q) {
  const float cross = p.x * q.y - p.y * q.x;
  return cross * cross > 0.0F ? 1.0F / cross : 0.0F;
}
/// The same of a nearby edge: none seen end-on; right below it, as if the receiver stood 1 mm beside it.
inline float inverse_cross_nearby(const Point3f& p, const Point3f& q, float cross_below) {
  const float cross = p.x * q.y - p.y * q.x, squares = (p.x * p.x + p.y * p.y) * (q.x * q.x + q.y * q.y);
  if (cross * cross - 1e-5F * 1e-5F * squares > 0.0F) return 1.0F / cross;
  const bool is_below = min(-(cross * cross - 1e-5F * 1e-5F * squares), -(p.x * q.x + p.y * q.y)) > 0.0F;
  return is_below ? 1.0F / cross_below : 0.0F;
}

/// Calls `visit(crossing)` for each way in which a receiver sees an edge at an azimuth: one, or two right below a lower border.
template <class Visit>
void for_each_crossing(const HorizonEdge& e, const Point3f& r, const PacketBounds& packet, Azimuth d, const Visit& visit) {
  const Point3f p{e.a.x - r.x, e.a.y - r.y, e.a.z - r.z}, q{e.b.x - r.x, e.b.y - r.y, e.b.z - r.z};
  const float max_slope = max_slope_of(e, packet);
  if (max_slope < 0.0F) return;
  if (max_slope < infinity) return visit(crossing(p, q, inverse_cross(p, q), max_slope, d));
  visit(crossing(p, q, inverse_cross_nearby(p, q, -1e-3F), infinity, d));
  if (e.role == EdgeRole::underside) visit(crossing(p, q, inverse_cross_nearby(p, q, 1e-3F), infinity, d));
}

/// The horizon: the largest slope of all edges, at least `slope`.
inline float raised(float slope, std::span<const HorizonEdge> edges, const Point3f& r, const PacketBounds& packet, Azimuth d) {
  for (const HorizonEdge& e : edges)
    for_each_crossing(e, r, packet, d, [&](const Crossing& c) { slope = max(slope, c.inside >= 0.0F ? c.slope : 0.0F); });
  return slope;
}

/// The smallest slope of all edges above `min_slope`, at most `slope`.
inline float lowered(float slope, float min_slope, std::span<const HorizonEdge> edges, const Point3f& r,
                     const PacketBounds& packet, Azimuth d) {
  for (const HorizonEdge& e : edges)
    for_each_crossing(e, r, packet, d, [&](const Crossing& c) {
      slope = min(slope, min(c.inside, c.slope - min_slope) > 0.0F ? c.slope : infinity);
    });
  return slope;
}

// --- Sky
// -------------------------------------------------------------------------------------------------------------------------

/// arctan t, 0 ≤ t ≤ 1: Abramowitz & Stegun, 4.4.49.
inline float atan_of_fraction(float t) {
  const float s = t * t;
  float p = 0.0028662257F;
  for (const float c :
       {-0.0161657367F, 0.0429096138F, -0.0752896400F, 0.1065626393F, -0.1420889944F, 0.1999355085F, -0.3333314528F})
    p = p * s + c;
  return t + t * s * p;
}

/// A(t) = o (π/2 − arctan t − t / (1 + t²)) + w / (1 + t²).
inline float cosine_above(float t, float outward, float upward) {
  const float arc = atan_of_fraction(t < 1.0F ? t : 1.0F / max(t, 1.0F));
  const float zenith_distance = t < 1.0F ? 1.57079632679F - arc : arc, cos_square = 1.0F / (1.0F + t * t);
  return outward * (zenith_distance - t * cos_square) + upward * cos_square;
}
/// A(t) = 1 − t / √(1 + t²).
inline float solid_angle_above(float t) { return 1.0F - t / std::sqrt(1.0F + t * t); }

/// A(t) by either weight, with t clamped to the slopes in front of the receiver.
inline float sky_above(SkyWeight weight, float t, const Point3f& normal, Azimuth d) {
  constexpr float straight_up = 1e6F;
  const float outward = normal.x * d.x + normal.y * d.y, upward = normal.z;
  const float border = min(std::abs(outward / (upward == 0.0F ? 1e-30F : upward)), straight_up);
  const float lowest = outward > 0.0F ? 0.0F : upward > 0.0F ? border : straight_up;
  const float highest = outward > 0.0F && upward < 0.0F ? border : straight_up;
  const float clamped = min(max(t, lowest), highest);
  return weight == SkyWeight::solid_angle ? solid_angle_above(clamped) : cosine_above(clamped, outward, upward);
}

/// F(t) = A(t) − A(∞): the sky of one azimuth above a slope.
inline float sky_of_azimuth(SkyWeight weight, float t, const Point3f& normal, Azimuth d) {
  return sky_above(weight, t, normal, d) - sky_above(weight, infinity, normal, d);
}

}  // namespace farlod::scalar
