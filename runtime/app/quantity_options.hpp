// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "farlod/quantities.hpp"
#include "results/output_format.hpp"

namespace CLI {
class App;
}

namespace farlod {

/// Some days for which hours of sunshine are counted.
struct SunPeriod {
  std::chrono::sys_days first;
  std::size_t days = 1;
  std::chrono::minutes step{5};
};

/// Patches of SkyPatchSet::tregenza and ::reinhart.
inline constexpr std::size_t tregenza_patches = 145, reinhart_patches = 577;

/// What the options of this file say, as text.
struct RawQuantities {
  std::string quantities, sun, canopy_rule = "umep";
  std::optional<double> transmissivity, extinction_per_m;
  bool leaf_off = false;
  std::size_t horizons = 0, sky_patches = 0, sun_step_minutes = 0, wall_sectors = 0;
  std::optional<double> eye_field_deg;
  std::string sees;
};

/// What they mean. The sun's positions depend on where the package is, and are not among the quantities yet.
struct RequestedQuantities {
  Quantities further;
  std::optional<SunPeriod> sunshine;

  [[nodiscard]] bool any() const { return further.any() || sunshine.has_value(); }
};

/// The words of the quantities that know other weights than the cosine, for messages.
[[nodiscard]] std::string words_of_unweighted();

void add_quantity_options(CLI::App& app, RawQuantities& raw);

/// What SOLWEIG reads beside the sky view factor from a result of this format, if anything, of a package with trees or without.
void add_for_solweig(const OutputFormat& format, bool has_trees, Quantities& quantities);

/// With what SOLWEIG reads in any case, where the result is for it: whether the package has trees is not known yet. A result that
/// is a city file has no format. Throws CLI::ValidationError.
[[nodiscard]] RequestedQuantities resolved(const RawQuantities& raw, const OutputFormat* format);

}  // namespace farlod
