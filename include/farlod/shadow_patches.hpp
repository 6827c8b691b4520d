// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "farlod/angle.hpp"
#include "farlod/export.hpp"

namespace farlod {

/// The middle of a patch of the sky.
struct ShadowPatch {
  Angle azimuth;    ///< clockwise from true north, below the full turn
  Angle elevation;  ///< above the horizon
};

inline constexpr std::size_t shadow_patch_count = 153;

/// The patches for which SOLWEIG of UMEP knows the radiance of the sky ("patch option 2"), in its order: from the horizon
/// upwards, bands of 12° with 31, 30, 28, 24, 19, 13 and 7 patches, whose middles are 6°, 18°, … 78° high, and the zenith. In a
/// band, patches follow clockwise in equal steps, the first at 0°, 4°, 2°, 5°, 8°, 0° and 10°.
[[nodiscard]] FARLOD_EXPORT const std::array<ShadowPatch, shadow_patch_count>& shadow_patches();

/// What is asked of the ray from a receiver to the middle of a patch. Let B be 1 where something solid blocks it and else 0, V
/// the same of crowns of trees, and F of crowns that it meets before anything solid.
enum class ShadowMatrix : std::uint8_t {
  building,                   ///< 1 − B: nothing solid hides the patch; UMEP's `shadowmat`
  vegetation,                 ///< 1 − V (1 − B): no crown hides sky there; UMEP's `vegshadowmat`
  vegetation_before_building  ///< 1 − B F: no crown hides there what is solid; UMEP's `vbshmat`
};
inline constexpr std::size_t shadow_matrix_count = 3;

// The columns of Quantities::shadow_patches hold whole numbers, matrix by matrix, each with the bits of so many patches: a float
// knows whole numbers below 2²⁴.
inline constexpr std::size_t patches_of_shadow_column = 24;
inline constexpr std::size_t columns_of_shadow_matrix =
    (shadow_patch_count + patches_of_shadow_column - 1) / patches_of_shadow_column;
inline constexpr std::size_t shadow_column_count = shadow_matrix_count * columns_of_shadow_matrix;

/// The value of a matrix, from the shadow_column_count columns of a receiver that has data.
[[nodiscard]] constexpr bool shadow_value(std::span<const float> columns, ShadowMatrix matrix, std::size_t patch) {
  const std::size_t column = static_cast<std::size_t>(matrix) * columns_of_shadow_matrix + patch / patches_of_shadow_column;
  return (static_cast<std::uint32_t>(columns[column]) >> patch % patches_of_shadow_column & 1U) != 0;
}

}  // namespace farlod
