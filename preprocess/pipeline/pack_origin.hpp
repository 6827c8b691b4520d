// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "city/source.hpp"
#include "package/package_origin.hpp"
#include "package/sources_writer.hpp"
#include "pipeline/city_reading.hpp"
#include "pipeline/pack.hpp"

namespace farlod::pipeline {

/// From what a run makes its package. The contents of all files count, with those that lie beside them and are read with them. A
/// file that `earlier` knows, and that was not written since, is not read for that. Throws InputError.
[[nodiscard]] PackageOrigin origin_of(const StageSettings& settings, const CityFiles& files,
                                      const std::optional<PackageOrigin>& earlier);

/// What the manifest says of the inputs: those that the user named or that were found, in their order.
[[nodiscard]] std::vector<package::InputFile> inputs_of(const PackageOrigin& origin);

/// The files into which attributes can be inserted, in the order of `placed` (LocatedCity), with their inputs.
[[nodiscard]] std::vector<std::optional<SourceOfPackage>> sources_of(const PackageOrigin& origin,
                                                                     std::vector<std::optional<PlacedFile>> placed);

/// Throws InputError where a file has changed or vanished since its origin was told.
void require_unchanged(const PackageOrigin& origin);

}  // namespace farlod::pipeline
