// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stop_token>
#include <vector>

#include "farlod/canopy.hpp"
#include "occlusion/occluder.hpp"
#include "package/crown.hpp"

namespace farlod {

/// What a ray meets of the crowns.
struct CrownLight {
  float transmitted = 1.0F;  ///< the share of the light that passes all crowns, by the rule
  /// Where the ray first enters a crown, in lengths of its direction; where the ray begins if that is within a crown; infinite if
  /// the ray meets none.
  float nearest = std::numeric_limits<float>::infinity();

  [[nodiscard]] bool is_met() const { return nearest < std::numeric_limits<float>::infinity(); }
};

/// The same of sixteen rays.
struct CrownLights {
  alignas(64) std::array<float, RayOrigins::lanes> transmitted{}, nearest{};
  std::uint32_t met = 0;  ///< a bit for each ray that meets a crown
};

/// What is asked of crowns. Light alone is answered sooner: by the rule `once`, the first crown of the smallest ψ will do.
enum class CrownQuestion : std::uint8_t { light, light_and_nearest };

/// Answers "how much light passes the crowns along this ray?" ray by ray, from the shapes of the crowns themselves. Crowns may
/// overlap. A ray that only touches a crown does not meet it. Of a ray that begins within a crown, the crown counts, with the
/// length from there. Immutable; all questions may be asked from many threads, and the answer to each depends on nothing else.
class CrownOccluder {
 public:
  /// Throws OcclusionError, std::bad_alloc, LimitReached where there are more crowns than 32 bits can number, and Cancelled when
  /// `stop` is asked for meanwhile.
  CrownOccluder(std::vector<Crown> crowns, const CanopySettings& settings, const std::stop_token& stop = {});
  CrownOccluder(CrownOccluder&&) noexcept;
  CrownOccluder& operator=(CrownOccluder&&) noexcept;
  ~CrownOccluder();

  [[nodiscard]] std::size_t crown_count() const;

  /// Between the ray's begin and end. Where light alone is asked, `nearest` says no more than whether a crown is met.
  [[nodiscard]] CrownLight light(const Ray& ray, CrownQuestion question = CrownQuestion::light_and_nearest) const;
  /// From `begin` on, in one direction; `wanted` are the bits of the rays that are asked. All others meet nothing.
  [[nodiscard]] CrownLights light(const RayOrigins& origins, const Point3f& direction, float begin, std::uint32_t wanted,
                                  CrownQuestion question = CrownQuestion::light_and_nearest) const;
  /// The same, each ray with a direction of its own.
  [[nodiscard]] CrownLights light(const RayOrigins& origins, const Occluder::Directions& directions, float begin,
                                  std::uint32_t wanted, CrownQuestion question = CrownQuestion::light_and_nearest) const;

  /// Bits of the rays that meet a crown between `begin` and their end.
  [[nodiscard]] std::uint32_t met_before(const Occluder::Distances& ends, const RayOrigins& origins,
                                         const Occluder::Directions& directions, float begin, std::uint32_t wanted) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
