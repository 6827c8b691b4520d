// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "base/mesh_view.hpp"
#include "farlod/error.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// A ray in the frame of the occluder that is asked. `direction` need not have length 1; distances count in its length.
struct Ray {
  Point3f origin;
  Point3f direction;
  float begin = 0.0F;  ///< hits nearer than this do not count
  float end = std::numeric_limits<float>::infinity();
};

/// Where rays begin that share their directions: neighboring places, coordinate by coordinate.
struct RayOrigins {
  static constexpr std::size_t lanes = 16;
  alignas(64) std::array<float, lanes> x{}, y{}, z{};
};

/// Who traces millions of directions looks after so many whether he is asked to stop: they take some milliseconds.
inline constexpr std::size_t directions_between_looks = 4096;

struct Hit {
  float distance = 0.0F;  ///< along the ray, in lengths of its direction
  std::uint32_t triangle = 0;
};

/// Embree failed.
class OcclusionError : public Error {
 public:
  using Error::Error;
};

/// Answers "what does this ray meet?" for a set of triangles. Both sides of a triangle count. Immutable; all questions may
/// be asked from many threads. The only wrapper of Embree.
///
/// Neighboring triangles are watertight (Embree's robust mode): a ray through a shared edge meets one of them. Whether a ray
/// that ends or begins on a triangle meets it is not specified.
class Occluder {
 public:
  /// Takes the triangles; vertex numbers must be below vertices.size(). Throws OcclusionError, std::bad_alloc where
  /// Embree has too little memory, and Cancelled when `stop` is asked for meanwhile.
  Occluder(std::vector<Point3f> vertices, std::vector<Triangle> triangles, const std::stop_token& stop = {});
  Occluder(Occluder&&) noexcept;
  Occluder& operator=(Occluder&&) noexcept;
  ~Occluder();

  [[nodiscard]] std::size_t triangle_count() const;

  [[nodiscard]] bool blocks(const Ray& ray) const;
  /// A bit for each origin whose ray in this direction meets something beyond `begin`; `wanted` are the bits of those that are
  /// asked.
  [[nodiscard]] std::uint32_t blocked(const RayOrigins& origins, const Point3f& direction, float begin,
                                      std::uint32_t wanted) const;

  /// The same, each ray with a direction of its own: neighboring directions, as origins are neighbors.
  struct Directions {
    alignas(64) std::array<float, RayOrigins::lanes> x{}, y{}, z{};
    [[nodiscard]] static Directions all_of(const Point3f& direction) {
      Directions directions;
      directions.x.fill(direction.x);
      directions.y.fill(direction.y);
      directions.z.fill(direction.z);
      return directions;
    }
  };
  [[nodiscard]] std::uint32_t blocked(const RayOrigins& origins, const Directions& directions, float begin,
                                      std::uint32_t wanted) const;

  /// Where each ray first meets something beyond `begin`, in lengths of its direction; infinite where it meets nothing, or is not
  /// wanted.
  using Distances = std::array<float, RayOrigins::lanes>;
  [[nodiscard]] Distances distances(const RayOrigins& origins, const Point3f& direction, float begin, std::uint32_t wanted) const;
  [[nodiscard]] Distances distances(const RayOrigins& origins, const Directions& directions, float begin,
                                    std::uint32_t wanted) const;

  /// What each ray first meets beyond `begin`: the same distances, and the triangles, which mean nothing where nothing is met.
  struct Hits {
    Distances distances{};
    std::array<std::uint32_t, RayOrigins::lanes> triangles{};
  };
  [[nodiscard]] Hits nearest(const RayOrigins& origins, const Point3f& direction, float begin, std::uint32_t wanted) const;
  [[nodiscard]] Hits nearest(const RayOrigins& origins, const Directions& directions, float begin, std::uint32_t wanted) const;
  [[nodiscard]] std::optional<Hit> nearest(const Ray& ray) const;
  /// The nearest among the triangles that `counts` says yes to.
  [[nodiscard]] std::optional<Hit> nearest(const Ray& ray, const std::function<bool(std::uint32_t triangle)>& counts) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
