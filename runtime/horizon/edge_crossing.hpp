// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "horizon/lanes.hpp"

/// Where azimuths meet edges: of one edge and sixteen receivers, or the other way round.
namespace farlod {

/// An edge relative to a receiver: p = a − r and q = b − r, and 1 / (p × q) in the plan.
struct RelativeEdge {
  Floats px, py, pz, qx, qy, qz, inverse_cross;
};

/// A receiver that is closer to the line of an edge, as the sine of an angle, sees it end-on: it has no width.
inline constexpr float end_on_sine = 1e-5F;
/// Greater than 0 for those who see some width, of the cross product p × q = |p| |q| sine: squares are compared, which takes no
/// root.
FARLOD_LANES Floats off_line_of(const RelativeEdge& e, const Floats& cross) {
  const Floats squares = (e.px * e.px + e.py * e.py) * (e.qx * e.qx + e.qy * e.qy);
  return cross * cross - end_on_sine * end_on_sine * squares;
}

/// Where an azimuth d meets an edge: u = (p × d) / (p × q), v = (d × q) / (p × q). The distance is 1 / (u + v), and the edge is
/// divided as u to v; d hits it, between its ends and in front, where u ≥ 0 and v ≥ 0. The slope there is t = p_z v + q_z u.
/// Neighboring edges share p × d of their common end, but for the sign, so that no azimuth falls between them.
struct Crossing {
  Floats inside, slope;  ///< min(u, v); t
};
FARLOD_LANES Crossing crossing_of(const RelativeEdge& e, float max_slope, float dx, float dy) {
  const Floats u = (e.px * dy - e.py * dx) * e.inverse_cross, v = (e.qy * dx - e.qx * dy) * e.inverse_cross;
  // For a receiver almost in line with the edge, t is mostly rounding: it never exceeds the bound of the packet
  return {min(u, v), min(e.pz * v + e.qz * u, broadcast(max_slope))};
}

}  // namespace farlod
