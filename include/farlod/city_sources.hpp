// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "farlod/building_origin.hpp"
#include "farlod/export.hpp"
#include "farlod/inspection.hpp"
#include "farlod/package.hpp"

namespace farlod {

/// A city file that a package was made of, and into which attributes can be inserted.
struct PackedCityFile {
  PackedInput input;
  CityFileFormat format = CityFileFormat::citygml;
  std::vector<AttributeForm> forms;  ///< AttributePlace::form counts them from 1
};

/// Those of a package. Files of other kinds are not among them, nor are files within archives, pipes, and files in UTF-16.
/// Packages of format versions before 10 have none. Throws InvalidArgument when the package is closed, PackageDamaged,
/// PackageUnusable.
[[nodiscard]] FARLOD_EXPORT std::vector<PackedCityFile> city_files_of(const Package& package);

/// Calls `visit` for each building of a package that comes from one of city_files_of(), in the order of their numbers: with the
/// number of the building (SurfaceMean, BuildingMean), the place of its file in city_files_of(), and what it comes from. Throws
/// as city_files_of() does.
FARLOD_EXPORT void visit_origins(
    const Package& package,
    const std::function<void(std::uint32_t building, std::size_t file, const BuildingOrigin& origin)>& visit);

}  // namespace farlod
