// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "farlod/hemisphere.hpp"
#include "results/picture/drawing.hpp"

namespace farlod {

/// How the hemisphere is laid into a disk, whose middle is the zenith. With the zenith angle θ, the distance from the middle is
enum class SkyProjection : std::uint8_t {
  equidistant,  ///< θ / 90°
  equal_area,   ///< √2 sin(θ / 2): equal areas are equal solid angles (Lambert)
  orthographic  ///< sin θ: equal areas have equal shares of the sky view factor (Nusselt's analogue)
};

/// A direction of the hemisphere, and its place in the disk of radius 1 as it is seen from below: v towards north, u towards
/// west. Each is the inverse of the other.
struct HemisphereDirection {
  double azimuth_deg = 0.0, zenith_angle_deg = 0.0;
};
struct DiskPoint {
  double u = 0.0, v = 0.0;
};
[[nodiscard]] DiskPoint disk_point_of(const HemisphereDirection& direction, SkyProjection projection);
/// Empty outside of the disk.
[[nodiscard]] std::optional<HemisphereDirection> direction_of(const DiskPoint& point, SkyProjection projection);

[[nodiscard]] Colour colour_of(SkyPart part);

/// Where a direction is drawn on the page of draw_sky.
[[nodiscard]] PagePoint sky_page_point(const HemisphereDirection& direction, SkyProjection projection);

/// The disk, in a square with edges of `edge` pixels; around it is paper.
[[nodiscard]] Picture draw_sky_disk(const Hemisphere& hemisphere, SkyProjection projection, std::size_t edge);

/// What the legend says besides.
struct SkyCaption {
  std::string quantity;                 ///< "svf" or "svf_solid"
  std::string place;                    ///< coordinates and CRS
  std::optional<float> svf_total = {};  ///< of a city with trees
};

/// The sun's way through a day.
struct SunCourse {
  std::string day;
  std::vector<HemisphereDirection> minutes;  ///< each minute from midnight to midnight; below the horizon it is not drawn
};

/// What a picture of the sky shows of the sun.
struct SunOfSky {
  std::vector<SunCourse> courses;   ///< three at the most
  std::vector<std::string> legend;  ///< lines of text: which hours these are, for how long the sun shines
};

/// The sun above the horizon at a time of a period.
struct LitSun {
  HemisphereDirection direction;
  double direct_w_m2 = 0.0;  ///< on a plane that faces it
};

/// What a picture of the sky shows of the light of a period.
struct LightOfSky {
  std::vector<LitSun> suns;
  std::vector<std::string> legend;  ///< lines of text: what falls on the receiver
};

/// Whether something hides a direction.
[[nodiscard]] bool is_hidden(const Hemisphere& hemisphere, const HemisphereDirection& direction);

/// The disk with the horizon, the four directions, the view factor and a legend; the sun's way, and where it stands in a period,
/// if they are given.
[[nodiscard]] Drawing draw_sky(const Hemisphere& hemisphere, SkyProjection projection, const SkyCaption& caption,
                               const std::optional<SunOfSky>& sun = {}, const std::optional<LightOfSky>& light = {});

}  // namespace farlod
