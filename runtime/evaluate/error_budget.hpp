// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace farlod {

/// The largest error measured among thousands of receivers in streets, on roofs and on walls is this times rays^(−3/4)
/// (docs/validation.md, "Shares of the error").
inline constexpr double sampling_error_factor = 2.4;

/// Upper estimate of the sampling error of an answer from this many rays: the largest error that was measured, and a quarter
/// more. Not a certain bound.
[[nodiscard]] double sampling_error(std::size_t rays);

/// The fewest rays whose sampling error is at most this.
[[nodiscard]] std::size_t rays_for_sampling_error(double error);

/// The largest error measured among 700,000 receivers in streets, on roofs and on walls of four cities is this over the number of
/// azimuths of their horizons, from 256 of them on; with fewer, up to a quarter more (docs/decisions/0010-error-control.md).
inline constexpr double azimuth_error_factor = 1.6;

/// The same for horizons: the error of so many azimuths at the most, and the fewest azimuths whose error is at most this.
[[nodiscard]] double azimuth_error(std::size_t azimuths);
/// Sky in gaps below overhangs is estimated where it is less than this share of all other sky: a tenth of that error.
[[nodiscard]] inline float gap_tolerance(std::size_t azimuths) { return static_cast<float>(0.1 * azimuth_error(azimuths)); }
[[nodiscard]] std::size_t azimuths_for_error(double error);

}  // namespace farlod
