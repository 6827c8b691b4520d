// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/export.hpp"
#include "farlod/light.hpp"

namespace farlod {

/// A place on the Earth (WGS84).
struct PlaceOnEarth {
  Angle longitude, latitude;
  double height_m = 0.0;  ///< above the ellipsoid
};

/// Where the light of a period comes from, as farlod-svf has it with --weather, --period, --step and --linke.
struct LightSource {
  /// EPW, a TMY of PVGIS or NREL as CSV, or a CSV whose first row names time and global, direct and diffuse irradiance. Empty:
  /// the sky is clear.
  std::filesystem::path weather_file = {};
  /// Part of the weather: `2026`, `2026-06/08`, `2026-06-21`, `2026-06-21T10:00/16:00`, or of any year `06-21`. Empty: all of it.
  /// A clear sky needs one, with a year.
  std::string period = {};
  /// From one position of the sun to the next at the most, and of a clear sky; 1 to 60.
  std::chrono::minutes step{5};
  double linke_turbidity = 3.0;  ///< of a clear sky: Ineichen and Perez 2002; 1 to 12
};

/// The light of a period over a place.
struct PeriodLight {
  std::vector<LightInterval> intervals;   ///< for Light::intervals
  std::string source;                     ///< for people, such as "EPW of Rotterdam, NLD (06344), delft.epw"
  double hours = 0.0;                     ///< of all intervals
  double global_horizontal_kwh_m2 = 0.0;  ///< what falls on a level plane in the open
  /// What was missing, filled, left out or doubtful: a sentence each.
  std::vector<std::string> remarks;
};

/// What falls on a level plane in the open. The direct light of an interval is shared out among its positions of the sun.
[[nodiscard]] FARLOD_EXPORT double global_horizontal_kwh_m2(std::span<const LightInterval> intervals);

/// Reads weather, or computes a clear sky, and places the sun for it: over the place that a file names, and over `place` where it
/// names none. A file's place that is more than 2° from `place` is a remark. Hours of a file are those that its format means.
/// Throws InvalidArgument where the period or another member is not what its declaration says, and InputError where the file
/// cannot be used or has nothing of the period: the line, what is wrong, and what to do.
[[nodiscard]] FARLOD_EXPORT PeriodLight light_of_period(const LightSource& source, const PlaceOnEarth& place);

}  // namespace farlod
