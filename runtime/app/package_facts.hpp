// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "farlod/inspection.hpp"
#include "farlod/package.hpp"
#include "farlod/raster.hpp"

namespace farlod {

/// What farlod-info found in a package.
struct PackageFacts {
  std::string package;  ///< as the user calls it
  PackageDescription description;
  PackageInventory inventory;
  std::optional<RasterPlan> pixels;  ///< those that the city is, of a surface model
  std::optional<PackageCheck> check;
  std::optional<CellContents> cell;
};

/// "name (EPSG:n)", or the name alone.
[[nodiscard]] std::string crs_text(const PackageDescription& description);

/// For people: a line for each fact, the names aligned.
[[nodiscard]] std::string facts_text(const PackageFacts& facts);

/// For programs; the keys are listed in docs/stages/results.md.
[[nodiscard]] std::string facts_json(const PackageFacts& facts);
/// The same, with the figures of the run.
[[nodiscard]] std::string info_summary_json(const PackageFacts& facts, double total_seconds, const std::string& settings_json);

/// What is damaged, in a line that names the cell where there is one.
[[nodiscard]] std::string damage_text(const PackageDamage& damage);

}  // namespace farlod
