// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "farlod/point.hpp"
#include "package/package_reader.hpp"

namespace farlod {

/// Parts of the turn by which walls are told apart, from true north clockwise: whole quarters and eighths that are centred at
/// north consist of them.
inline constexpr std::size_t wall_slices = 16;
/// What a receiver may see. Walls are `first_wall` and those behind it, by the slice of the turn that they face.
enum class ViewClass : std::uint8_t { sky, ground, roof, first_wall, crown = first_wall + wall_slices, other };
inline constexpr std::size_t view_class_count = static_cast<std::size_t>(ViewClass::other) + 1;

/// What the triangles of a scene of the whole city (WholeCity) are to those who see them, by the side that is seen:
///
///   ground                 ground; a wall where a triangle is as steep as one (wall_normal_z), as the sides of pixels are
///   far terrain            ground
///   what looks down        other: an underside, unless it is as steep as a wall
///   roof                   roof
///   wall, foundation       the wall that faces where this side does; a roof where it is within 15° of level
///   floor                  a roof, unless it is as steep as a wall: a terrace
///
/// Sides are those of a surface's stored normal, and of a triangle of the ground. Immutable.
class SeenSurfaces {
 public:
  /// Throws Cancelled when `stop` is asked for meanwhile.
  explicit SeenSurfaces(const PackageReader& package, const std::stop_token& stop = {});

  /// The class of a triangle of the scene that is met in this direction, grid frame.
  [[nodiscard]] ViewClass met(std::uint32_t triangle, const Point3f& direction) const {
    const Sides& sides = sides_[sides_of_triangle_[triangle]];
    const Point3f& n = sides.normal;
    const bool is_back = n.x * direction.x + n.y * direction.y + n.z * direction.z > 0.0F;
    return is_back ? sides.back : sides.front;
  }

 private:
  struct Sides {
    Point3f normal;  ///< of the front, grid frame
    ViewClass front = ViewClass::ground, back = ViewClass::ground;
  };
  void add(const package::Manifest& manifest, const TileView& tile);
  void add_ground(const package::Manifest& manifest, const MeshView& mesh, std::uint32_t begin, std::uint32_t end);
  [[nodiscard]] std::uint32_t added(const Sides& sides) {
    sides_.push_back(sides);
    return static_cast<std::uint32_t>(sides_.size() - 1);
  }

  std::vector<Sides> sides_;  ///< the first is the ground's
  std::vector<std::uint32_t> sides_of_triangle_;
};

}  // namespace farlod
