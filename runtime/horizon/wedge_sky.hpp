// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "farlod/evaluation.hpp"
#include "farlod/point.hpp"
#include "horizon/picture_plane.hpp"

namespace farlod {

/// The sky of a receiver between two azimuths, in front of which triangles stand: exact, in double precision. Nothing is taken to
/// hide what is below it. docs/concepts.md, "The sky of a wedge".
///
/// In the picture plane, the part of a triangle in the wedge is a convex polygon. It hides what is between its lower and its
/// upper border, which consist of segments. The picture is halved at corners of polygons until no corner is left inside of a
/// part, and what is hidden there lies between straight lines. On the way, what covers a part is joined, and what is hidden by it
/// drops out.
class WedgeSky {
 public:
  using Sky = PicturePlane::Sky;

  /// Starts anew, for a receiver of this normal.
  void begin(const Wedge& wedge, const Point3d& normal, SkyWeight weight);
  /// A triangle, relative to the receiver.
  void add(const std::array<Point3d, 3>& triangle);
  /// What the triangles leave that were added so far.
  [[nodiscard]] Sky sky();

 private:
  using Place = PicturePlane::Place;
  using Segment = PicturePlane::Segment;
  /// A triangle has three corners, and each of five planes adds one at the most.
  static constexpr std::size_t most_corners = 8;
  /// Joined segments from left to right.
  struct Border {
    std::array<Place, most_corners> places;
    std::size_t count = 0;
    void add(const Place& place, double sense);
    [[nodiscard]] std::span<const Place> corners() const { return std::span(places).first(count); }
    [[nodiscard]] double at(double t) const;
    /// Whether it is above a line (sense 1) or below it (sense −1) anywhere between the ends of the line.
    [[nodiscard]] bool reaches_beyond(const Segment& line, double sense) const;
    [[nodiscard]] bool has_corner_inside(const Segment& part) const;
    [[nodiscard]] double from() const { return places[0].t; }
    [[nodiscard]] double to() const { return places[count - 1].t; }
  };
  /// Part of the picture: `lower` is convex, `upper` is concave.
  struct Polygon {
    Border lower, upper;
    [[nodiscard]] bool reaches_above(const Segment& line) const { return upper.reaches_beyond(line, 1.0); }
    [[nodiscard]] bool reaches_below(const Segment& line) const { return lower.reaches_beyond(line, -1.0); }
  };
  /// All between two lines is hidden, from one end of a part to the other.
  struct Slab {
    Segment lower, upper;
  };
  /// What may hide sky of a part, in two stacks: what may hide it in the halves of the part follows.
  struct Range {
    std::size_t first_polygon, last_polygon, first_slab, last_slab;
  };
  void add_part(Segment floor, const Range& whole);
  void collect(const Segment& part, const Range& whole);
  [[nodiscard]] Segment join_slabs(Segment floor, std::size_t first);
  [[nodiscard]] bool is_joined(const Slab& slab, std::size_t first, std::size_t last);
  void drop_hidden_polygons(const Segment& floor, std::size_t first_polygon, std::size_t first_slab);
  [[nodiscard]] std::optional<double> middle_corner(const Segment& part, std::size_t first);
  void find_crossings(const Segment& floor, std::size_t first);
  void add_between_slabs(const Segment& floor, std::size_t first);
  void add_strip(const Segment& floor, std::size_t first, double from, double to);

  std::optional<PicturePlane> picture_;
  std::vector<Polygon> polygons_;
  Sky sky_;
  // Working memory
  std::vector<Place> places_;
  std::vector<std::uint32_t> candidates_;  ///< numbers of polygons
  std::vector<Slab> slabs_;
  std::vector<double> corners_, crossings_;
  std::vector<Segment> lines_;
  struct Hidden {
    double low, high;
    const Slab* slab;
  };
  std::vector<Hidden> hidden_;
};

}  // namespace farlod
