// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "farlod/evaluation.hpp"
#include "farlod/point.hpp"
#include "horizon/picture_plane.hpp"
#include "horizon/wedge_envelope.hpp"
#include "horizon/wedge_sky.hpp"
#include "scene/triangle_index.hpp"

namespace farlod {

/// The sky of receivers among triangles, whatever they are: exact, in double precision, without azimuths or rays. For one thread.
class ExactSky {
 public:
  /// How triangles lie. Nothing is seen below those of an unbroken surface, which each upright line meets once at the most, or
  /// along a wall: so their edges tell the sky, in a tenth of the time.
  enum class Triangles : std::uint8_t { any, of_unbroken_surface };
  /// The triangles must outlive it.
  explicit ExactSky(const TriangleIndex& triangles, Triangles kind = Triangles::any) : triangles_(triangles), kind_(kind) {}

  /// ∫ F(φ) dφ over a wedge, by a receiver at a place of the frame of the triangles.
  [[nodiscard]] double sky_of_wedge(const Wedge& wedge, const Point3d& place, const Point3f& normal, SkyWeight weight);
  /// The share of all of the turn (the sky view factor), summed over so many equal wedges, at least 5.
  [[nodiscard]] double share_of_sky(std::size_t wedges, const Point3d& place, const Point3f& normal, SkyWeight weight);

 private:
  [[nodiscard]] double sky_above_edges(const Wedge& wedge, const TriangleIndex::Sector& sector, SkyWeight weight);

  const TriangleIndex& triangles_;
  Triangles kind_;
  WedgeSky sky_;
  WedgeEnvelope envelope_;
};

}  // namespace farlod
