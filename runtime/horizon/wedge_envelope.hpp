// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "farlod/evaluation.hpp"
#include "farlod/point.hpp"
#include "horizon/picture_plane.hpp"

namespace farlod {

/// The sky of a receiver between two azimuths, above the upper envelope of edges: exact, in double precision. docs/concepts.md,
/// "The sky of a wedge". WedgeSky is for triangles that something may be seen below.
///
/// In the picture plane, the envelope consists of segments, between whose ends the sky is known in closed form.
class WedgeEnvelope {
 public:
  using Sky = PicturePlane::Sky;

  /// Starts anew, for a receiver of this normal.
  void begin(const Wedge& wedge, const Point3d& normal, SkyWeight weight);
  /// An edge, relative to the receiver.
  void add(const Point3d& a, const Point3d& b);
  [[nodiscard]] Sky sky() { return sky_along(nullptr); }
  /// The same, and keeps nothing of the edges but what the envelope is made of: more that are added take less time.
  [[nodiscard]] Sky sky_of_kept_envelope();

 private:
  using Place = PicturePlane::Place;
  using Segment = PicturePlane::Segment;
  [[nodiscard]] std::size_t highest_at(double t) const;
  /// Where a segment ends that is the envelope at a place, and the segment that goes on there, if it is known.
  struct Step {
    double end;
    std::optional<std::size_t> next;
  };
  [[nodiscard]] Step step_from(double t, std::size_t now) const;
  /// Adds the segments of the envelope, from left to right, unless they are null.
  [[nodiscard]] Sky sky_along(std::vector<Segment>* envelope) const;

  std::optional<PicturePlane> picture_;
  double from_ = 0.0, to_ = 0.0;
  double lid_ = 0.0;  ///< a segment over all of the wedge is nowhere lower
  std::vector<Segment> segments_, kept_;
};

}  // namespace farlod
