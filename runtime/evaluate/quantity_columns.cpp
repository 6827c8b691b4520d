// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/quantity_columns.hpp"

#include <array>
#include <cstddef>
#include <cstdio>
#include <numeric>
#include <string>

namespace farlod {
namespace {

std::string numbered(const char* name, std::size_t digits, std::size_t n) {
  std::string number = std::to_string(n);
  return name + std::string(number.size() < digits ? digits - number.size() : 0, '0') + number;
}

/// Degrees with as few decimals as tell the azimuths apart: 000, 010 or 000.00, 007.50.
std::string azimuth_name(std::string_view name, std::size_t n, std::size_t count) {
  std::array<char, 32> text{};
  const double degrees = 360.0 * static_cast<double>(n) / static_cast<double>(count);
  std::snprintf(text.data(), text.size(), 360 % count == 0 ? "_%03.0f" : "_%06.2f", degrees);
  return std::string(name) + text.data();
}

std::size_t patches_of(SkyPatchSet set) {
  const PatchBands bands = patch_bands_of(set);
  return bands.counts.empty() ? 0 : std::accumulate(bands.counts.begin(), bands.counts.end(), std::size_t{1});
}

}  // namespace

PatchBands patch_bands_of(SkyPatchSet set) {
  if (set == SkyPatchSet::none) return {};
  const std::size_t parts = set == SkyPatchSet::reinhart ? 2 : 1;
  PatchBands bands;
  for (const std::uint32_t count : {30U, 30U, 24U, 24U, 18U, 12U, 6U})
    for (std::size_t n = 0; n < parts; ++n) bands.counts.push_back(count * static_cast<std::uint32_t>(parts));
  bands.height = 1.0 / (static_cast<double>(bands.counts.size()) + 0.5);
  return bands;
}

TotalColumns total_columns_of(const Quantities& quantities) {
  if (!quantities.svf_total) return {};
  const std::size_t total = columns_of(quantities).size() - count_canopy_columns(quantities);
  return {total, quantities.svf_total_bounds ? std::optional(total + 1) : std::nullopt};
}

std::size_t count_canopy_columns(const Quantities& quantities) {
  return (quantities.svf_total ? 2 : 0) + (quantities.svf_total_bounds ? 2 : 0) + (quantities.svfaveg ? 1 : 0) +
         (quantities.directional_vegetation ? 8 : 0) + (quantities.sky_shares ? 3 : 0);
}

std::vector<std::string> columns_of(const Quantities& quantities) {
  std::vector<std::string> names;
  if (quantities.svf_solid) names.emplace_back("svf_solid");
  if (quantities.directional) names.insert(names.end(), {"svfN", "svfE", "svfS", "svfW"});
  if (quantities.hidden) names.insert(names.end(), {"hidden_near", "hidden_far"});
  for (std::size_t n = 0; n < quantities.horizons; ++n) names.push_back(azimuth_name(horizon_column, n, quantities.horizons));
  for (std::size_t n = 0; n < quantities.horizons && quantities.horizon_distances; ++n)
    names.push_back(azimuth_name("distance", n, quantities.horizons));
  for (std::size_t n = 1; n <= patches_of(quantities.sky_patches); ++n) names.push_back(numbered("patch_", 3, n));
  if (quantities.sun) names.emplace_back("sunlit_h");
  if (quantities.svf_total) names.emplace_back("svf_total");
  if (quantities.svf_total_bounds) names.insert(names.end(), {"svf_total_low", "svf_total_high"});
  if (quantities.svf_total) names.emplace_back("svfveg");
  if (quantities.svfaveg) names.emplace_back("svfaveg");
  if (quantities.directional_vegetation)
    names.insert(names.end(), {"svfNveg", "svfEveg", "svfSveg", "svfWveg", "svfNaveg", "svfEaveg", "svfSaveg", "svfWaveg"});
  if (quantities.sky_shares) names.insert(names.end(), {"share_sky", "share_vegetation", "share_building"});
  return names;
}

}  // namespace farlod
