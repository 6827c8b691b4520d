// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "package/manifest.hpp"
#include "package/sources_layout.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// A city file of a package into which attributes can be inserted.
struct SourceOfPackage {
  std::uint32_t input = 0;  ///< in Manifest::inputs
  package::CityFileFormat format = package::CityFileFormat::citygml;
  std::vector<package::AttributeForm> forms;
};

/// Writes `sources.bin` into the folder of a package, which is made where there is none. `files`: as LocatedCity::sources; empty
/// where attributes have no places. Returns its stamp; nothing where no file has places. Throws OutputError.
[[nodiscard]] std::optional<package::FileStamp> write_sources(const std::filesystem::path& folder, const TileSources& sources,
                                                              std::span<const std::optional<SourceOfPackage>> files);

}  // namespace farlod
